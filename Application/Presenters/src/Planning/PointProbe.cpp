#include "petrous/Presenters/PointProbe.h"

#include <cmath>

#include "petrous/Scene/Placement.h"
#include "petrous/Volume/MeshSolid.h"

namespace petrous::presenters
{

PointProbe::PointProbe(const scene::Case& value, const volume::TissueField& field)
  : m_ct(value.ct.volume.get())
  , m_meshes(scene::meshSolids(value, [](const auto&) { return true; }))
  , m_surface(field, kReach)
{
  for (const scene::LabelPart& part : value.labels)
    if (auto labels = scene::labelsOnCt(value, part))
      m_labels.push_back({std::move(labels), part.structures});
}

std::string PointProbe::structureAt(const Eigen::Vector3d& patient) const
{
  for (const Labels& part : m_labels)
  {
    const auto& voxels = *part.map->voxels;
    const Eigen::Vector3d voxel = voxels.geometry().voxelFromPatient(patient);
    const core::Index3 nearest{static_cast<int>(std::lround(voxel[0])),
                               static_cast<int>(std::lround(voxel[1])),
                               static_cast<int>(std::lround(voxel[2]))};
    if (!voxels.geometry().fullBox().contains(nearest))
      continue;
    const std::uint16_t index = voxels.at(nearest[0], nearest[1], nearest[2]);
    for (const scene::StructurePart& structure : part.structures)
      if (structure.index == index)
        return structure.name;
  }
  for (const scene::MeshSolid& mesh : m_meshes)
    if (volume::isInside(*mesh.occupancy, patient))
      return mesh.part->name;
  return {};
}

PlaceReading PointProbe::at(const Eigen::Vector3d& patient)
{
  PlaceReading reading;
  const Eigen::Vector3d voxel = m_ct->geometry().voxelFromPatient(patient);
  if (m_ct->geometry().hullContains(voxel))
    reading.hounsfield = m_ct->sample(voxel);
  reading.structure = structureAt(patient);
  if (const auto nearest = m_surface.find(patient))
    reading.surface = nearest->distance;
  return reading;
}

} // namespace petrous::presenters
