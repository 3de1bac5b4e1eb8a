#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Scene/Case.h"
#include "petrous/Volume/NearestSurface.h"

namespace petrous::presenters
{

struct NearStructure
{
  std::string name;
  double distance = 0.0; ///< mm to its surface, negative within
};

/// The structures of a case, each whole and alone, to measure how far they are: what was drilled,
/// what lies before one and what it is to hand and drill play no part.
///
/// A surface is the 1/2 level of the structure's own smoothed union (SmoothedUnion.h), or of the
/// voxels of a mesh; distances hold for that surface to some hundredths of its voxel. One thread.
class StructureSurfaces
{
public:
  static constexpr double kFar = 1000.0; ///< mm; nothing of a patient's head is farther

  /// Loads the labels of the case and looks through their voxels once. Of meshes those are taken
  /// that have voxels for touch already.
  explicit StructureSurfaces(const scene::Case& value);
  ~StructureSurfaces();

  std::size_t count() const noexcept { return m_structures.size(); }
  const std::string& name(std::size_t structure) const;
  double spacing(std::size_t structure) const; ///< mm, the least of its grid

  /// From a patient point to the structure's surface, mm, negative within; `most` where it is
  /// farther.
  double distance(std::size_t structure, const Eigen::Vector3d& patient, double most);

  /// The nearest of those structures for which `wanted`; nothing beyond `reach` mm.
  std::optional<NearStructure> nearest(const Eigen::Vector3d& patient, double reach,
                                       const std::function<bool(const std::string& name)>& wanted);

private:
  struct Structure;
  std::vector<std::unique_ptr<Structure>> m_structures;
};

} // namespace petrous::presenters
