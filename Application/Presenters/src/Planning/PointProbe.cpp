#include "petrous/Presenters/PointProbe.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Scene/Placement.h"
#include "petrous/Scene/StructureOccupancy.h"
#include "petrous/Volume/MeshSolid.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::presenters
{

PointProbe::PointProbe(const scene::Case& value, const volume::TissueField& field)
  : m_value(value)
  , m_field(field)
  , m_ct(value.ct.volume.get())
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

namespace
{

constexpr double kDegree = 0.017453292519943295; // rad
constexpr double kNearWall = 3.0;                // mm
constexpr int kDirections = 600;                 // of the cone
constexpr int kRefined = 80;                     // about the best one, twice

/// Directions evenly spread in a cone about an axis [Fibonacci lattice], that along it first.
std::vector<Eigen::Vector3d> cone(const Eigen::Vector3d& axis, double halfAngle, int count)
{
  constexpr double kGolden = 2.399963229728653; // rad
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  std::vector<Eigen::Vector3d> directions{axis};
  for (int n = 1; n < count; ++n)
  {
    const double height = 1.0 - (1.0 - std::cos(halfAngle)) * n / (count - 1);
    const double across = std::sqrt(std::max(0.0, 1.0 - height * height));
    directions.push_back(height * axis +
                         across * (std::cos(kGolden * n) * u + std::sin(kGolden * n) * v));
  }
  return directions;
}

/// Where `holds` begins to be false between two distances, mm.
template <class Holds>
double borderOf(double yes, double no, const Holds& holds)
{
  for (int n = 0; n < 14; ++n)
  {
    const double middle = 0.5 * (yes + no);
    (holds(middle) ? yes : no) = middle;
  }
  return 0.5 * (yes + no);
}

double shareAt(const volume::Volume<float>& occupancy, const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d voxel = occupancy.geometry().voxelFromPatient(patient);
  return occupancy.geometry().hullContains(voxel) ? volume::sampleTrilinear(occupancy, voxel) : 0.0;
}

} // namespace

const volume::Volume<float>* PointProbe::occupancyOf(const std::string& structure)
{
  if (const auto known = m_occupancies.find(structure); known != m_occupancies.end())
    return known->second.get();
  auto& made = m_occupancies[structure];
  for (const scene::StructureOccupancy& occupancy : scene::structureOccupancies(m_value))
    if (occupancy.name == structure)
      made = occupancy.make();
  return made.get();
}

// Through tissue, up to the first place that is none, or that is another structure's.
std::optional<WallReading::End> PointProbe::wayOut(const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& direction, double reach,
                                                   const std::string& own)
{
  const double step = 0.25 * m_field.finestSpacing();
  const auto isTissue = [&](double way) { return m_field.value(from + way * direction) > 0.0; };
  for (double way = 2.0 * step; way <= reach; way += step)
  {
    const Eigen::Vector3d at = from + way * direction;
    if (!isTissue(way))
    {
      const double end = borderOf(way - step, way, isTissue);
      return WallReading::End{from + end * direction,
                              structureAt(from + (end + 2.0 * step) * direction)};
    }
    const std::string name = structureAt(at);
    if (name.empty() || name == own)
      continue;
    const auto* part = scene::findStructure(m_value, name);
    if (part && !part->look.solid)
      continue; // its walls are tissue
    const volume::Volume<float>* occupancy = occupancyOf(name);
    if (!occupancy || shareAt(*occupancy, at) < 0.5)
      continue;
    const double end =
        borderOf(std::max(0.0, way - 4.0 * step), way,
                 [&](double there) { return shareAt(*occupancy, from + there * direction) < 0.5; });
    return WallReading::End{from + end * direction, name};
  }
  return std::nullopt;
}

std::optional<WallReading> PointProbe::wall(const Eigen::Vector3d& patient,
                                            const core::Progress& progress)
{
  progress.check("wall");
  const auto nearest = m_surface.find(patient, kNearWall);
  if (!nearest)
    return std::nullopt;
  WallReading reading;
  reading.surface = nearest->point;
  const Eigen::Vector3d box = Eigen::Vector3d::Constant(kNearWall);
  m_field.prepare({reading.surface - box, reading.surface + box});
  Eigen::Vector3d outward = m_field.smoothNormal(reading.surface);
  if (outward.norm() < 0.5)
    outward = nearest->normal;
  reading.inward = -outward.normalized();
  const std::string own =
      structureAt(reading.surface + 0.5 * m_field.finestSpacing() * reading.inward);
  const Eigen::Vector3d whole = Eigen::Vector3d::Constant(kThickest);
  progress.check("wall");
  m_field.prepare({reading.surface - whole, reading.surface + whole});
  reading.along = wayOut(reading.surface, reading.inward, kThickest, own);
  if (!reading.along)
    return reading;
  reading.shortest = reading.along;
  double best = (reading.along->point - reading.surface).norm();
  Eigen::Vector3d axis = reading.inward;
  double angle = kTilt * kDegree;
  for (const int count : {kDirections, kRefined, kRefined})
  {
    for (const Eigen::Vector3d& direction : cone(axis, angle, count))
    {
      progress.check("wall");
      if (direction.dot(reading.inward) < std::cos(kTilt * kDegree) - 1e-9)
        continue;
      const auto end = wayOut(reading.surface, direction, best, own);
      const double way = end ? (end->point - reading.surface).norm() : best;
      if (way >= best)
        continue;
      best = way;
      reading.shortest = end;
    }
    axis = (reading.shortest->point - reading.surface).normalized();
    angle = angle > 0.5 ? 0.12 : 0.02;
  }
  return reading;
}

} // namespace petrous::presenters
