#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::volume
{

/// Remaining fraction of each voxel after drilling: 65535 untouched, 0 removed.
///
/// Stored in bricks of 16^3 that are allocated on first write; an untouched brick costs one null
/// pointer. A brick version is immutable: writing replaces the pointer, so a history shares
/// versions and undo swaps pointers. Not thread-safe: one writer, with readers on the same thread
/// or on a copy (copies share the versions).
class CutMask
{
public:
  static constexpr int kBrickEdge = 16;
  static constexpr std::size_t kBrickVoxels = 16 * 16 * 16;
  static constexpr std::uint16_t kUntouched = 65535;

  using Brick = std::array<std::uint16_t, kBrickVoxels>; ///< first axis fastest
  using BrickVersion = std::shared_ptr<const Brick>;     ///< nullptr: all untouched

  explicit CutMask(const core::GridGeometry& geometry);

  const core::GridGeometry& geometry() const noexcept { return m_geometry; }
  const core::Index3& brickDims() const noexcept { return m_brickDims; }
  std::size_t brickCount() const noexcept { return m_bricks.size(); }
  std::size_t brickIndex(const core::Index3& brick) const noexcept
  {
    return static_cast<std::size_t>(brick[0]) +
           static_cast<std::size_t>(m_brickDims[0]) *
               (static_cast<std::size_t>(brick[1]) +
                static_cast<std::size_t>(m_brickDims[1]) * static_cast<std::size_t>(brick[2]));
  }

  /// The voxels of a brick, clipped to the grid.
  core::IndexBox brickBox(std::size_t brick) const noexcept;

  /// The bricks (half-open box of brick positions) that a box of voxels intersects.
  core::IndexBox bricksCovering(const core::IndexBox& voxels) const noexcept;

  const BrickVersion& brick(std::size_t index) const noexcept { return m_bricks[index]; }

  /// Replaces a brick's version and marks it dirty. Voxels beyond the grid must be untouched.
  void setBrick(std::size_t index, BrickVersion version);

  std::uint16_t at(int i, int j, int k) const noexcept
  {
    const BrickVersion& version =
        m_bricks[brickIndex({i / kBrickEdge, j / kBrickEdge, k / kBrickEdge})];
    return version ? (*version)[offsetInBrick(i, j, k)] : kUntouched;
  }

  /// Remaining fraction at a continuous voxel position, trilinear, 0 to 1. No lookups where
  /// untouched.
  double sample(const Eigen::Vector3d& voxel) const noexcept;

  bool untouched() const noexcept; ///< no brick was ever written, or all were undone
  /// The same of the bricks that a box of voxels intersects.
  bool untouched(const core::IndexBox& voxels) const noexcept;
  /// The bricks in which something was cut.
  std::vector<std::size_t> cutBricks() const;
  std::size_t residentBytes() const noexcept;

  /// Bricks replaced since the last call, in order of first change, each once; clears the list.
  std::vector<std::size_t> takeDirty();

  /// Bounding box of the voxels in `bricks`, grown by one voxel: the support of interpolation
  /// there.
  core::IndexBox boxOf(const std::vector<std::size_t>& bricks) const noexcept;

  /// All voxels as one array, for export and external programs.
  Volume<std::uint16_t> dense() const;

private:
  static std::size_t offsetInBrick(int i, int j, int k) noexcept
  {
    return static_cast<std::size_t>(
        (i % kBrickEdge) + kBrickEdge * ((j % kBrickEdge) + kBrickEdge * (k % kBrickEdge)));
  }

  core::GridGeometry m_geometry;
  core::Index3 m_brickDims;
  std::vector<BrickVersion> m_bricks;
  std::vector<std::size_t> m_dirty;
  std::vector<bool> m_isDirty;
};

} // namespace petrous::volume
