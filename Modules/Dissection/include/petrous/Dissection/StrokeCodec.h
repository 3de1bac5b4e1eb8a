#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

/// Copy-on-write draft of a mask's bricks. The mask is unchanged and must outlive this.
class BrickDraft
{
public:
  explicit BrickDraft(const volume::CutMask& mask)
    : m_mask(mask)
  {
  }

  const volume::CutMask& mask() const noexcept { return m_mask; }
  volume::CutMask::Brick& edit(std::size_t brick);

  /// The modified bricks, sorted; nullptr for one that is entirely untouched. Ends the draft.
  std::vector<BrickDelta> take();

private:
  const volume::CutMask& m_mask;
  std::map<std::size_t, std::shared_ptr<volume::CutMask::Brick>> m_bricks;
};

/// Encodes a stroke's voxels (zstd; layout in Documentation/adr/0003): per brick the removed
/// amount, before - after. `deltas` is sorted by brick, each brick once. Deterministic.
std::vector<std::uint8_t> encodeDeltas(const std::vector<BrickDelta>& deltas);

enum class Step
{
  Undo, ///< restores what the stroke removed
  Redo  ///< removes it again
};

/// Throws InvalidParameter if the bytes are damaged or do not fit the mask: another grid, or a
/// voxel that would leave the range 0 to 65535. The draft is then invalid.
void applyDeltas(const std::vector<std::uint8_t>& packed, Step step, BrickDraft& draft);

} // namespace petrous::dissection
