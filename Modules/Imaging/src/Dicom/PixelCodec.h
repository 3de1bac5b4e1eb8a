#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Stored values of one slice, sign-extended, row by row. The memory is reused.
struct StoredPixels
{
  std::vector<std::int32_t> values;
  std::vector<unsigned char> scratch;
};

/// Reads and decodes the pixels that `slice` describes.
///
/// Bits above the high bit (overlays of old scanners) are discarded. Thread-safe. Throws DicomError
/// (Unreadable), naming the file.
void decodePixels(const SliceHeader& slice, StoredPixels& pixels);

} // namespace petrous::imaging
