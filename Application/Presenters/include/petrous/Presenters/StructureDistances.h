#pragma once

#include <map>
#include <string>
#include <vector>

#include "petrous/Presenters/StructureSurfaces.h"

namespace petrous::presenters
{

/// Minimum distances of a burr to each structure along its path: from the sphere to the surface as
/// defined by StructureSurfaces.
///
/// Accurate to kTolerance relative to that surface. Positions are stored and evaluated at the end
/// where the neighbouring positions and the path length between them leave room for a smaller
/// distance. Not thread-safe.
class StructureDistances
{
public:
  static constexpr double kTolerance = 0.02; ///< mm

  /// Loads the labels. `radius` of the burr, mm.
  StructureDistances(const scene::Case& value, double radius);

  void add(const Eigen::Vector3d& centre); ///< of the burr, patient LPS mm

  /// By name, mm; 0 if the sphere reached the structure. Empty before the first position.
  std::map<std::string, double> smallest();

  std::map<std::string, std::size_t> resources() const { return m_surfaces.resources(); }

private:
  double nearest(std::size_t structure);

  StructureSurfaces m_surfaces;
  std::vector<Eigen::Vector3d> m_positions;
  std::vector<double> m_way; // mm, path length from the first position to this one
  double m_radius;
};

} // namespace petrous::presenters
