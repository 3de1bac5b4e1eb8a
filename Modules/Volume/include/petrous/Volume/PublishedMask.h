#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Volume/CutMask.h"

namespace petrous::volume
{

/// One state of a cut mask, never changed once it is published: bricks in blocks, so that a new
/// state copies the blocks that differ and shares the rest.
class MaskState
{
public:
  static constexpr std::size_t kBlock = 64; ///< bricks of a block
  using Block = std::array<CutMask::BrickVersion, kBlock>;

  explicit MaskState(const CutMask& mask, std::uint64_t number = 0);

  /// `bricks` taken from `mask`, all others as in `previous`.
  MaskState(const MaskState& previous, const CutMask& mask, const std::vector<std::size_t>& bricks);

  /// Null where nothing was ever cut.
  const CutMask::Brick* brick(std::size_t index) const noexcept
  {
    const Block* block = m_blocks[index / kBlock].get();
    return block ? (*block)[index % kBlock].get() : nullptr;
  }

  /// The same, to be kept.
  CutMask::BrickVersion version(std::size_t index) const
  {
    const Block* block = m_blocks[index / kBlock].get();
    return block ? (*block)[index % kBlock] : nullptr;
  }

  std::uint64_t number() const noexcept { return m_number; } ///< of the state, rising

  /// How often tissue came back (undo, another case): until this changes, the tissue of a later
  /// state lies within that of an earlier one.
  std::uint64_t raises() const noexcept { return m_raises; }
  void raise() noexcept { ++m_raises; } ///< before it is published

private:
  std::vector<std::shared_ptr<const Block>> m_blocks;
  std::uint64_t m_number = 0;
  std::uint64_t m_raises = 0;
};

/// Hands a mask's states from the one thread that cuts to the one thread that feels.
///
/// The writer swaps a single pointer to a whole state, so a tick sees one state and never half a
/// cut. The reader says in a hazard pointer which state it holds (Michael 2004,
/// doi 10.1109/TPDS.2004.8); the writer frees the others. Neither waits for the other; the reader
/// does not allocate and does not free.
class PublishedMask
{
public:
  /// `number` is that of the first state: a session that is played again counts as it did.
  explicit PublishedMask(const CutMask& mask, std::uint64_t number = 0);
  PublishedMask(const PublishedMask&) = delete;
  PublishedMask& operator=(const PublishedMask&) = delete;

  const core::GridGeometry& geometry() const noexcept { return m_geometry; }
  const core::Index3& brickDims() const noexcept { return m_brickDims; }

  /// Writer: the given bricks of `mask`, which lies on the same grid, are new. `raised` when tissue
  /// may have come back.
  void publish(const CutMask& mask, const std::vector<std::size_t>& bricks, bool raised);

  /// Writer: number of the present state.
  std::uint64_t number() const noexcept { return m_states.back()->number(); }

  /// Writer: a brick in the present state.
  CutMask::BrickVersion brick(std::size_t index) const { return m_states.back()->version(index); }

  /// Writer: states that are kept for the reader's sake, the present one included.
  std::size_t statesHeld() const noexcept { return m_states.size(); }

  /// Reader: the present state; it stays until `release` or the next `acquire`.
  const MaskState* acquire() const noexcept;
  void release() const noexcept;

private:
  core::GridGeometry m_geometry;
  core::Index3 m_brickDims;
  std::vector<std::unique_ptr<const MaskState>> m_states; ///< the last one is the present one
  std::atomic<const MaskState*> m_present;
  mutable std::atomic<const MaskState*> m_held{nullptr};
};

} // namespace petrous::volume
