#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Volume/LabelField.h"

namespace petrous::volume
{

/// Rank of a source in the order in which structures own a voxel: 1 the first, 0 none. Solid
/// sources precede all lumens, each kind in the order of the sources.
using LabelRank = std::uint16_t;

/// The order of the sources.
struct LabelOrder
{
  std::vector<LabelRank> rankOf;            ///< by source
  std::vector<std::uint8_t> materialOfRank; ///< [0] is 0: none
  LabelRank lastSolid = 0;                  ///< ranks above it are lumens

  /// Throws InvalidParameter naming the first invalid source.
  explicit LabelOrder(const std::vector<LabelSource>& sources);

  bool isSolid(LabelRank rank) const noexcept { return rank != 0 && rank <= lastSolid; }
};

/// Occupied tiles of a grid, so that empty ones can be skipped.
class LabelTiles
{
public:
  static constexpr int kEdge = 16;

  explicit LabelTiles(const core::Index3& voxels = {0, 0, 0});

  const core::Index3& dims() const noexcept { return m_dims; }
  core::IndexBox voxelsOf(int i, int j, int k) const noexcept; ///< clipped to the grid
  /// Flags of the tiles along the first axis; threads may write to different ones.
  std::uint8_t* row(int j, int k) noexcept { return m_occupied.data() + offset(j, k); }
  bool any(const core::IndexBox& voxels) const noexcept; ///< the box may extend beyond the grid

private:
  std::size_t offset(int j, int k) const noexcept;

  core::Index3 m_voxels;
  core::Index3 m_dims;
  std::vector<std::uint8_t> m_occupied;
};

/// The structures of all maps that share a grid, each voxel assigned to one.
struct LabelPriority
{
  std::shared_ptr<Volume<LabelRank>> voxels;
  LabelTiles tiles;
  core::IndexBox box; ///< bounding box of the voxels that have a rank
  bool hasSolid = false;
  bool hasLumen = false;

  const core::GridGeometry& geometry() const noexcept { return voxels->geometry(); }
};

/// One entry for each grid of the sources, in their order; grids without a voxel of any source are
/// omitted.
std::vector<LabelPriority> rankLabels(const std::vector<LabelSource>& sources,
                                      const LabelOrder& order, const core::Progress& progress);

} // namespace petrous::volume
