#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Context.h"
#include "Numbers.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/NearestSurface.h"

namespace petrous::cli
{

namespace
{

// Search distance for a surface, mm.
constexpr double kReach = 20.0;

// Region around a point, mm, that usually contains its surface: evaluated for all points at once.
constexpr double kNear = 3.0;

std::string structureAt(const scene::Case& value, const std::vector<scene::MeshSolid>& meshes,
                        const Eigen::Vector3d& p)
{
  for (const auto& part : value.labels)
  {
    const auto labels = scene::labelsOnCt(value, part);
    if (!labels)
      continue;
    const auto& grid = labels->voxels->geometry();
    const Eigen::Vector3d v = grid.voxelFromPatient(p);
    const core::Index3 nearest{static_cast<int>(std::lround(v[0])),
                               static_cast<int>(std::lround(v[1])),
                               static_cast<int>(std::lround(v[2]))};
    if (!grid.fullBox().contains(nearest))
      continue;
    const std::uint16_t index = labels->voxels->at(nearest[0], nearest[1], nearest[2]);
    for (const auto& structure : part.structures)
      if (structure.index == index)
        return structure.name;
  }
  for (const scene::MeshSolid& mesh : meshes)
    if (volume::isInside(*mesh.occupancy, p))
      return mesh.part->name;
  return {};
}

std::string number(const std::optional<double>& value)
{
  return value ? core::generalText(*value, 9) : "";
}

void probe(Context& context, const std::string& name, const std::string& pointsFile,
           const std::string& out, bool withoutDamaged)
{
  context.refuseOverwriting({out}, {pointsFile});
  const auto points = readPoints(pointsFile);
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(name);
  library.loadDissection(value);
  const presenters::LeftOut leftOut = leaveOutDamaged(context, library, value, withoutDamaged);
  warnMissingPlaces(context, value);
  warnOutdated(context, value);
  const core::Progress progress = context.progress();
  const volume::TissueField field = scene::regionalTissueField(value, progress.part(0.0, 0.2));
  std::vector<const scene::LabelPart*> parts;
  for (const scene::LabelPart& part : value.labels)
    if (scene::placementOf(value, part).missing.empty())
      parts.push_back(&part);
  scene::readLabels(parts);
  const auto meshes = scene::meshSolidsAt(value, points, progress.part(0.2, 0.4));
  const core::Progress probing = progress.part(0.4, 1.0);
  std::vector<core::PatientBox> places;
  for (const Eigen::Vector3d& p : points)
    places.emplace_back(p - Eigen::Vector3d::Constant(kNear), p + Eigen::Vector3d::Constant(kNear));
  field.prepareEach(places);
  volume::NearestSurfaceSearch surface(field, kReach);
  const auto ct = value.ct.volume.get();

  std::string csv = "x_mm,y_mm,z_mm,f,hu,structure,distance_mm,nx,ny,nz\n";
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    probing.report(static_cast<double>(n) / static_cast<double>(points.size()), "probing");
    const Eigen::Vector3d& p = points[n];
    const Eigen::Vector3d voxel = ct->geometry().voxelFromPatient(p);
    std::optional<double> hu;
    if (ct->geometry().hullContains(voxel))
      hu = ct->sample(voxel);
    field.prepare({p, p});
    const auto nearest = surface.find(p);
    const std::string structure = structureAt(value, meshes, p);
    const auto component = [&](int axis)
    { return nearest ? std::optional<double>(nearest->normal[axis]) : std::nullopt; };
    const auto distance = nearest ? std::optional<double>(nearest->distance) : std::nullopt;
    csv += number(p[0]) + "," + number(p[1]) + "," + number(p[2]) + "," + number(field.value(p)) +
           "," + number(hu) + "," + structure + "," + number(distance) + "," +
           number(component(0)) + "," + number(component(1)) + "," + number(component(2)) + "\n";
    nlohmann::json row{{"x_mm", p[0]},           {"y_mm", p[1]},           {"z_mm", p[2]},
                       {"f", field.value(p)},    {"structure", structure}, {"hu", nullptr},
                       {"distance_mm", nullptr}, {"normal", nullptr}};
    if (hu)
      row["hu"] = *hu;
    if (nearest)
    {
      row["distance_mm"] = nearest->distance;
      row["normal"] = vectorJson(nearest->normal);
    }
    rows.push_back(std::move(row));
  }
  context.refuseDamaged();
  if (!out.empty())
    core::writeFile(out, csv);
  else
    context.print(csv.substr(0, csv.size() - 1));
  context.printJson({{"case", value.name},
                     {"points", std::move(rows)},
                     {"left_out", leftOutJson(value, leftOut)}});
}

} // namespace

void addProbeCommand(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name, points, out;
    bool withoutDamaged = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "probe", "Tissue field, HU, structure and nearest surface at points",
      [options, &context]
      { probe(context, options->name, options->points, options->out, options->withoutDamaged); });
  command->add_option("CASE", options->name)->required();
  command->add_option("--points", options->points, "CSV with x_mm,y_mm,z_mm, patient LPS")
      ->type_name("F.csv")
      ->required();
  command->add_option("--out", options->out, "CSV to write (standard output)")->type_name("F.csv");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
