#pragma once

#include <cstddef>
#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Depth of a point in a structure: signed Euclidean distance to its surface, mm, positive inside,
/// up to the medial axis of the structure.
///
/// The surface is the 1/2 level of the trilinear occupancy (SmoothedUnion.h), so measurements refer
/// to the rendered surface. Distances are sampled on a separate grid around the structure and
/// interpolated by quadratic B-splines, so that depth and gradient are continuous and the gradient
/// is that of the depth. Within about a voxel of that grid around the medial axis the gradient
/// turns from one side's direction to the other's; there it is shorter than 1.
///
/// Immutable; queries neither allocate nor throw and are thread-safe.
class DistanceMap
{
public:
  struct Sample
  {
    double depth = 0.0;                      ///< mm
    Eigen::Vector3d gradient{0.0, 0.0, 0.0}; ///< towards greater depth, patient axes; length <= 1
  };

  /// The map's own grid; `at` and `away` take its voxel coordinates.
  const core::GridGeometry& geometry() const noexcept { return m_coefficients.geometry(); }
  std::size_t bytes() const noexcept { return m_coefficients.bytes(); }
  double deepest() const noexcept { return m_deepest; } ///< mm, maximum depth of a node

  /// Lower bound of the distance to the structure, mm; 0 where `at` is valid.
  double away(const Eigen::Vector3d& voxel) const noexcept;

  /// Only valid where `away` is 0.
  Sample at(const Eigen::Vector3d& voxel) const noexcept;

  /// Depth at a patient point, LPS mm; an upper bound far outside the structure.
  double depth(const Eigen::Vector3d& patient) const noexcept;

private:
  friend std::shared_ptr<const DistanceMap> makeDistanceMap(const Volume<float>& occupancy,
                                                            const core::GridGeometry& domain,
                                                            const core::Progress& progress,
                                                            std::size_t maxVoxels);
  explicit DistanceMap(Volume<float> coefficients);

  Volume<float> m_coefficients; // spline coefficients
  Eigen::Vector3d m_last;       // maximum voxel coordinate that `at` takes; the minimum is 1
  double m_border = 0.0;        // mm, lower bound of the distance from there to the structure
  double m_deepest = 0.0;
};

constexpr std::size_t kMaxDistanceVoxels = 8'000'000; ///< 32 MB

/// Computes the map of a structure from its occupancy. There is no tissue beyond the hulls of
/// `domain` and of the occupancy's own grid, so their faces are surfaces where the structure
/// reaches them.
///
/// The map's voxels are cubes with half the occupancy's minimum spacing; they are larger for large
/// structures, so that there are at most `maxVoxels`. At the surface the depth is 0 to within about
/// 0.02 voxel of the occupancy where the surface is smooth, less accurate at creases.
///
/// Returns nullptr if no voxel is inside. Throws CancelledError.
std::shared_ptr<const DistanceMap> makeDistanceMap(const Volume<float>& occupancy,
                                                   const core::GridGeometry& domain,
                                                   const core::Progress& progress = {},
                                                   std::size_t maxVoxels = kMaxDistanceVoxels);

} // namespace petrous::volume
