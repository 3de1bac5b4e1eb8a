#pragma once

#include <map>
#include <string>
#include <vector>

#include "petrous/Presenters/MeasuredTool.h"
#include "petrous/Presenters/StructureSurfaces.h"

namespace petrous::presenters
{

/// Minimum distances of a tool to each structure along its path: from the burr's sphere, or the
/// points of an instrument, to the surface as defined by StructureSurfaces.
///
/// Accurate to kTolerance relative to that surface. Poses are stored and evaluated at the end where
/// the neighbouring ones and the path length between them leave room for a smaller distance. Not
/// thread-safe.
class StructureDistances
{
public:
  static constexpr double kTolerance = 0.02; ///< mm

  /// Loads the labels.
  StructureDistances(const scene::Case& value, const MeasuredTool& tool);

  void add(const haptics::Pose& pose); ///< X_PT

  /// By name, mm; 0 if the tool reached the structure. Empty before the first pose.
  std::map<std::string, double> smallest();

  std::map<std::string, std::size_t> resources() const { return m_surfaces.resources(); }

private:
  double nearest(std::size_t structure);

  StructureSurfaces m_surfaces;
  std::vector<haptics::Pose> m_poses;
  std::vector<double>
      m_way; // mm, at least the way of each of the tool's points since the first pose
  MeasuredTool m_tool;
};

} // namespace petrous::presenters
