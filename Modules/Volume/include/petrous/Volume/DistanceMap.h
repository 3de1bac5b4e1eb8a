#pragma once

#include <cstddef>
#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// How deep a point lies in a structure: signed Euclidean distance to its surface, mm, positive
/// inside, up to the middle of the structure.
///
/// The surface is where the trilinear occupancy (SmoothedUnion.h) is 1/2: what is seen is what is
/// measured from. The distances stand on a grid of their own round the structure and are
/// interpolated by quadratic B-splines, so that depth and gradient are continuous, and the gradient
/// is the depth's own. Over about a voxel of that grid it turns from one side's direction to the
/// other's where two sides of the structure are equally near; between them it is shorter than 1.
///
/// Immutable; queries neither allocate nor throw and are thread-safe.
class DistanceMap
{
public:
  struct Sample
  {
    double depth = 0.0;                      ///< mm
    Eigen::Vector3d gradient{0.0, 0.0, 0.0}; ///< towards the deeper, patient axes; 1, or less
  };

  /// The map's own grid; `at` and `away` take its voxel coordinates.
  const core::GridGeometry& geometry() const noexcept { return m_coefficients.geometry(); }
  std::size_t bytes() const noexcept { return m_coefficients.bytes(); }
  double deepest() const noexcept { return m_deepest; } ///< mm, the greatest depth of a node

  /// The structure is at least so far away, mm; 0 where `at` can tell.
  double away(const Eigen::Vector3d& voxel) const noexcept;

  /// Only where `away` is 0.
  Sample at(const Eigen::Vector3d& voxel) const noexcept;

  /// Depth at a patient point, LPS mm; a bound from above far outside the structure.
  double depth(const Eigen::Vector3d& patient) const noexcept;

private:
  friend std::shared_ptr<const DistanceMap> makeDistanceMap(const Volume<float>& occupancy,
                                                            const core::GridGeometry& domain,
                                                            const core::Progress& progress,
                                                            std::size_t maxVoxels);
  explicit DistanceMap(Volume<float> coefficients);

  Volume<float> m_coefficients; // of the splines
  Eigen::Vector3d m_last;       // greatest voxel coordinate that `at` takes; the least is 1
  double m_border = 0.0;        // mm, from there to the structure at least
  double m_deepest = 0.0;
};

constexpr std::size_t kMaxDistanceVoxels = 8'000'000; ///< 32 MB

/// Measures a structure from its occupancy. Beyond the hull of `domain` and of the occupancy's own grid
/// there is no tissue, so these are surfaces where the structure reaches them.
///
/// The map's voxels are cubes of half the occupancy's least spacing; of large structures they are
/// larger, so that there are at most `maxVoxels`. At the surface the depth is 0 to about 0.02
/// voxel of the occupancy where the surface is smooth, more at its creases.
///
/// Null when no voxel lies inside. Throws CancelledError.
std::shared_ptr<const DistanceMap> makeDistanceMap(const Volume<float>& occupancy,
                                                   const core::GridGeometry& domain,
                                                   const core::Progress& progress = {},
                                                   std::size_t maxVoxels = kMaxDistanceVoxels);

} // namespace petrous::volume
