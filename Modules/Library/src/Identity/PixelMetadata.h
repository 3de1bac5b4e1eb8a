#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace petrous::library
{

/// Where compressed or native pixel data can carry text beside the picture. In place, sizes and
/// decoded voxels unchanged.

/// A frame (or its first fragment) as JPEG, JPEG-LS, JPEG 2000 or HTJ2K codestream: contents of
/// comments and application segments are zeroed (but Adobe's and JPEG-LS's colour transforms), and
/// so is what follows the end of the image. False if it is not such a codestream.
bool clearCodestreamMetadata(std::uint8_t* bytes, std::size_t count);

/// Later fragments of a frame: what follows the last end-of-image marker.
void clearAfterEndOfImage(std::uint8_t* bytes, std::size_t count);

/// An RLE frame (PS3.5 Annex G) of `pixels` bytes a segment: unused entries of its header, gaps and
/// what follows each segment's last pixel. False if it is damaged.
bool clearRleMetadata(std::uint8_t* bytes, std::size_t count, std::size_t pixels);

/// Bits of 16-bit cells outside of [highBit - bitsStored + 1, highBit] (retired overlays): zero, or
/// the sign where all of them are the sign.
void clearUnusedBits(std::uint16_t* cells, std::size_t count, int bitsStored, int highBit,
                     bool isSigned);

} // namespace petrous::library
