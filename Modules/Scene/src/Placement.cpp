#include "petrous/Scene/Placement.h"

#include <algorithm>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace petrous::scene
{

namespace
{

Placement on(const Case& value, const std::string& mr)
{
  Placement placement;
  placement.drawnOn = mr;
  if (mr.empty())
    return placement;
  const ImagePart* image = findMr(value, mr);
  if (image && image->registered)
    placement.mrFromCt = image->mrFromCt;
  else
    placement.missing = "it was drawn on the MR '" + mr + "', which is " +
                        (image ? "not registered with the CT" : "not in the case");
  return placement;
}

std::shared_ptr<const volume::LabelMap> moved(const std::shared_ptr<const volume::LabelMap>& drawn,
                                              const core::RigidTransform& ctFromMr)
{
  using Voxels = volume::Volume<std::uint16_t>;
  // The voxels are shared and remain const.
  const std::shared_ptr<std::uint16_t> memory(drawn->voxels,
                                              const_cast<std::uint16_t*>(drawn->voxels->data()));
  auto map = std::make_shared<volume::LabelMap>(*drawn);
  map->voxels =
      std::make_shared<const Voxels>(movedGrid(drawn->voxels->geometry(), ctFromMr), memory);
  return map;
}

std::shared_ptr<const core::TriangleMesh>
movedMesh(const std::shared_ptr<const core::TriangleMesh>& drawn,
          const core::RigidTransform& ctFromMr)
{
  auto mesh = std::make_shared<core::TriangleMesh>(*drawn);
  for (auto& vertex : mesh->vertices)
    vertex = (ctFromMr * vertex.cast<double>()).cast<float>();
  return mesh;
}

} // namespace

core::GridGeometry movedGrid(const core::GridGeometry& grid, const core::RigidTransform& aFromB)
{
  return {grid.dims(), grid.spacing(), aFromB * grid.origin(),
          aFromB.rotation().toRotationMatrix() * grid.direction()};
}

std::vector<std::string> mrWithGrid(const Case& value, const core::GridGeometry& grid)
{
  std::vector<std::string> names;
  if (core::sameGrid(grid, value.ct.geometry))
    return names;
  for (const ImagePart& mr : value.mr)
    if (core::sameGrid(grid, mr.geometry))
      names.push_back(mr.name);
  return names;
}

Placement placementOf(const Case& value, const LabelPart& part)
{
  if (part.drawnOn || value.mr.empty() || !part.labels)
    return on(value, part.drawnOn.value_or(std::string()));
  const auto names = mrWithGrid(value, part.labels.get()->voxels->geometry());
  if (names.size() < 2)
    return on(value, names.empty() ? std::string() : names.front());
  Placement placement;
  placement.drawnOn = names.front();
  placement.missing = "it may have been drawn on any of the MR images " + listed(names) +
                      ", which have one grid; remove it and add it again as FILE@MR";
  return placement;
}

Placement placementOf(const Case& value, const MeshPart& part)
{
  return on(value, part.drawnOn);
}

std::string missingPlace(const Case& value, const std::string& name)
{
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (structure.name == name)
        return placementOf(value, part).missing;
  for (const MeshPart& mesh : value.meshes)
    if (mesh.name == name)
      return placementOf(value, mesh).missing;
  return {};
}

void readLabels(const std::vector<const LabelPart*>& parts)
{
  const auto read = [&parts](std::size_t n)
  {
    // Isolated: while a reader waits for its own tasks, it must not begin another part.
    tbb::this_task_arena::isolate(
        [&]
        {
          try
          {
            parts[n]->labels.get();
          }
          catch (...) // thrown again where it is used, so that the first part in order reports
          {
            return;
          }
        });
  };
  tbb::parallel_for(std::size_t{0}, parts.size(), read);
}

std::shared_ptr<const volume::LabelMap> labelsOnCt(const Case& value, const LabelPart& part)
{
  const Placement placement = placementOf(value, part);
  if (!placement.missing.empty())
    return nullptr;
  const auto drawn = part.labels.get();
  return placement.drawnOn.empty() ? drawn : part.moved.at(drawn, placement.mrFromCt, moved);
}

std::shared_ptr<const core::TriangleMesh> meshOnCt(const Case& value, const MeshPart& part)
{
  const Placement placement = placementOf(value, part);
  if (!placement.missing.empty())
    return nullptr;
  const auto drawn = part.mesh.get();
  return placement.drawnOn.empty() ? drawn : part.moved.at(drawn, placement.mrFromCt, movedMesh);
}

std::string listed(const std::vector<std::string>& names)
{
  constexpr std::size_t kMax = 6;
  std::string all;
  for (std::size_t n = 0; n < std::min(kMax, names.size()); ++n)
    all += (n == 0 ? "'" : ", '") + names[n] + "'";
  if (names.size() > kMax)
    all += " and " + std::to_string(names.size() - kMax) + " more";
  return all;
}

std::vector<std::string> drawnOnMr(const Case& value, const std::string& mr)
{
  std::vector<std::string> names;
  for (const LabelPart& part : value.labels)
    if (placementOf(value, part).drawnOn == mr)
      for (const StructurePart& structure : part.structures)
        names.push_back(structure.name);
  for (const MeshPart& mesh : value.meshes)
    if (mesh.drawnOn == mr)
      names.push_back(mesh.name);
  return names;
}

} // namespace petrous::scene
