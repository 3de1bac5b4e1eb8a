#pragma once

#include <cstdint>
#include <vector>

#include "ByteSource.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Stored values of one slice, sign-extended, row by row: whole numbers of 32 bits, or others. The
/// memory is reused.
struct StoredPixels
{
  std::vector<std::int32_t> values; ///< empty: see `reals`
  std::vector<double> reals;        ///< floating point, and unsigned ones beyond 2^31 - 1; or empty
  std::vector<unsigned char> scratch;

  bool isReal() const noexcept { return !reals.empty(); }
  std::size_t size() const noexcept { return isReal() ? reals.size() : values.size(); }
  double at(std::size_t pixel) const
  {
    return isReal() ? reals[pixel] : static_cast<double>(values[pixel]);
  }
};

/// An item of encapsulated pixel data (PS3.5 A.4).
struct Fragment
{
  std::uint64_t offset = 0; ///< of its value
  std::uint32_t length = 0;
};

/// All items of the file's encapsulated pixel data; the first is the basic offset table. Throws
/// DicomError (Unreadable).
std::vector<Fragment> readFragments(ByteSource& source, const SliceHeader& slice);

/// The compressed bytes of the slice's frame. Throws DicomError (Unreadable).
std::vector<char> readCodestream(ByteSource& source, const SliceHeader& slice,
                                 const std::vector<Fragment>& fragments);

/// Decodes the slice's frame of an encapsulated file, whose fragments are known: for many frames of
/// one file. Throws DicomError (Unreadable).
void decodeFrame(ByteSource& source, const SliceHeader& slice,
                 const std::vector<Fragment>& fragments, StoredPixels& pixels);

/// Reads and decodes the pixels that `slice` describes.
///
/// Bits above the high bit must be none, copies of the sign, or those of overlays that the file
/// declares (of old scanners), which are left out: values that need them are refused. Thread-safe.
/// Throws DicomError (Unreadable), naming the file; also if it was changed or replaced since its
/// header was read (SliceHeader::stamp).
void decodePixels(const SliceHeader& slice, StoredPixels& pixels);

} // namespace petrous::imaging
