#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

struct NearStructure
{
  std::string name;
  double distance = 0.0; ///< mm to its border, > 0
};

/// How far the structures of a case are from a place. Borders lie half way between voxels in and
/// out: the distance is right to half a voxel of the structure's grid. What was drilled plays no
/// part. One thread.
class StructureBorders
{
public:
  /// Loads the labels of the case and looks through their voxels once. Meshes that come without
  /// labels are taken where they have voxels for touch already.
  explicit StructureBorders(const scene::Case& value);

  /// The nearest of those structures for which `wanted`; nothing beyond `reach` mm.
  std::optional<NearStructure>
  nearest(const Eigen::Vector3d& patient, double reach,
          const std::function<bool(const std::string& name)>& wanted) const;

private:
  struct Border
  {
    std::string name;
    std::vector<Eigen::Vector3f> points; ///< patient mm
    Eigen::AlignedBox3d box;
  };
  std::vector<Border> m_borders;
};

} // namespace petrous::presenters
