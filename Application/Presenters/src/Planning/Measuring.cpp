#include "petrous/Presenters/Measuring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "NamedOccupancy.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/StructureShape.h"
#include "petrous/Presenters/SurfaceUncertainty.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/DistanceField.h"
#include "petrous/Volume/MeshMeasure.h"
#include "petrous/Volume/SurfaceArea.h"

namespace petrous::presenters
{

const std::vector<std::string> kMeasurementColumns{"name", "kind",        "quantity", "value",
                                                   "unit", "uncertainty", "remark"};

namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using scene::Measurement;
using Kind = Measurement::Kind;

// Of a point on a grid that may lie half a voxel off along each axis: half-widths squared, mm^2.
Matrix3d spreadOf(const core::GridGeometry& grid, const Matrix3d& ctFromImage)
{
  const Matrix3d axes = ctFromImage * grid.direction();
  return axes * (0.5 * grid.spacing()).cwiseAbs2().asDiagonal() * axes.transpose();
}

std::optional<Matrix3d> spreadAt(const scene::Case& value, const std::string& image)
{
  if (image.empty())
    return spreadOf(value.ct.geometry, Matrix3d::Identity());
  const scene::ImagePart* mr = scene::findMr(value, image);
  if (!mr)
    return std::nullopt;
  return spreadOf(mr->geometry, mr->mrFromCt.inverse().rotation().toRotationMatrix());
}

std::string voxelsOf(const scene::Case& value, const std::string& image)
{
  const scene::ImagePart* mr = image.empty() ? &value.ct : scene::findMr(value, image);
  if (!mr)
    return "set on the MR '" + image + "', which is gone";
  const Vector3d& edge = mr->geometry.spacing();
  return (image.empty() ? std::string("set on the ") + primaryName(value)
                        : "set on the MR '" + image + "'") +
         ", voxels " + core::fixedText(edge[0], 2) + " x " + core::fixedText(edge[1], 2) + " x " +
         core::fixedText(edge[2], 2) + " mm";
}

std::string joined(const std::vector<std::string>& phrases)
{
  std::string text;
  for (const std::string& phrase : phrases)
    if (!phrase.empty())
      text += (text.empty() ? "" : "; ") + phrase;
  return text;
}

// The points that were set on each image, in the order of their first ones.
std::vector<std::pair<std::string, std::vector<std::size_t>>> pointsByImage(const Measurement& one)
{
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
  for (std::size_t n = 0; n < one.points.size(); ++n)
  {
    const std::string& image = scene::imageOf(one, n);
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&image](const auto& group) { return group.first == image; });
    if (found == groups.end())
      groups.push_back({image, {n}});
    else
      found->second.push_back(n);
  }
  return groups;
}

constexpr const char* kErrorUnknown = "its registration's error unknown";

// Of the MR's registration, as a place on the CT depends on it.
struct RegistrationShare
{
  std::optional<double> millimetres; // none: unknown
  std::string text;
};
RegistrationShare registrationOf(const scene::Case& value, const Measurement& one,
                                 const std::string& image, const core::PatientBox& box)
{
  if (image.empty())
    return {0.0, {}};
  if (std::string outdated = scene::outdatedPoints(value, one, image); !outdated.empty())
    return {std::nullopt, std::move(outdated)};
  const auto error = registrationErrorIn(value, image, box);
  if (!error)
    return {std::nullopt, kErrorUnknown};
  return {error->p95, toString(*error)};
}

core::PatientBox boxOf(const std::vector<Vector3d>& points, const std::vector<std::size_t>& which)
{
  core::PatientBox box;
  for (const std::size_t n : which)
    box.extend(points[n]);
  return box;
}

// Whether points were set on the MR as it lay at different times.
bool hasSeveralPlaces(const Measurement& one, const std::string& mr)
{
  return std::count_if(one.readings.begin(), one.readings.end(),
                       [&mr](const scene::MrReading& reading) { return reading.mr == mr; }) > 1;
}

// Where the points were set: "points 1, 3 set on the CT, voxels ...; point 2 set on the MR ...".
std::string imagesOf(const scene::Case& value, const Measurement& one)
{
  if (one.images.empty())
    return joined({voxelsOf(value, one.image), hasSeveralPlaces(one, one.image)
                                                   ? scene::outdatedPoints(value, one, one.image)
                                                   : std::string()});
  std::vector<std::string> phrases;
  for (const auto& [image, points] : pointsByImage(one))
  {
    std::string which = points.size() > 1 ? "points " : "point ";
    for (std::size_t n = 0; n < points.size(); ++n)
      which += (n > 0 ? ", " : "") + std::to_string(points[n] + 1);
    phrases.push_back(which + " " + voxelsOf(value, image));
    phrases.push_back(registrationOf(value, one, image, boxOf(one.points, points)).text);
  }
  return joined(phrases);
}

int decimalsFor(const Quantity& quantity)
{
  const double by = quantity.uncertainty.value_or(0.05);
  return by >= 10.0 ? 0 : by >= 1.0 ? 1 : 2;
}

std::string fixed(double value, int decimals)
{
  const std::string text = core::fixedText(value, decimals);
  const bool isZero = text.find_first_not_of("-0.") == text.npos;
  return isZero && text.front() == '-' ? text.substr(1) : text;
}

const char* nameOfValue(Kind kind)
{
  switch (kind)
  {
  case Kind::Mark:
    return "position";
  case Kind::Thickness:
    return "thickness along the normal";
  default:
    return scene::nameOf(kind);
  }
}

std::vector<Quantity> coordinatesOf(const scene::Case& value, const Measurement& mark)
{
  const auto spread = spreadAt(value, mark.image);
  const RegistrationShare share =
      registrationOf(value, mark, mark.image, core::PatientBox(mark.points.front()));
  std::vector<Quantity> quantities;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    Quantity one{std::string(1, "xyz"[a]), mark.points.front()[a], "mm", std::nullopt, {}};
    if (spread && share.millimetres)
      one.uncertainty = std::hypot(std::sqrt((*spread)(a, a)), *share.millimetres);
    one.remark = joined({voxelsOf(value, mark.image), share.text});
    quantities.push_back(std::move(one));
  }
  return quantities;
}

// The ends of a line that follows a structure, each half a voxel off along the line.
std::optional<double> spreadOfEnds(const scene::Case& value, const Measurement& line)
{
  const auto spread = spreadAt(value, line.image);
  if (!spread)
    return std::nullopt;
  const auto along = [&](std::size_t from, std::size_t to)
  {
    const Vector3d way = line.points[to] - line.points[from];
    return way.norm() > 0.0 ? way.normalized().dot(*spread * way.normalized()) : 0.0;
  };
  const std::size_t last = line.points.size() - 1;
  return std::sqrt(along(0, 1) + along(last - 1, last));
}

// Surfaces of a structure: how far they may lie off, mm.
struct SurfaceShare
{
  std::optional<double> millimetres;
  std::string text;
};
SurfaceShare shareOf(const SurfaceUncertainty& uncertainty, bool comparesImages)
{
  // Within one structure its registration shifts all alike.
  SurfaceUncertainty own = uncertainty;
  if (!comparesImages)
  {
    own.registration.reset();
    own.drawnOn.clear();
    own.madeFrom.clear();
    own.outdated.clear();
  }
  return {own.incomplete() ? std::nullopt : std::optional<double>(own.millimetres()),
          toString(own)};
}

Vector3d unit(const Vector3d& v)
{
  return v.norm() > 0.0 ? Vector3d(v.normalized()) : Vector3d(Vector3d::Zero());
}

/// Derivatives of a value by its points, in its unit per mm.
///
///   |b - a|            (b - a) / |b - a| by b, and its opposite by a
///   angle at b, rad    -(component of c^ across a^) / (|a| sin) by a, a = A - B; likewise by C
///   area of a polygon  (next - previous) x n / 2
std::vector<Vector3d> slopesOf(Kind kind, const std::vector<Vector3d>& points)
{
  constexpr double kDegree = 57.29577951308232; // per rad
  std::vector<Vector3d> slopes(points.size(), Vector3d::Zero());
  const std::size_t count = points.size();
  if (kind == Kind::Distance || kind == Kind::Thickness || kind == Kind::Length)
  {
    // Of a thickness the third point belongs to another value.
    const std::size_t last = kind == Kind::Length ? count : 2;
    for (std::size_t n = 1; n < last; ++n)
    {
      const Vector3d along = unit(points[n] - points[n - 1]);
      slopes[n] += along;
      slopes[n - 1] -= along;
    }
  }
  else if (kind == Kind::Angle)
  {
    const Vector3d a = points[0] - points[1];
    const Vector3d c = points[2] - points[1];
    const Vector3d alongA = unit(a), alongC = unit(c);
    slopes[0] = -kDegree / a.norm() * unit(alongC - alongC.dot(alongA) * alongA);
    slopes[2] = -kDegree / c.norm() * unit(alongA - alongA.dot(alongC) * alongC);
    slopes[1] = -slopes[0] - slopes[2];
  }
  else if (kind == Kind::Area)
  {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t n = 0; n < count; ++n)
      sum += (points[n] - points[0]).cross(points[(n + 1) % count] - points[0]);
    const Vector3d normal = unit(sum);
    for (std::size_t n = 0; n < count; ++n)
      slopes[n] = 0.5 * (points[(n + 1) % count] - points[(n + count - 1) % count]).cross(normal);
  }
  return slopes;
}

// 95th percentile of what an MR's registration changes of a value by several points of that MR, in
// the value's unit: they shift, and turn, together. None without a spread.
std::optional<double> turned(const scene::Case& value, const std::string& image,
                             const std::vector<Vector3d>& points,
                             const std::vector<Vector3d>& slopes,
                             const std::vector<std::size_t>& which)
{
  const scene::ImagePart* mr = scene::findMr(value, image);
  if (!mr || !mr->registration || !mr->registration->error || !mr->registration->error->spread)
    return std::nullopt;
  const core::RigidSpread& spread = *mr->registration->error->spread;
  // d value = sum g (t + w x r) = t sum g + w sum r x g
  Eigen::Matrix<double, 6, 1> slope = Eigen::Matrix<double, 6, 1>::Zero();
  for (const std::size_t n : which)
  {
    slope.head<3>() += slopes[n];
    slope.tail<3>() += (points[n] - spread.about).cross(slopes[n]);
  }
  Matrix3d moments = Matrix3d::Zero(); // along one line
  moments(0, 0) = slope.dot(spread.moments * slope);
  return core::lengthQuantile(moments, core::kNormal95);
}

std::optional<double> volumeOf(const scene::Case& value, const std::string& name)
{
  if (const auto* structure = scene::findStructure(value, name))
    return structure->volume;
  for (const scene::MeshPart& mesh : value.meshes)
    if (mesh.name == name && mesh.mesh)
      return volume::measure(*mesh.mesh.get()).volume;
  return std::nullopt;
}

std::string safeForSpreadsheets(const std::string& text)
{
  return !text.empty() && std::string("=+-@\t").find(text.front()) != std::string::npos ? "'" + text
                                                                                        : text;
}

// "which was drawn on the MR 'T2'", "which was made from the MR 'T2'", of a structure or mesh;
// empty: neither, or there is none of that name.
std::string onMr(const scene::Case& value, const std::string& structure)
{
  const auto drawnOn = [](const std::string& mr)
  { return mr.empty() ? std::string() : "which was drawn on the MR '" + mr + "'"; };
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& one : part.structures)
      if (one.name == structure)
        return one.readings.empty() ? drawnOn(part.drawnOn.value_or(std::string()))
                                    : "which was made from the MR " + namesOf(one.readings);
  for (const scene::MeshPart& mesh : value.meshes)
    if (mesh.name == structure)
      return drawnOn(mesh.drawnOn);
  return {};
}

// Whether a part has the structure's name: another one, or itself with its axes corrected.
bool isThere(const scene::Case& value, const Measurement& measurement)
{
  return scene::kindOfPart(value, measurement.structure) != nullptr;
}

} // namespace

std::string toString(const Quantity& quantity)
{
  if (!quantity.value)
    return "unknown";
  const int decimals = decimalsFor(quantity);
  const std::string unit = quantity.unit == "°" ? "°" : " " + quantity.unit;
  const std::string text = fixed(*quantity.value, decimals) + unit;
  return quantity.uncertainty ? text + " ± " + fixed(*quantity.uncertainty, decimals)
                              : text + ", uncertainty unknown";
}

std::optional<double> propagated(const scene::Case& value, const Measurement& measurement)
{
  if (!scene::valueOf(measurement.kind, measurement.points))
    return std::nullopt;
  const std::vector<Vector3d> slopes = slopesOf(measurement.kind, measurement.points);
  const auto groups = pointsByImage(measurement);
  double square = 0.0, worst = 0.0, registrations = 0.0;
  for (const auto& [image, points] : groups)
  {
    const auto spread = spreadAt(value, image);
    if (!spread)
      return std::nullopt;
    double alone = 0.0; // as if all points had been set on this image
    for (const Vector3d& slope : slopes)
      alone += slope.dot(*spread * slope);
    worst = std::max(worst, alone);
    Vector3d together = Vector3d::Zero();
    for (const std::size_t n : points)
    {
      square += slopes[n].dot(*spread * slopes[n]);
      together += slopes[n];
    }
    // All of one image moves as a rigid whole, which changes no value of its points alone.
    if (groups.size() == 1 && !hasSeveralPlaces(measurement, image))
      continue;
    if (!scene::outdatedPoints(value, measurement, image).empty())
      return std::nullopt;
    if (const auto off = points.size() > 1
                             ? turned(value, image, measurement.points, slopes, points)
                             : std::nullopt)
    {
      registrations += *off * *off;
      continue;
    }
    const RegistrationShare share =
        registrationOf(value, measurement, image, boxOf(measurement.points, points));
    if (!share.millimetres)
      return std::nullopt;
    registrations += std::pow(*share.millimetres * together.norm(), 2);
  }
  const double all = std::max(square + registrations, worst);
  return all > 0.0 ? std::optional<double>(std::sqrt(all)) : std::nullopt;
}

std::vector<Quantity> quantitiesOf(const scene::Case& value, const Measurement& measurement)
{
  if (measurement.kind == Kind::Mark)
    return coordinatesOf(value, measurement);
  Quantity main{nameOfValue(measurement.kind), scene::valueOf(measurement.kind, measurement.points),
                scene::unitOf(measurement.kind), std::nullopt, imagesOf(value, measurement)};
  if (measurement.kind == Kind::Length && !measurement.structure.empty())
  {
    main.uncertainty = spreadOfEnds(value, measurement);
    main.remark = joined({"along the centre line of '" + shownName(measurement.structure) + "'" +
                              (!measurement.structureGone    ? ""
                               : isThere(value, measurement) ? ", which was removed or moved since"
                                                             : ", which was removed"),
                          main.remark});
    return {main};
  }
  main.uncertainty = propagated(value, measurement);
  if (measurement.kind == Kind::Area)
  {
    if (!main.value)
      main.remark = "its edges cross, so it has no area";
    else if (const double off = scene::offPlane(measurement.points); off > 0.05)
      main.remark =
          joined({"points up to " + core::fixedText(off, 2) + " mm off its plane", main.remark});
  }
  if (measurement.kind == Kind::Angle && !main.value)
    main.remark = "its points coincide";
  if (measurement.kind != Kind::Thickness)
    return {main};
  std::string remark;
  if (!measurement.structure.empty())
    remark = "to '" + shownName(measurement.structure) + "'" +
             (!measurement.structureGone    ? ""
              : isThere(value, measurement) ? ", which was removed or moved since"
                                            : ", which was removed");
  main.remark = joined({remark, main.remark});
  // What was drawn on an MR lies as well as that is registered, which the image's voxels do not
  // say.
  const std::string of =
      measurement.structureGone ? std::string() : onMr(value, measurement.structure);
  const bool isKnown = of.empty() && !measurement.structureGone;
  if (!isKnown)
    main.uncertainty.reset();
  main.remark = joined({main.remark, of});
  std::vector<Quantity> both{main};
  if (measurement.points.size() == 3)
  {
    Measurement shortest = measurement;
    shortest.points = {measurement.points[0], measurement.points[2]};
    both.push_back({"shortest thickness", scene::valueOf(Kind::Thickness, shortest.points), "mm",
                    isKnown ? propagated(value, shortest) : std::nullopt, main.remark});
  }
  return both;
}

std::string summaryOf(const scene::Case& value, const Measurement& measurement)
{
  const std::vector<Quantity> quantities = quantitiesOf(value, measurement);
  if (measurement.kind != Kind::Mark)
    return toString(quantities.front());
  std::string text;
  double most = 0.0;
  bool isKnown = true;
  for (const Quantity& one : quantities)
  {
    text += (text.empty() ? "" : ", ") + fixed(*one.value, 1);
    most = std::max(most, one.uncertainty.value_or(0.0));
    isKnown = isKnown && one.uncertainty;
  }
  return text + " mm" + (isKnown ? " ± " + fixed(most, 2) : ", uncertainty unknown");
}

std::vector<std::pair<std::string, Quantity>> volumesOf(const scene::Case& value)
{
  std::vector<std::pair<std::string, Quantity>> volumes;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      volumes.emplace_back(structure.name, Quantity{"volume", structure.volume, "mm³", std::nullopt,
                                                    "of its voxels"});
  if (!value.dissection.strokes().empty())
    volumes.emplace_back("drilled", Quantity{"volume", value.removedVolume(), "mm³", std::nullopt,
                                             "removed by the strokes that are applied"});
  return volumes;
}

namespace
{

// Diameter of the largest ball that fits inside, mm, to about half a voxel.
std::optional<double> thicknessOf(const volume::Volume<float>& occupancy,
                                  const core::Progress& progress)
{
  constexpr double kReach = 20.0; // mm; nothing in the temporal bone is thicker than twice this
  const auto distances = volume::makeDistanceField(occupancy, kReach, progress);
  if (!distances)
    return std::nullopt;
  const float* const first = distances->data();
  return 2.0 *
         std::max(0.0, -static_cast<double>(*std::min_element(first, first + distances->size())));
}

} // namespace

std::vector<Quantity> dimensionsOf(const scene::Case& value, const std::string& structure,
                                   const core::Progress& progress)
{
  const scene::StructureOccupancy known =
      namedOccupancy(value, structure, "dimensions", progress.part(0.0, 0.2));
  const auto occupancy = known.make();
  const auto box = occupancy ? principalBox(*occupancy) : std::nullopt;
  if (!box)
    throw core::InvalidParameter("dimensions: '" + structure + "' encloses nothing");
  const SurfaceShare share = shareOf(uncertaintyOf(value, known), false);
  const auto across = share.millimetres // two surfaces
                          ? std::optional<double>(std::sqrt(2.0) * *share.millimetres)
                          : std::nullopt;
  std::vector<Quantity> quantities;
  Quantity volume{"volume", volumeOf(value, structure), "mm³", std::nullopt, {}};
  if (!volume.value)
    volume.remark = "its surface is open";
  else if (share.millimetres)
  {
    const double area = volume::surfaceArea(
        *occupancy, [](const Vector3d&, const Vector3d&) { return true; }, progress.part(0.2, 0.5));
    volume.uncertainty = *share.millimetres * area;
    volume.remark = "if its whole surface lay half a voxel farther out or in; " + share.text;
  }
  quantities.push_back(std::move(volume));
  constexpr const char* kExtents[] = {"longest extent", "second extent", "third extent"};
  for (Eigen::Index a = 0; a < 3; ++a)
    quantities.push_back(
        {kExtents[a], box->extents[a], "mm", across,
         joined({"along a principal axis of inertia, direction " + fixed(box->axes(0, a), 3) +
                     ", " + fixed(box->axes(1, a), 3) + ", " + fixed(box->axes(2, a), 3) + " (LPS)",
                 share.text})});
  quantities.push_back({"largest thickness", thicknessOf(*occupancy, progress.part(0.5, 0.7)), "mm",
                        across, joined({"of the largest ball that fits inside", share.text})});
  std::string why;
  const auto line = centreLine(*occupancy, progress.part(0.7, 1.0), &why);
  if (!line)
  {
    quantities.push_back(
        {"length of the centre line", std::nullopt, "mm", std::nullopt, std::move(why)});
    return quantities;
  }
  quantities.push_back({"length of the centre line", line->length(), "mm", across, share.text});
  std::vector<double> diameters = line->diameters;
  std::sort(diameters.begin(), diameters.end());
  const std::string remark =
      joined({"of the circle with the area of the cross-section", share.text});
  quantities.push_back({"smallest diameter", diameters.front(), "mm", across, remark});
  quantities.push_back({"median diameter", diameters[diameters.size() / 2], "mm", across, remark});
  quantities.push_back({"largest diameter", diameters.back(), "mm", across, remark});
  return quantities;
}

Measurement alongStructure(const scene::Case& value, const std::string& structure,
                           const std::vector<Vector3d>& between, const core::Progress& progress)
{
  const scene::StructureOccupancy known =
      namedOccupancy(value, structure, "length", progress.part(0.0, 0.3));
  const auto occupancy = known.make();
  std::string why = "it encloses nothing";
  const auto line =
      occupancy ? centreLine(*occupancy, progress.part(0.3, 1.0), &why) : std::nullopt;
  if (!line)
    throw core::InvalidParameter("length: '" + structure + "' has no centre line: " + why);
  Measurement along;
  along.kind = Kind::Length;
  along.structure = structure;
  along.image = known.mr;
  along.points = between.size() == 2 ? partOf(*line, between[0], between[1]) : line->points;
  // As many as a measurement may have.
  if (along.points.size() > Measurement::kMostPoints)
  {
    const std::size_t stride = along.points.size() / Measurement::kMostPoints + 1;
    std::vector<Vector3d> fewer;
    for (std::size_t n = 0; n + 1 < along.points.size(); n += stride)
      fewer.push_back(along.points[n]);
    fewer.push_back(along.points.back());
    along.points = std::move(fewer);
  }
  return along;
}

Between distanceBetween(const scene::Case& value, const std::string& a, const std::string& b,
                        const core::Progress& progress)
{
  struct Side
  {
    std::optional<Vector3d> mark;
    std::string image;
    std::string keptImage; // of the end, as a measurement
    std::shared_ptr<const volume::Volume<float>> occupancy;
    std::optional<double> share; // mm
    std::optional<RegistrationErrorHere> registration;
    std::string text;
    bool isMade = false;  // from an MR, maybe not from it alone
    std::string outdated; // of a mark (scene::outdatedPoints)
  };
  const auto sideOf = [&](const std::string& name, const core::Progress& part)
  {
    Side side;
    const auto isNamed = [wanted = scene::lowerCase(name)](const Measurement& one)
    { return one.kind == Kind::Mark && scene::lowerCase(one.name) == wanted; };
    const auto mark = std::find_if(value.measurements.begin(), value.measurements.end(), isNamed);
    const char* kind = scene::kindOfPart(value, name);
    if (mark != value.measurements.end() && !kind)
    {
      side.mark = mark->points.front();
      side.image = side.keptImage = mark->image;
      side.outdated = scene::outdatedPoints(value, *mark, side.image);
      if (side.outdated.empty())
        side.registration =
            registrationErrorIn(value, side.image, core::PatientBox(mark->points.front()));
      else
        side.keptImage += " as it lay before";
      return side;
    }
    const scene::StructureOccupancy known = namedOccupancy(value, name, "distance", part);
    side.image = side.keptImage = known.mr;
    side.occupancy = known.make();
    if (!side.occupancy)
      throw core::InvalidParameter("distance: '" + name + "' encloses nothing");
    const SurfaceUncertainty uncertainty = uncertaintyOf(value, known);
    side.share = shareOf(uncertainty, false).millimetres;
    side.registration = uncertainty.registration;
    side.isMade = !uncertainty.madeFrom.empty();
    if (side.isMade) // an image that is not in the case has no known error
      side.keptImage =
          known.readings.front().mr + (uncertainty.outdated.empty() ? "" : " as it lay before");
    side.text = "'" + name + "': " + toString(uncertainty);
    return side;
  };
  Side one = sideOf(a, progress.part(0.0, 0.2));
  Side other = sideOf(b, progress.part(0.2, 0.4));
  Between result{{"shortest distance", std::nullopt, "mm", std::nullopt, {}},
                 Vector3d::Zero(),
                 Vector3d::Zero(),
                 {one.keptImage, other.keptImage}};
  ShortestWay way;
  if (one.mark && other.mark)
    way = {(*one.mark - *other.mark).norm(), *one.mark, *other.mark};
  else if (one.mark)
    way = shortestWay(*one.mark, volume::SurfaceDistance(other.occupancy, progress.part(0.4, 1.0)));
  else if (other.mark)
  {
    way = shortestWay(*other.mark, volume::SurfaceDistance(one.occupancy, progress.part(0.4, 1.0)));
    std::swap(way.from, way.to);
  }
  else
  {
    const bool swapped = one.occupancy->size() > other.occupancy->size();
    const Side& from = swapped ? other : one;
    const Side& to = swapped ? one : other;
    const volume::SurfaceDistance surface(to.occupancy, progress.part(0.4, 0.7));
    const auto found = shortestWay(*from.occupancy, surface, progress.part(0.7, 1.0));
    if (!found)
      throw core::InvalidParameter("distance: '" + (swapped ? b : a) + "' has no surface");
    way = *found;
    if (swapped)
      std::swap(way.from, way.to);
  }
  result.from = way.from;
  result.to = way.to;
  result.distance.value = way.distance;
  // A registration counts where it brings together what was set on different images; a structure
  // has the greatest error over its box, as in the remark.
  const Vector3d direction = way.distance > 0.0 ? Vector3d((way.to - way.from) / way.distance)
                                                : Vector3d(Vector3d::Zero());
  double square = 0.0;
  bool isKnown = true;
  std::vector<std::string> remarks;
  for (const Side* side : {&one, &other})
  {
    if (side->mark)
    {
      const auto spread = spreadAt(value, side->image);
      isKnown = isKnown && spread && way.distance > 0.0;
      square += spread ? direction.dot(*spread * direction) : 0.0;
      remarks.push_back("mark " + voxelsOf(value, side->image));
    }
    else
    {
      isKnown = isKnown && side->share;
      square += side->share.value_or(0.0) * side->share.value_or(0.0);
      remarks.push_back(side->text);
    }
    // What was made from an MR may be of other images too, so that one registration of both sides
    // need not move both alike.
    const bool movesAlike = one.image == other.image && !one.isMade && !other.isMade &&
                            one.outdated.empty() && other.outdated.empty();
    if (!side->isMade && (movesAlike || side->image.empty()))
      continue;
    if (side->mark) // a structure's text has it
      remarks.push_back(side->registration       ? toString(*side->registration)
                        : side->outdated.empty() ? std::string(kErrorUnknown)
                                                 : side->outdated);
    isKnown = isKnown && side->registration;
    const double p95 = side->registration ? side->registration->p95 : 0.0;
    square += p95 * p95;
  }
  if (isKnown)
    result.distance.uncertainty = std::sqrt(square);
  if (way.distance == 0.0)
    remarks.insert(remarks.begin(), "they touch or overlap");
  result.distance.remark = joined(remarks);
  return result;
}

std::vector<std::string> rowOf(const std::string& name, const std::string& kind,
                               const Quantity& quantity)
{
  const auto number = [](const std::optional<double>& value)
  { return value ? core::generalText(*value, 9) : std::string("unknown"); };
  return {safeForSpreadsheets(name),
          kind,
          quantity.name,
          number(quantity.value),
          quantity.unit,
          number(quantity.uncertainty),
          safeForSpreadsheets(quantity.remark)};
}

bool hasMeasurementRows(const scene::Case& value)
{
  return !value.measurements.empty() || !volumesOf(value).empty();
}

std::string measurementsCsv(const scene::Case& value)
{
  std::vector<std::vector<std::string>> rows{kMeasurementColumns};
  for (const Measurement& one : value.measurements)
    for (const Quantity& quantity : quantitiesOf(value, one))
      rows.push_back(rowOf(one.name, scene::nameOf(one.kind), quantity));
  for (const auto& [name, quantity] : volumesOf(value))
    rows.push_back(rowOf(name, "structure", quantity));
  return core::csvText(rows, ',');
}

} // namespace petrous::presenters
