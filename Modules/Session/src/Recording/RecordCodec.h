#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Session/TickRecord.h"

namespace petrous::session
{

// Lossless encoding of ticks that compresses well. A record is a row of 8-byte words; each column
// is predicted, by the best rule for the block, from its own past and from preceding columns (the
// mapped pose from the device's, the force from device and tool ...). Stored are the differences of
// the words from their predictions, in units in the last place, as byte planes.
std::vector<std::uint8_t> encodeTicks(const std::vector<TickRecord>& ticks);

// False if the bytes do not encode `count` ticks.
bool decodeTicks(const std::vector<std::uint8_t>& bytes, std::size_t count,
                 std::vector<TickRecord>& ticks);

// Maximum size of `count` encoded ticks.
std::size_t maxBytes(std::size_t count);

} // namespace petrous::session
