#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Volume/CutMask.h"

namespace petrous::volume
{

/// Immutable snapshot of a cut mask: bricks grouped in blocks, so that a new state copies the
/// blocks that differ and shares the rest.
class MaskState
{
public:
  static constexpr std::size_t kBlock = 64; ///< bricks per block
  using Block = std::array<CutMask::BrickVersion, kBlock>;

  explicit MaskState(const CutMask& mask, std::uint64_t number = 0);

  /// `bricks` taken from `mask`, all others from `previous`.
  MaskState(const MaskState& previous, const CutMask& mask, const std::vector<std::size_t>& bricks);

  /// nullptr where nothing was ever cut.
  const CutMask::Brick* brick(std::size_t index) const noexcept
  {
    const Block* block = m_blocks[index / kBlock].get();
    return block ? (*block)[index % kBlock].get() : nullptr;
  }

  /// The same, with shared ownership.
  CutMask::BrickVersion version(std::size_t index) const
  {
    const Block* block = m_blocks[index / kBlock].get();
    return block ? (*block)[index % kBlock] : nullptr;
  }

  std::uint64_t number() const noexcept { return m_number; } ///< increases with every state

  /// Number of times that tissue was restored (undo, another case): while it is unchanged, the
  /// tissue of a later state is a subset of that of an earlier one.
  std::uint64_t raises() const noexcept { return m_raises; }
  void raise() noexcept { ++m_raises; } ///< before publication

private:
  std::vector<std::shared_ptr<const Block>> m_blocks;
  std::uint64_t m_number = 0;
  std::uint64_t m_raises = 0;
};

/// Publishes a mask's states from the cutting thread to the servo thread (one writer, one reader).
///
/// The writer swaps a single pointer to a complete state, so a tick never sees half a cut. The
/// reader announces the state that it holds in a hazard pointer (Michael 2004, doi
/// 10.1109/TPDS.2004.8); the writer frees the others. Neither blocks the other; the reader neither
/// allocates nor frees.
class PublishedMask
{
public:
  /// `number` is that of the first state, so that a replayed session has the same numbers.
  explicit PublishedMask(const CutMask& mask, std::uint64_t number = 0);
  PublishedMask(const PublishedMask&) = delete;
  PublishedMask& operator=(const PublishedMask&) = delete;

  const core::GridGeometry& geometry() const noexcept { return m_geometry; }
  const core::Index3& brickDims() const noexcept { return m_brickDims; }

  /// Writer: publishes the given bricks of `mask`, which must be on the same grid. `raised` if
  /// tissue may have been restored.
  void publish(const CutMask& mask, const std::vector<std::size_t>& bricks, bool raised);

  /// Writer: number of the current state.
  std::uint64_t number() const noexcept { return m_states.back()->number(); }

  /// Writer: a brick in the current state.
  CutMask::BrickVersion brick(std::size_t index) const { return m_states.back()->version(index); }

  /// Writer: number of states kept alive for the reader, including the current one.
  std::size_t statesHeld() const noexcept { return m_states.size(); }

  /// Reader: the current state; valid until `release` or the next `acquire`.
  const MaskState* acquire() const noexcept;
  void release() const noexcept;

private:
  core::GridGeometry m_geometry;
  core::Index3 m_brickDims;
  std::vector<std::unique_ptr<const MaskState>> m_states; ///< the last one is the current one
  std::atomic<const MaskState*> m_present;
  mutable std::atomic<const MaskState*> m_held{nullptr};
};

} // namespace petrous::volume
