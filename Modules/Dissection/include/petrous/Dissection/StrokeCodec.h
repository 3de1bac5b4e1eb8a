#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

/// Bricks of a mask that are being rebuilt: each is copied when first written. The mask stays as it
/// is until `apply`, and must outlive this.
class BrickDraft
{
public:
  explicit BrickDraft(const volume::CutMask& mask)
    : m_mask(mask)
  {
  }

  const volume::CutMask& mask() const noexcept { return m_mask; }
  volume::CutMask::Brick& edit(std::size_t brick);

  /// The bricks that were written, sorted; null for one that is untouched all over. Ends the draft.
  std::vector<BrickDelta> take();

private:
  const volume::CutMask& m_mask;
  std::map<std::size_t, std::shared_ptr<volume::CutMask::Brick>> m_bricks;
};

/// A stroke's voxels as bytes (zstd; the layout is in Documentation/adr/0003): per brick the
/// amount that was taken, before - after. `deltas` is sorted by brick, each brick once. The same
/// voxels give the same bytes.
std::vector<std::uint8_t> encodeDeltas(const std::vector<BrickDelta>& deltas);

enum class Step
{
  Undo, ///< gives back what the stroke took
  Redo  ///< takes it
};

/// Throws InvalidParameter when the bytes are damaged or do not fit the mask: another grid, or a
/// voxel that has not what is taken, or would have more than there is. The draft is of no use then.
void applyDeltas(const std::vector<std::uint8_t>& packed, Step step, BrickDraft& draft);

} // namespace petrous::dissection
