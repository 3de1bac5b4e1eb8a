#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/SurfaceUncertainty.h"
#include "petrous/Scene/Case.h"

namespace petrous::volume
{
class SurfaceDistance;
}

namespace petrous::presenters
{

struct NearStructure
{
  std::string name;
  double distance = 0.0; ///< mm to its surface, negative inside
};

/// Distance fields of a case's structures, each whole and on its own: removal, overlap with others
/// and touchable or drillable flags play no part.
///
/// A surface is the 1/2 level of the structure's own smoothed union (SmoothedUnion.h), or of a
/// mesh's voxelization; distances to it are accurate to a hundredth of its voxel, a tenth at
/// creases (volume::SurfaceDistance). A distance field is computed on first use (some tenths of a
/// second if large). Not thread-safe.
class StructureSurfaces
{
public:
  static constexpr double kFar = 1000.0; ///< mm; larger than any distance in a patient's head

  /// Loads the labels of the case and scans their voxels once. Meshes are included only if already
  /// voxelized for touch.
  explicit StructureSurfaces(const scene::Case& value);
  ~StructureSurfaces();

  std::size_t count() const noexcept { return m_structures.size(); }
  const std::string& name(std::size_t structure) const;
  double spacing(std::size_t structure) const; ///< mm, minimum spacing of its grid
  const SurfaceUncertainty& uncertainty(std::size_t structure) const;

  /// Computes its distance field now, if not yet done. Throws CancelledError.
  void measure(std::size_t structure, const core::Progress& progress = {});
  bool isMeasured(std::size_t structure) const noexcept;

  /// The same for another thread, apart from this, which may change or be gone meanwhile. `take`
  /// receives the result.
  using Measurer =
      std::function<std::shared_ptr<const volume::SurfaceDistance>(const core::Progress&)>;
  Measurer measurer(std::size_t structure) const;
  void take(std::size_t structure, std::shared_ptr<const volume::SurfaceDistance> measured);

  /// Signed distance of a patient point from the structure's surface, mm, negative inside; clamped
  /// to ±`most`.
  double distance(std::size_t structure, const Eigen::Vector3d& patient, double most);

  /// The point of the structure's surface that is nearest to a patient point, LPS mm.
  Eigen::Vector3d nearestPoint(std::size_t structure, const Eigen::Vector3d& patient);

  /// At most that, and cheaper (volume::SurfaceDistance::bound).
  double bound(std::size_t structure, const Eigen::Vector3d& patient, double most);

  /// The nearest of the structures for which `wanted` is true; none beyond `reach` mm.
  std::optional<NearStructure> nearest(const Eigen::Vector3d& patient, double reach,
                                       const std::function<bool(const std::string& name)>& wanted);

  /// Memory of the distance fields computed, as "labels.distance.NAME".
  std::map<std::string, std::size_t> resources() const;

private:
  struct Structure;
  std::vector<std::unique_ptr<Structure>> m_structures;
};

} // namespace petrous::presenters
