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

/// The border between the voxels inside (1) and outside (0) as a net of points: one in each border
/// cell of eight voxel centres, joined across the faces that the border crosses (Gibson 1998,
/// "Constrained elastic surface nets"). Positions are in voxels.
///
/// `relax` moves the points, each within its cell, so that the net has no voxel steps: a point
/// moves along its normal until its curvature equals that of its neighbourhood. Planes, cylinders
/// and spheres are fixed points, so that nothing shrinks, and since the net has two sides a sheet
/// one voxel thin is as stable as a thick one.
///
/// A voxel's occupancy depends only on the points within kJoinReach joins, so the net of a region
/// is built and relaxed on its own, and its occupancies are bit-identical to those of the whole
/// net.
class SurfaceNet
{
public:
  /// Whether a cell, identified by its lowest voxel, may have a point.
  using Wanted = std::function<bool(const core::Index3& cell)>;

  /// `inside` must be 0 on its outermost voxels, and must outlive this. Where cells are not wanted
  /// the net has an edge, and voxels count as far from it.
  SurfaceNet(const Volume<std::uint8_t>& inside, const core::Progress& progress,
             const Wanted& wanted = {});

  /// The part of the net that determines the voxels of `targets`; `inside` as above.
  SurfaceNet(const Volume<std::uint8_t>& inside, const std::vector<core::IndexBox>& targets,
             const core::Progress& progress);

  void relax(const core::Progress& progress);

  std::size_t points() const noexcept { return m_points.size(); }

  /// Writes the signed distance of voxel centres from the net in voxels, positive inside, as an
  /// occupancy:
  ///   1/2 + distance / kShareReach, from 0 to 1
  /// A voxel inside stays above 1/2 and one outside below, in steps of 1/65535. `occupancy` must be
  /// 0 everywhere.
  ///
  /// Exception: where the inside is one voxel thin, the net is too coarse. There voxels that touch
  /// only by an edge or a corner are joined, which trilinear interpolation of distances would not
  /// do; and in a sheet or a rod, the distance is that from the plane or line fitted to it, and a
  /// voxel in a gap of it may become inside.
  void writeOccupancy(Volume<float>& occupancy, const core::Progress& progress) const;

  /// The same for the voxels of a box inside one of the net's targets; the others are unchanged.
  void writeOccupancyIn(const core::IndexBox& box, Volume<float>& occupancy) const;

  /// Voxels from occupancy 0 to 1: 2 sqrt(3), so that on equal voxels the occupancy has the slope
  /// of a cut's mask, and a mask that protects a structure leaves all of it (SweptSphereCut.h).
  static constexpr float kShareReach = 3.4641016F;
  static float occupancyOf(double depth) noexcept; ///< in voxels, > 0 inside; to the nearest step
  static double depthOf(float occupancy) noexcept;

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
    std::uint8_t corners; ///< bits of the voxels inside, the first axis fastest
  };
  using Joined = std::array<std::int32_t, 6>; ///< points by face: 2 * axis, + 1 the upper; -1 none

  struct Neighbours
  {
    std::array<std::int32_t, 6> points;
    int count;
    const std::int32_t* begin() const noexcept { return points.data(); }
    const std::int32_t* end() const noexcept { return points.data() + count; }
  };

  /// View of the occupancies of a box.
  struct OccupancyView
  {
    core::IndexBox box;
    float* data; ///< its first voxel
    std::ptrdiff_t row, slice;

    float& at(const core::Index3& v) const noexcept
    {
      return data[(v[0] - box.lower[0]) + row * (v[1] - box.lower[1]) +
                  slice * (v[2] - box.lower[2])];
    }
  };

  /// Points by cell: 0 none, else 1 + the point. Memory is used only around the points.
  class PointTable
  {
  public:
    explicit PointTable(const core::Index3& dims);
    std::int32_t at(int i, int j, int k) const noexcept
    {
      const std::int32_t* row = rowFrom(i, j, k);
      return row ? *row : 0;
    }
    std::int32_t& slot(const core::Index3& cell);
    /// The entry of a cell, followed by those up to `rowEnd`; nullptr: they are all 0.
    const std::int32_t* rowFrom(int i, int j, int k) const noexcept
    {
      const auto& brick = m_bricks[brickOf(i, j, k)];
      return brick ? brick.get() + offsetOf(i, j, k) : nullptr;
    }
    static int rowEnd(int i) noexcept { return (i | (kEdge - 1)) + 1; }

  private:
    static constexpr int kEdge = 8;
    std::size_t brickOf(int i, int j, int k) const noexcept
    {
      return static_cast<std::size_t>(i / kEdge) +
             m_dims[0] * (static_cast<std::size_t>(j / kEdge) +
                          m_dims[1] * static_cast<std::size_t>(k / kEdge));
    }
    static std::size_t offsetOf(int i, int j, int k) noexcept
    {
      return static_cast<std::size_t>(i % kEdge + kEdge * (j % kEdge + kEdge * (k % kEdge)));
    }

    std::array<std::size_t, 3> m_dims;
    std::vector<std::unique_ptr<std::int32_t[]>> m_bricks;
  };

  std::vector<std::array<float, 2>> heightsIn(const core::IndexBox& tile) const;
  void writeDistances(Volume<float>& occupancy, const core::Progress& progress) const;
  void writeDistancesIn(const core::IndexBox& tile, bool near,
                        const OccupancyView& occupancy) const;
  void joinThin(const OccupancyView& occupancy, const std::vector<std::size_t>& thinPoints) const;
  void fitThin(const OccupancyView& occupancy, const core::IndexBox& target,
               const std::vector<std::size_t>& thinPoints) const;
  std::uint8_t thinCorners(std::size_t point) const noexcept;
  bool isThin(const core::Index3& voxel) const noexcept;
  int cornersOf(const core::Index3& cell) const noexcept;
  static bool passes(int corners, int face) noexcept;
  static bool crosses(int corners, int corner, int axis) noexcept;
  static core::Index3 across(const core::Index3& cell, int face) noexcept;
  void findPoints(const core::Progress& progress, const Wanted& wanted);
  void findPoints(const std::vector<core::IndexBox>& seeds, const core::Progress& progress);
  void placePoints();
  void join();
  Eigen::Vector3f quadrangle(std::size_t point, int axis) const;
  void findNormals(int reach);
  std::size_t within(int joins) const noexcept;
  int pointAt(int i, int j, int k) const noexcept { return m_pointOf.at(i, j, k) - 1; }

  static constexpr int kJoinReach = 131; ///< joins: see relax

  const Volume<std::uint8_t>& m_inside;
  PointTable m_pointOf;
  std::vector<Point> m_points;
  std::vector<std::size_t> m_within; ///< points at most n joins from a seed; empty: whole net
  std::vector<Eigen::Vector3f> m_positions;
  std::vector<Eigen::Vector3f> m_normals; ///< pointing outside
  std::vector<Joined> m_joined;
  std::vector<Neighbours> m_neighbours; ///< the same without gaps, in the order of the faces
  /// Across an edge of the cell along an axis (2 * axis that of its lowest voxel, + 1 the opposite
  /// one): the fourth of the points around it. -1: the border does not cross it, or no point.
  std::vector<Joined> m_diagonal;
};

/// The occupancy that the relaxed net of `inside` writes, on its grid.
std::shared_ptr<Volume<float>> smoothedOccupancy(const Volume<std::uint8_t>& inside,
                                                 const core::Progress& progress,
                                                 const SurfaceNet::Wanted& wanted = {});

} // namespace petrous::volume
