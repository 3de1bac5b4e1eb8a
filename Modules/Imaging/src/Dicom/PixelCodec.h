#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ByteSource.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Negative values of a slice that has unused bits above its values.
struct SignCopies
{
  bool any = false;     ///< some have copies of the sign in the unused bits
  std::size_t none = 0; ///< how many have none: larger positive values have the same bits
};

/// Stored values of one slice, sign-extended, row by row: whole numbers of 32 bits, or others. The
/// memory is reused.
struct StoredPixels
{
  std::vector<std::int32_t> values; ///< empty: see `reals`
  std::vector<double> reals;        ///< floating point, and unsigned ones beyond 2^31 - 1; or empty
  std::vector<unsigned char> scratch;
  SignCopies signs;           ///< also of pixels that are `undeclared`
  std::size_t undeclared = 0; ///< pixels with bits that UndeclaredBits is about
  bool hasBitsBelow = false;  ///< unused bits below the values, which are never kept

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
                 const std::vector<Fragment>& fragments, StoredPixels& pixels,
                 UndeclaredBits undeclared = UndeclaredBits::Refuse);

/// Reads and decodes the pixels that `slice` describes.
///
/// Bits outside of the stored ones must be none, copies of the sign, or those of overlays that the
/// file declares (of old scanners), which are left out: values that need them are refused, but for
/// the declared padding, which keeps the value that the header gives it. Whether a positive value
/// was taken for a negative one only the slices together tell (StoredPixels::signs); Keep takes
/// each highest stored bit without its copies for one of a positive value. Thread-safe. Throws
/// DicomError (Unreadable, BitsUnclear), naming the file; also if it was changed or replaced since
/// its header was read (SliceHeader::stamp).
void decodePixels(const SliceHeader& slice, StoredPixels& pixels,
                  UndeclaredBits undeclared = UndeclaredBits::Refuse);

/// That so many pixels of the slice have values of more than the bits stored. `why`: what tells.
std::string bitsStoredText(const SliceHeader& slice, std::size_t count,
                           const std::string& why = {});

} // namespace petrous::imaging
