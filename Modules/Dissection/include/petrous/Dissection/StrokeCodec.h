#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

/// A stroke's voxels as bytes (zstd; the layout is in Documentation/adr/0003): per brick the
/// amount that was taken, before - after. The same voxels give the same bytes.
std::vector<std::uint8_t> encodeDeltas(const std::vector<BrickDelta>& deltas);

/// Rebuilds the deltas on the mask from which the stroke started.
/// Throws InvalidParameter when the bytes are damaged or do not fit the mask's grid.
std::vector<BrickDelta> decodeDeltas(const std::vector<std::uint8_t>& bytes,
                                     const volume::CutMask& before);

} // namespace petrous::dissection
