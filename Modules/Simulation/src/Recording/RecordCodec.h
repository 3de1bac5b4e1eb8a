#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Simulation/TickRecord.h"

namespace petrous::simulation
{

// Ticks as bytes that pack well, and back to the last bit. A record is a row of 8-byte words; each
// column is predicted, by the rule that does best in the block, from its own past and from columns
// before it (the mapped pose from the device's, the force from hand and tool ...). What is kept is
// how far the word is from its prediction, in units of the last place, in byte planes.
std::vector<std::uint8_t> encodeTicks(const std::vector<TickRecord>& ticks);

// False when the bytes are not those of `count` ticks.
bool decodeTicks(const std::vector<std::uint8_t>& bytes, std::size_t count,
                 std::vector<TickRecord>& ticks);

// Most bytes that `count` ticks can take.
std::size_t maxBytes(std::size_t count);

} // namespace petrous::simulation
