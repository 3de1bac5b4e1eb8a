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

/// Whether a codestream says that it was made with loss: a JPEG-LS of near-lossless samples, or a
/// JPEG 2000 of the irreversible wavelet. `bytes`: its beginning. Of the other syntaxes the
/// transfer syntax says it.
bool isLossyCodestream(const std::vector<char>& bytes, const std::string& transferSyntax);

} // namespace petrous::imaging
