#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::segmentation
{

/// A structure being made: binary voxels (0 or 1) on the grid of the image that it is drawn on.
struct Mask
{
  std::shared_ptr<const volume::Volume<std::uint8_t>> voxels;
  core::IndexBox extent;   ///< all voxels outside it are 0
  std::uint64_t count = 0; ///< voxels that are 1

  const core::GridGeometry& geometry() const noexcept { return voxels->geometry(); }
  bool at(const core::Index3& index) const noexcept
  {
    return extent.contains(index) && voxels->at(index[0], index[1], index[2]) != 0;
  }
  double volume() const ///< mm^3
  {
    return static_cast<double>(count) * geometry().voxelVolume();
  }
};

/// No voxel is 1; takes no memory to speak of.
Mask emptyMask(const core::GridGeometry& geometry);

/// Counts the voxels inside `box`, outside which all must be 0, and finds their extent.
Mask makeMask(std::shared_ptr<const volume::Volume<std::uint8_t>> voxels,
              const core::IndexBox& box);

/// The voxels of one index.
Mask maskOf(const volume::LabelMap& labels, std::uint16_t index);

/// A label map of one segment.
volume::LabelMap labelMapOf(const Mask& mask, const volume::Segment& segment);

/// A mask that is drawn in steps, each of which can be undone and redone.
///
/// A step keeps the changed bricks of 16^3 voxels as the bits that differ: 512 bytes a brick, an
/// eighth of its voxels. Not thread-safe.
class EditableMask
{
public:
  static constexpr std::size_t kMostHistory = std::size_t{128} << 20; ///< bytes, of all steps
  static constexpr int kBrick = 16;

  explicit EditableMask(const core::GridGeometry& geometry);
  explicit EditableMask(const Mask& start); ///< copies its voxels

  const core::GridGeometry& geometry() const noexcept { return m_voxels->geometry(); }
  const volume::Volume<std::uint8_t>& voxels() const noexcept { return *m_voxels; }
  std::uint64_t count() const noexcept { return m_count; }
  core::IndexBox extent() const noexcept { return m_extent; } ///< may be larger than needed

  /// The state now; a copy of the extent's voxels, for work in another thread.
  Mask snapshot() const;

  /// A step begins; changes until `endStep` are one step. Throws InvalidParameter within a step.
  void beginStep();
  /// Calls `change` with the voxels, which may set those in `box` to 0 or 1. Returns the box of
  /// those that differ then; empty: none. Throws InvalidParameter outside a step.
  core::IndexBox change(const core::IndexBox& box,
                        const std::function<void(volume::Volume<std::uint8_t>&)>& change);
  /// The voxels become those of `mask`, on the same grid. As `change`.
  core::IndexBox replace(const Mask& mask);
  /// False if the step changed nothing and was dropped. Undone steps are lost otherwise. The oldest
  /// steps are forgotten above kMostHistory.
  bool endStep();

  bool canUndo() const noexcept { return !m_stepping && m_position > 0; }
  bool canRedo() const noexcept { return !m_stepping && m_position < m_steps.size(); }
  /// The box of the voxels that differ then. Throw InvalidParameter if there is nothing to do.
  core::IndexBox undo();
  core::IndexBox redo();

  std::size_t historyBytes() const noexcept { return m_bytes; }
  std::size_t lastStepBytes() const noexcept; ///< of the step that `undo` would undo; 0: none

private:
  struct Brick
  {
    std::uint32_t index = 0;
    std::array<std::uint64_t, kBrick * kBrick * kBrick / 64> bits{}; ///< that differ
  };
  using Step = std::vector<Brick>;

  core::IndexBox boxOf(std::uint32_t brick) const;
  core::IndexBox flip(const Step& step);

  std::shared_ptr<volume::Volume<std::uint8_t>> m_voxels;
  core::Index3 m_bricks{0, 0, 0};
  core::IndexBox m_extent;
  std::uint64_t m_count = 0;
  std::deque<Step> m_steps;
  std::size_t m_position = 0; ///< steps applied
  std::size_t m_bytes = 0;
  bool m_stepping = false;
  Step m_open;
  std::vector<std::int32_t> m_openAt; ///< per brick its place in m_open, or -1
};

} // namespace petrous::segmentation
