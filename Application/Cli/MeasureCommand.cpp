#include <algorithm>
#include <map>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/DissectionDistances.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Presenters/PointProbe.h"
#include "petrous/Scene/CaseField.h"

namespace petrous::cli
{

namespace
{

namespace fs = std::filesystem;
using presenters::Quantity;
using scene::Measurement;
using Kind = Measurement::Kind;

constexpr std::uintmax_t kLargestTable = std::uintmax_t{1} << 24;

struct Options
{
  std::string caseName, points, out, image;
  std::vector<std::string> between, dimensions, along, remove, wall;
  bool save = false, list = false, dissection = false, withoutDamaged = false;
};

struct Row
{
  std::string name, kind;
  Quantity quantity;
};

/// What the answer is made of.
struct Answer
{
  std::vector<Row> rows;
  nlohmann::json more = nlohmann::json::object();

  void add(const std::string& name, const std::string& kind, const Quantity& quantity)
  {
    rows.push_back({name, kind, quantity});
  }
};

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& what)
{
  throw core::InvalidParameter(file + ", line " + std::to_string(line) + ": " + what);
}

Kind kindOfPoints(std::size_t points)
{
  return points == 1 ? Kind::Mark : points == 2 ? Kind::Distance : Kind::Length;
}

/// One measurement for each name, of its rows in their order; without names of all rows. Without a
/// kind one point is a mark, two are a distance, more a line.
std::vector<Measurement> readMeasurements(const fs::path& path)
{
  const std::string file = core::printable(path);
  std::string text = core::readFile(path, kLargestTable);
  if (text.rfind("\xef\xbb\xbf", 0) == 0)
    text.erase(0, 3);
  if (!core::isUtf8(text))
    throw core::InvalidParameter(file + ": is not UTF-8");
  const auto rows = core::csvRows(text, file, core::csvDelimiter(text));
  const auto isBlank = [](const core::CsvRow& row)
  {
    return std::all_of(row.cells.begin(), row.cells.end(),
                       [](const std::string& cell) { return cell.empty(); });
  };
  const auto header = std::find_if_not(rows.begin(), rows.end(), isBlank);
  if (header == rows.end())
    throw core::InvalidParameter(file + ": is empty; the first row names the columns");
  std::map<std::string, std::size_t> columns;
  for (std::size_t n = 0; n < header->cells.size(); ++n)
    if (const std::string column = scene::lowerCase(header->cells[n]);
        !columns.emplace(column, n).second && !column.empty())
      refuse(file, header->line, "column '" + core::utf8Prefix(column, 40) + "' is there twice");
  for (const char* needed : {"x_mm", "y_mm", "z_mm"})
    if (columns.count(needed) == 0)
      refuse(file, header->line, std::string("there is no column ") + needed);
  std::vector<Measurement> measurements;
  std::map<std::string, std::size_t> places;
  std::vector<bool> hasKind;
  for (auto row = header + 1; row != rows.end(); ++row)
  {
    if (isBlank(*row))
      continue;
    if (row->cells.size() > header->cells.size())
      refuse(file, row->line, "has more cells than there are columns");
    const auto cell = [&](const std::string& column)
    {
      const auto at = columns.find(column);
      return at == columns.end() || at->second >= row->cells.size() ? std::string()
                                                                    : row->cells[at->second];
    };
    const auto number = [&](const char* column)
    {
      const auto value = core::parseDouble(cell(column));
      if (!value || !std::isfinite(*value))
        refuse(file, row->line,
               std::string(column) + " must be a number, not '" +
                   core::utf8Prefix(cell(column), 40) + "'");
      return *value;
    };
    const std::string name = cell("name").empty() ? "points" : cell("name");
    const auto [place, isNew] = places.emplace(scene::lowerCase(name), measurements.size());
    if (isNew)
    {
      Measurement next;
      next.name = name;
      measurements.push_back(std::move(next));
      hasKind.push_back(false);
    }
    Measurement& one = measurements[place->second];
    if (const std::string kind = cell("kind"); !kind.empty())
    {
      Kind wanted = one.kind;
      try
      {
        wanted = scene::measurementKindFrom(kind);
      }
      catch (const core::InvalidParameter&)
      {
        refuse(file, row->line, "kind must be mark, distance, length, angle, area or thickness");
      }
      if (hasKind[place->second] && wanted != one.kind)
        refuse(file, row->line, "the rows of one name must have one kind");
      one.kind = wanted;
      hasKind[place->second] = true;
    }
    one.points.emplace_back(number("x_mm"), number("y_mm"), number("z_mm"));
    one.images.push_back(cell("image"));
  }
  if (measurements.empty())
    throw core::InvalidParameter(file + ": there is no row after the header");
  for (std::size_t n = 0; n < measurements.size(); ++n)
    if (!hasKind[n])
      measurements[n].kind = kindOfPoints(measurements[n].points.size());
  try
  {
    scene::checkMeasurements(measurements);
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(file + ": " + error.what());
  }
  return measurements;
}

nlohmann::json orNull(const std::optional<double>& number)
{
  return number ? nlohmann::json(*number) : nlohmann::json(nullptr);
}

nlohmann::json quantityJson(const Row& row)
{
  return {{"name", row.name},
          {"kind", row.kind},
          {"quantity", row.quantity.name},
          {"value", orNull(row.quantity.value)},
          {"unit", row.quantity.unit},
          {"uncertainty", orNull(row.quantity.uncertainty)},
          {"remark", row.quantity.remark}};
}

nlohmann::json measurementJson(const scene::Case& value, const Measurement& one)
{
  nlohmann::json points = nlohmann::json::array();
  for (const Eigen::Vector3d& point : one.points)
    points.push_back(vectorJson(point));
  nlohmann::json quantities = nlohmann::json::array();
  for (const Quantity& quantity : presenters::quantitiesOf(value, one))
    quantities.push_back(quantityJson({one.name, scene::nameOf(one.kind), quantity}));
  const auto text = [](const std::string& words)
  { return words.empty() ? nlohmann::json(nullptr) : nlohmann::json(words); };
  nlohmann::json images = nlohmann::json::array();
  for (std::size_t n = 0; n < one.points.size(); ++n)
    images.push_back(text(scene::imageOf(one, n)));
  return {{"name", one.name},
          {"kind", scene::nameOf(one.kind)},
          {"points_mm", points},
          {"shown", one.shown},
          {"structure", text(one.structure)},
          {"structure_gone", one.structureGone},
          {"image", text(one.image)},
          {"images", std::move(images)},
          {"quantities", quantities}};
}

void addAll(Answer& answer, const scene::Case& value, const Measurement& one)
{
  for (const Quantity& quantity : presenters::quantitiesOf(value, one))
    answer.add(one.name, scene::nameOf(one.kind), quantity);
}

// Also between consecutive points of a line, and at each of its inner points.
void addLegs(Answer& answer, const scene::Case& value, const Measurement& line)
{
  for (std::size_t n = 1; line.kind == Kind::Length && n < line.points.size(); ++n)
  {
    Measurement leg = line;
    leg.kind = Kind::Distance;
    leg.points = {line.points[n - 1], line.points[n]};
    std::vector<std::string> images{scene::imageOf(line, n - 1), scene::imageOf(line, n)};
    scene::setImages(leg, images);
    Quantity quantity = presenters::quantitiesOf(value, leg).front();
    quantity.name = "distance " + std::to_string(n) + " to " + std::to_string(n + 1);
    answer.add(line.name, "distance", quantity);
    if (n + 1 == line.points.size())
      continue;
    leg.kind = Kind::Angle;
    leg.points.push_back(line.points[n + 1]);
    images.push_back(scene::imageOf(line, n + 1));
    scene::setImages(leg, images);
    quantity = presenters::quantitiesOf(value, leg).front();
    quantity.name = "angle at " + std::to_string(n + 1);
    answer.add(line.name, "angle", quantity);
  }
}

/// Names as they are typed: "x,y,z" is a point of its own.
std::optional<Eigen::Vector3d> pointIn(const std::string& text)
{
  if (std::count(text.begin(), text.end(), ',') != 2)
    return std::nullopt;
  Eigen::Vector3d point;
  std::size_t from = 0;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const auto number = core::parseDouble(std::string_view(text).substr(from, to - from));
    if (!number || !std::isfinite(*number))
      return std::nullopt;
    point[a] = *number;
    from = to + 1;
  }
  return point;
}

// A copy in which a typed point is a mark.
std::string asMark(scene::Case& value, const std::string& text, const std::string& image)
{
  const auto point = pointIn(text);
  if (!point)
    return text;
  Measurement mark;
  mark.name = scene::freeMeasurementName(value.measurements, text);
  mark.points = {*point};
  mark.image = image;
  value.measurements.push_back(mark);
  scene::checkMeasurements(value.measurements);
  return mark.name;
}

Measurement thickness(presenters::PointProbe& probe, const std::string& place)
{
  const auto point = pointIn(place);
  if (!point)
    throw UsageError("--wall: give a point as x,y,z in mm, not '" + place + "'");
  const auto wall = probe.wall(*point);
  if (!wall)
    throw core::InvalidParameter("--wall " + place +
                                 ": there is no surface within 3 mm; give a point on one");
  if (!wall->along)
    throw core::InvalidParameter("--wall " + place + ": nothing lies behind the wall within 30 mm");
  Measurement one;
  one.kind = Kind::Thickness;
  one.name = "thickness at " + place;
  one.points = {wall->surface, wall->along->point, wall->shortest->point};
  one.structure = wall->along->behind;
  return one;
}

void keep(scene::Case& value, Measurement one)
{
  one.name = scene::freeMeasurementName(value.measurements, one.name);
  value.measurements.push_back(std::move(one));
}

void measure(Context& context, const Options& options)
{
  context.refuseOverwriting({options.out}, {options.points});
  std::vector<Measurement> fresh;
  if (!options.points.empty())
    fresh = readMeasurements(options.points);
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const bool reads = !options.between.empty() || !options.dimensions.empty() ||
                     !options.along.empty() || !options.wall.empty() || options.dissection;
  presenters::LeftOut leftOut;
  if (reads)
    leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
  core::Progress progress = context.progress();
  Answer answer;
  std::vector<std::string> removed;
  for (const std::string& name : options.remove)
  {
    const std::size_t at = scene::findMeasurement(value, name);
    removed.push_back(value.measurements[at].name);
    value.measurements.erase(value.measurements.begin() + static_cast<std::ptrdiff_t>(at));
  }
  if (!options.image.empty() && !scene::findMr(value, options.image))
    throw core::InvalidParameter("case '" + value.name + "' has no MR '" + options.image + "'");
  for (Measurement& one : fresh)
  {
    std::vector<std::string> images;
    for (std::size_t n = 0; n < one.points.size(); ++n)
    {
      images.push_back(scene::imageOf(one, n).empty() ? options.image : scene::imageOf(one, n));
      if (!images.back().empty() && !scene::findMr(value, images.back()))
        throw core::InvalidParameter("case '" + value.name + "' has no MR '" + images.back() + "'");
    }
    scene::setImages(one, std::move(images));
    scene::setReadings(value, one);
    addAll(answer, value, one);
    addLegs(answer, value, one);
  }
  for (const std::string& structure : options.dimensions)
    for (const Quantity& quantity : presenters::dimensionsOf(value, structure, progress))
      answer.add(structure, "structure", quantity);
  if (!options.along.empty())
  {
    const auto at = [&](std::size_t n)
    {
      const auto point = pointIn(options.along[n]);
      if (!point)
        throw UsageError("--along: give two points as x,y,z in mm, not '" + options.along[n] + "'");
      return *point;
    };
    if (options.along.size() == 2)
      throw UsageError("--along: give the structure alone, or with two points");
    std::vector<Eigen::Vector3d> between;
    if (options.along.size() == 3)
      between = {at(1), at(2)};
    Measurement along = presenters::alongStructure(value, options.along.front(), between, progress);
    along.name = presenters::shownName("length of " + core::utf8Prefix(options.along.front(), 80));
    addAll(answer, value, along);
    fresh.push_back(std::move(along));
  }
  if (!options.wall.empty())
  {
    library.loadDissection(value);
    const volume::TissueField field = scene::tissueField(value, progress);
    presenters::PointProbe probe(value, field);
    for (const std::string& place : options.wall)
    {
      fresh.push_back(thickness(probe, place));
      addAll(answer, value, fresh.back());
    }
  }
  if (!options.between.empty())
  {
    scene::Case with = value;
    const std::string a = asMark(with, options.between[0], options.image);
    const std::string b = asMark(with, options.between[1], options.image);
    const presenters::Between between = presenters::distanceBetween(with, a, b, progress);
    const std::string name = options.between[0] + " - " + options.between[1];
    answer.add(name, "between", between.distance);
    answer.more["between"] = {{"from_mm", vectorJson(between.from)},
                              {"to_mm", vectorJson(between.to)},
                              {"distance_mm", *between.distance.value},
                              {"uncertainty_mm", orNull(between.distance.uncertainty)}};
    Measurement distance;
    distance.kind = Kind::Distance;
    distance.name = core::utf8Prefix(name, Measurement::kLongestName - 10);
    distance.points = {between.from, between.to};
    scene::setImages(distance, {between.images[0], between.images[1]});
    fresh.push_back(std::move(distance));
  }
  if (options.dissection)
  {
    library.loadDissection(value);
    warnMissingPlaces(context, value);
    warnOutdated(context, value);
    answer.more["without_place"] = missingPlacesJson(value);
    nlohmann::json all = nlohmann::json::array();
    for (const presenters::DissectionDistance& one :
         presenters::dissectionDistances(value, progress))
    {
      answer.add(one.name, "structure", one.distance);
      all.push_back({{"structure", one.name},
                     {"distance_mm", orNull(one.distance.value)},
                     {"uncertainty_mm", orNull(one.distance.uncertainty)},
                     {"removed_mm3", one.removed},
                     {"place_mm", vectorJson(one.place)}});
    }
    if (all.empty())
      context.warn("case '" + value.name +
                   "' has no distances of a dissection: nothing was "
                   "drilled, or there are no structures");
    answer.more["dissection"] = std::move(all);
  }
  if (options.save)
    for (Measurement& one : fresh)
      keep(value, std::move(one));
  const bool lists =
      options.list || (answer.rows.empty() && removed.empty() && !options.dissection);
  if (lists)
  {
    for (const Measurement& one : value.measurements)
      addAll(answer, value, one);
    for (const auto& [name, quantity] : presenters::volumesOf(value))
      answer.add(name, "structure", quantity);
  }
  context.refuseDamaged();
  if ((options.save && !fresh.empty()) || !removed.empty())
    library.save(value, progress);
  std::vector<std::vector<std::string>> cells{presenters::kMeasurementColumns};
  nlohmann::json rows = nlohmann::json::array();
  for (const Row& row : answer.rows)
  {
    cells.push_back(presenters::rowOf(row.name, row.kind, row.quantity));
    rows.push_back(quantityJson(row));
  }
  for (const std::string& name : removed)
    context.print("'" + name + "' is taken out of case '" + value.name + "'");
  if (!options.out.empty())
    core::writeFile(options.out, core::csvText(cells, ','));
  else
    for (const Row& row : answer.rows)
      context.print(row.name + ": " + row.quantity.name + " " + presenters::toString(row.quantity) +
                    (row.quantity.remark.empty() ? "" : "  (" + row.quantity.remark + ")"));
  if (answer.rows.empty() && removed.empty() && !options.dissection)
    context.print("case '" + value.name +
                  "' has no measurements and no structures; see 'petrous measure --help'");
  nlohmann::json measurements = nlohmann::json::array();
  for (const Measurement& one : value.measurements)
    measurements.push_back(measurementJson(value, one));
  answer.more["case"] = value.name;
  answer.more["rows"] = std::move(rows);
  answer.more["measurements"] = std::move(measurements);
  answer.more["removed"] = removed;
  answer.more["left_out"] = leftOutJson(value, leftOut);
  context.printJson(answer.more);
}

} // namespace

void addMeasureCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "measure", "Distances, lengths, angles, areas, walls and dimensions, with uncertainty",
      [options, &context] { measure(context, *options); });
  command->add_option("CASE", options->caseName, "Name of the case")->required();
  command
      ->add_option("--points", options->points,
                   "CSV with x_mm,y_mm,z_mm, patient LPS; rows of one name, if there is a column "
                   "name, are one measurement, of the kind in a column kind: mark, distance, "
                   "length, angle, area, thickness; a column image names the MR of each point")
      ->type_name("F.csv");
  command
      ->add_option("--image", options->image,
                   "The MR on which these points, and those of --between, were set, not the CT")
      ->type_name("MR");
  command
      ->add_option("--between", options->between,
                   "Shortest distance between two structures, marks or points x,y,z")
      ->type_name("A B")
      ->expected(2);
  command
      ->add_option("--dimensions", options->dimensions,
                   "Volume, extents along the principal axes, length and diameters of a structure; "
                   "may be repeated")
      ->type_name("STRUCTURE")
      ->allow_extra_args(false);
  command
      ->add_option("--along", options->along,
                   "Length of a structure's centre line, whole or between two points x,y,z")
      ->type_name("STRUCTURE [A B]")
      ->expected(1, 3);
  command
      ->add_option("--wall", options->wall,
                   "Thickness of the wall at the surface near a point, along the normal and "
                   "shortest; may be repeated")
      ->type_name("x,y,z")
      ->allow_extra_args(false);
  command->add_flag("--dissection", options->dissection,
                    "Shortest distance of what was drilled from each structure, nearest first");
  command->add_flag("--save", options->save, "Keep in the case what was measured");
  command->add_flag("--list", options->list,
                    "All measurements of the case and volumes of its structures (the default)");
  command->add_option("--remove", options->remove, "Take a measurement out; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "CSV to write (standard output)")->type_name("F.csv");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
