#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Stored values of one slice, sign-extended, row after row. Its memory is used again.
struct StoredPixels
{
  std::vector<std::int32_t> values;
  std::vector<unsigned char> scratch;
};

/// Reads and decodes the pixels that `slice` describes.
///
/// Bits above the high bit (overlays of old scanners) are dropped. Thread-safe.
/// Throws DicomError (Unreadable), naming the file.
void decodePixels(const SliceHeader& slice, StoredPixels& pixels);

} // namespace petrous::imaging
