#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// The border between the voxels inside (1) and outside (0) as a net of points: one in each cell of
/// eight voxel centres that the border passes, joined across the faces that it passes (Gibson 1998,
/// "Constrained elastic surface nets"). Positions are in voxels.
///
/// `relax` moves the points, each within its cell, so that the net has no voxel steps: a point goes
/// along its normal until the curvature there is that of its neighbourhood. Plane, cylinder and
/// ball are at rest, so that nothing shrinks, and since the net has two sides a sheet one voxel
/// thin is as safe as a thick one.
class SurfaceNet
{
public:
  /// Whether a cell, named by its lowest voxel, may have a point.
  using Wanted = std::function<bool(const core::Index3& cell)>;

  /// `inside` must be 0 on its outermost voxels, and must live as long as this. Where cells are not
  /// wanted the net has an edge, and voxels count as far from it.
  SurfaceNet(const Volume<std::uint8_t>& inside, const core::Progress& progress,
             const Wanted& wanted = {});

  void relax(const core::Progress& progress);

  /// Signed distance of voxel centres from the net in voxels, above 0 inside, as a share:
  ///   1/2 + distance / kShareReach, from 0 to 1
  /// A voxel inside stays above 1/2 and one outside below, in steps of 1/65535. `share` must be 0
  /// everywhere.
  ///
  /// Not so where the inside is one voxel thin, which leaves the net too little to go by: there
  /// voxels that touch by an edge or a corner only are joined, which trilinear interpolation of
  /// distances would not do; and where it is a sheet or a rod, the distance is that from the plane
  /// or line fitted to it, a voxel in a gap of which may come to lie inside.
  void writeShare(Volume<float>& share, const core::Progress& progress) const;

  /// Voxels from a share of nothing to one: 2 sqrt(3), so that on equal voxels the share falls as a
  /// cut's mask does, and a mask that keeps a structure leaves all of it (SweptSphereCut.h).
  static constexpr float kShareReach = 3.4641016F;
  static float shareOf(double depth) noexcept; ///< in voxels, > 0 inside; to the nearest step
  static double depthOf(float share) noexcept;

private:
  static core::Index3 cornerOf(int corner) noexcept
  {
    return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
  }
  static core::Index3 voxelOf(const core::Index3& cell, int corner) noexcept
  {
    const core::Index3 up = cornerOf(corner);
    return {cell[0] + up[0], cell[1] + up[1], cell[2] + up[2]};
  }
  struct Point
  {
    core::Index3 cell;
    std::uint8_t corners; ///< which of its voxels are inside, the first axis fastest
  };

  std::vector<std::array<float, 2>> heightsIn(const core::IndexBox& tile) const;
  void writeDistances(Volume<float>& share, const core::Progress& progress) const;
  void joinThin(Volume<float>& share, const std::vector<std::uint8_t>& thin) const;
  void fitThin(Volume<float>& share, const std::vector<std::uint8_t>& thin) const;
  std::vector<std::uint8_t> thinCorners() const;
  bool isThin(const core::Index3& voxel) const noexcept;
  void findPoints(const core::Progress& progress, const Wanted& wanted);
  void join();
  void findNormals();
  template <class T, class WeightOf>
  void average(std::vector<T>& values, std::vector<T>& scratch, int rounds,
               const WeightOf& weightOf) const;
  int pointAt(int i, int j, int k) const noexcept { return m_pointOf->at(i, j, k) - 1; }

  const Volume<std::uint8_t>& m_inside;
  std::shared_ptr<Volume<std::int32_t>> m_pointOf; ///< by cell, 0 none, else 1 + the point
  std::vector<Point> m_points;
  std::vector<Eigen::Vector3f> m_positions;
  std::vector<Eigen::Vector3f> m_normals;            ///< out of the inside
  std::vector<std::array<std::int32_t, 6>> m_joined; ///< -1 none
};

/// The share that the relaxed net of `inside` writes, on its grid.
std::shared_ptr<Volume<float>> smoothedShare(const Volume<std::uint8_t>& inside,
                                             const core::Progress& progress,
                                             const SurfaceNet::Wanted& wanted = {});

} // namespace petrous::volume
