#include "petrous/Scene/StructureOccupancy.h"

#include <optional>

#include "DerivedKey.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/SmoothedUnion.h"
#include "petrous/Volume/VolumeBytes.h"

namespace petrous::scene
{

namespace
{

// The voxels of a box, extended by one on each side.
core::GridGeometry grownGrid(const core::GridGeometry& grid, const core::IndexBox& box)
{
  const core::Index3 size = box.size();
  return {
      {size[0] + 2, size[1] + 2, size[2] + 2},
      grid.spacing(),
      grid.patientFromVoxel(Eigen::Vector3d(box.lower[0] - 1, box.lower[1] - 1, box.lower[2] - 1)),
      grid.direction()};
}

std::optional<std::string> keyOf(const Case& value, const LabelPart& part, std::uint16_t index)
{
  DerivedKey key(value, "structure share", volume::kLabelFieldVersion);
  key.add(part);
  key.add(index);
  return key.text();
}

std::shared_ptr<const volume::Volume<float>>
keptOrMade(const volume::LabelMap& labels, std::uint16_t index, const core::IndexBox& box,
           core::DerivedStore* derived, const std::optional<std::string>& key)
{
  if (const auto bytes = key ? derived->find(*key) : std::nullopt)
    if (auto occupancy = volume::occupancyFrom(*bytes))
      return occupancy;
  auto occupancy = volume::makeSmoothedUnion(
      labels, [index](std::uint16_t i) { return i == index; }, box);
  if (occupancy && key)
    if (const auto bytes = volume::bytesOf(*occupancy))
      derived->put(*key, *bytes);
  return occupancy;
}

} // namespace

std::vector<StructureOccupancy> structureOccupancies(const Case& value)
{
  std::vector<StructureOccupancy> occupancies;
  for (const LabelPart& part : value.labels)
  {
    const Placement placement = placementOf(value, part);
    const std::shared_ptr<const volume::LabelMap> labels = labelsOnCt(value, part);
    if (!labels)
      continue;
    const core::GridGeometry& grid = labels->voxels->geometry();
    const auto boxes = volume::boxesOf(*labels);
    for (const StructurePart& structure : part.structures)
      for (std::size_t n = 0; n < boxes.size(); ++n)
      {
        const std::uint16_t index = labels->segments[n].index;
        if (index != structure.index || boxes[n].empty())
          continue;
        occupancies.push_back({structure.name, placement.drawnOn, grid, grownGrid(grid, boxes[n]),
                               [labels, index, box = boxes[n], derived = value.derived,
                                key = keyOf(value, part, index)]
                               { return keptOrMade(*labels, index, box, derived.get(), key); },
                               structure.readings});
      }
  }
  for (const MeshPart& mesh : value.meshes)
    if (const auto solid = mesh.touch.resident(); solid && placementOf(value, mesh).missing.empty())
      occupancies.push_back({mesh.name, mesh.drawnOn, solid->geometry(), solid->geometry(),
                             [solid] { return solid; }});
  return occupancies;
}

} // namespace petrous::scene
