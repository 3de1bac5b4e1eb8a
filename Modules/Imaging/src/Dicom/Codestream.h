#pragma once

#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Whether the head of a JPEG, JPEG-LS or JPEG 2000 codestream promises the grey image that
/// `slice` describes. GDCM's decoders believe the codestream and run wild on a spoilt one.
/// True for compressions without such a head (RLE).
bool codestreamFits(const std::vector<char>& bytes, const SliceHeader& slice);

} // namespace petrous::imaging
