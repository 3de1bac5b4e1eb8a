#pragma once

#include <map>
#include <string>
#include <vector>

#include "petrous/Presenters/StructureSurfaces.h"

namespace petrous::presenters
{

/// How near a burr came to each structure on its way: the smallest distance from the ball to its
/// surface as StructureSurfaces has it.
///
/// Within kTolerance of the surface's own distance. Positions are kept, and asked of at the end
/// where the ones before and after, and the way between, leave room for something nearer. One
/// thread.
class StructureDistances
{
public:
  static constexpr double kTolerance = 0.02; ///< mm

  /// Loads the labels. `radius` of the burr, mm.
  StructureDistances(const scene::Case& value, double radius);

  void add(const Eigen::Vector3d& centre); ///< of the burr, patient LPS mm

  /// By name, mm; 0 where the ball reached the structure. Empty before the first position.
  std::map<std::string, double> smallest();

  std::map<std::string, std::size_t> resources() const { return m_surfaces.resources(); }

private:
  double nearest(std::size_t structure);

  StructureSurfaces m_surfaces;
  std::vector<Eigen::Vector3d> m_positions;
  std::vector<double> m_way; // mm, from the first position to this one
  double m_radius;
};

} // namespace petrous::presenters
