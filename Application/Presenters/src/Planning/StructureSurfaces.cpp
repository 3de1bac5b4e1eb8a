#include "petrous/Presenters/StructureSurfaces.h"

#include <algorithm>
#include <utility>

#include "petrous/Presenters/StructureShape.h"
#include "petrous/Scene/StructureOccupancy.h"
#include "petrous/Volume/SurfaceDistance.h"

namespace petrous::presenters
{

struct StructureSurfaces::Structure
{
  Structure(scene::StructureOccupancy known, const SurfaceUncertainty& surface)
    : occupancy(std::move(known))
    , uncertainty(surface)
  {
    box = occupancy.around.patientBounds();
  }

  const volume::SurfaceDistance& surface(const core::Progress& progress = {})
  {
    if (!measured)
      measured = measurer()(progress);
    return *measured;
  }

  Measurer measurer() const
  {
    return [make = occupancy.make](const core::Progress& progress)
    {
      progress.check("measuring structures");
      return std::make_shared<const volume::SurfaceDistance>(make(), progress);
    };
  }

  scene::StructureOccupancy occupancy;
  SurfaceUncertainty uncertainty;
  core::PatientBox box;
  std::shared_ptr<const volume::SurfaceDistance> measured;
};

StructureSurfaces::StructureSurfaces(const scene::Case& value)
{
  for (scene::StructureOccupancy& occupancy : scene::structureOccupancies(value))
  {
    const SurfaceUncertainty uncertainty = uncertaintyOf(value, occupancy);
    m_structures.push_back(std::make_unique<Structure>(std::move(occupancy), uncertainty));
  }
}

StructureSurfaces::~StructureSurfaces() = default;

const std::string& StructureSurfaces::name(std::size_t structure) const
{
  return m_structures[structure]->occupancy.name;
}

double StructureSurfaces::spacing(std::size_t structure) const
{
  return m_structures[structure]->occupancy.grid.minSpacing();
}

const SurfaceUncertainty& StructureSurfaces::uncertainty(std::size_t structure) const
{
  return m_structures[structure]->uncertainty;
}

void StructureSurfaces::measure(std::size_t structure, const core::Progress& progress)
{
  m_structures[structure]->surface(progress);
}

bool StructureSurfaces::isMeasured(std::size_t structure) const noexcept
{
  return m_structures[structure]->measured != nullptr;
}

StructureSurfaces::Measurer StructureSurfaces::measurer(std::size_t structure) const
{
  return m_structures[structure]->measurer();
}

void StructureSurfaces::take(std::size_t structure,
                             std::shared_ptr<const volume::SurfaceDistance> measured)
{
  m_structures[structure]->measured = std::move(measured);
}

double StructureSurfaces::distance(std::size_t structure, const Eigen::Vector3d& patient,
                                   double most)
{
  Structure& asked = *m_structures[structure];
  if (asked.box.squaredExteriorDistance(patient) >= most * most)
    return most;
  return asked.surface().at(patient, most);
}

Eigen::Vector3d StructureSurfaces::nearestPoint(std::size_t structure,
                                                const Eigen::Vector3d& patient)
{
  return shortestWay(patient, m_structures[structure]->surface()).to;
}

double StructureSurfaces::bound(std::size_t structure, const Eigen::Vector3d& patient, double most)
{
  Structure& asked = *m_structures[structure];
  if (asked.box.squaredExteriorDistance(patient) >= most * most)
    return most;
  return asked.surface().bound(patient, most);
}

std::optional<NearStructure>
StructureSurfaces::nearest(const Eigen::Vector3d& patient, double reach,
                           const std::function<bool(const std::string& name)>& wanted)
{
  std::optional<NearStructure> nearest;
  double best = reach;
  for (std::size_t n = 0; n < m_structures.size(); ++n)
  {
    if (!wanted(m_structures[n]->occupancy.name))
      continue;
    const double there = distance(n, patient, best);
    if (!(there < best))
      continue;
    best = std::abs(there);
    nearest = NearStructure{m_structures[n]->occupancy.name, there};
  }
  return nearest;
}

std::map<std::string, std::size_t> StructureSurfaces::resources() const
{
  std::map<std::string, std::size_t> resources;
  for (const auto& structure : m_structures)
    if (structure->measured)
      resources["labels.distance." + structure->occupancy.name] = structure->measured->bytes();
  return resources;
}

} // namespace petrous::presenters
