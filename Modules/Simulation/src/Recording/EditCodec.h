#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Simulation/MaskEdit.h"

namespace petrous::simulation
{

// Edits as bytes that pack well, and back to the last bit: as RecordCodec.h, but each word is
// predicted from the edit before, and where a cut ends from where it begins.
std::vector<std::uint8_t> encodeEdits(const std::vector<MaskEdit>& edits);

// False when the bytes are not those of `count` edits.
bool decodeEdits(const std::vector<std::uint8_t>& bytes, std::size_t count,
                 std::vector<MaskEdit>& edits);

// Most bytes that `count` edits can take.
std::size_t maxEditBytes(std::size_t count);

} // namespace petrous::simulation
