#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace petrous::library
{

/// Where compressed or native pixel data can carry text beside the picture. In place, sizes and
/// decoded voxels unchanged.

/// A frame as JPEG, JPEG-LS, JPEG 2000 or HTJ2K codestream: contents of comments and application
/// segments are zeroed (but Adobe's and JPEG-LS's colour transforms), and so is what follows the
/// end of the image. False if it is not such a codestream.
bool clearCodestreamMetadata(std::uint8_t* bytes, std::size_t count);

/// The bits of a sample that such a codestream states; 0: none. JPEG 2000: of the deepest
/// component.
int codestreamPrecision(const std::uint8_t* bytes, std::size_t count);

/// Which bits of a cell hold the sample (PS3.5 8.1.1).
struct StoredBits
{
  int allocated = 16;
  int stored = 16;
  int high = 15; ///< the most significant
  bool isSigned = false;
};

/// False for what clearUnusedBits cannot treat: cells of other than 8, 16 or 32 bits, samples that
/// do not lie in them.
bool isClearable(const StoredBits& bits);

/// An RLE frame (PS3.5 Annex G) of `pixels` bytes a segment: unused entries of its header, gaps and
/// what follows each segment's last pixel, and the bits outside of the samples (`bits`, as
/// clearUnusedBits). Sets `hadBits` if there were such. False if it is damaged.
bool clearRleMetadata(std::uint8_t* bytes, std::size_t count, std::size_t pixels,
                      const StoredBits& bits, bool& hadBits);

/// Little endian cells of native pixel data: zeroes the bits outside of the samples (retired
/// overlays), unless those above extend the sign of all of them. True if there were such.
bool clearUnusedBits(std::uint8_t* bytes, std::size_t cells, const StoredBits& bits);

} // namespace petrous::library
