#pragma once

#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Whether the header of a JPEG, JPEG-LS or JPEG 2000 codestream matches the greyscale image that
/// `slice` describes. Decoders trust the codestream, and misbehave on a corrupt one. True for
/// compressions without such a header (RLE).
bool codestreamFits(const std::vector<char>& bytes, const SliceHeader& slice);

/// Bits of a sample by the frame header of a JPEG or JPEG-LS codestream; 0 if it does not fit.
int jpegPrecision(const std::vector<char>& bytes, const SliceHeader& slice);

} // namespace petrous::imaging
