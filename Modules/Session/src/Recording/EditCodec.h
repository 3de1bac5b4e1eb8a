#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Session/MaskEdit.h"

namespace petrous::session
{

// Lossless encoding of edits that compresses well: like RecordCodec.h, but each word is predicted
// from the previous edit, and the end of a cut from its start.
std::vector<std::uint8_t> encodeEdits(const std::vector<MaskEdit>& edits);

// False if the bytes do not encode `count` edits.
bool decodeEdits(const std::vector<std::uint8_t>& bytes, std::size_t count,
                 std::vector<MaskEdit>& edits);

// Maximum size of `count` encoded edits.
std::size_t maxEditBytes(std::size_t count);

} // namespace petrous::session
