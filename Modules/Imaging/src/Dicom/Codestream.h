#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Bits of a sample by the header of a JPEG, JPEG-LS or JPEG 2000 codestream; 0 if that does not
/// match the greyscale image that `slice` describes. Decoders trust the codestream, and misbehave
/// on a corrupt one.
int codestreamPrecision(const std::vector<char>& bytes, const SliceHeader& slice);

/// The most pixels that a compressed image of so many bytes can have, and that are read at all:
/// memory is taken only for what may be there.
std::uint64_t mostPixels(const PixelFormat& format, std::uint64_t bytes);

/// Bits of a sample by the frame header of a JPEG or JPEG-LS codestream; 0 if it does not fit.
int jpegPrecision(const std::vector<char>& bytes, const SliceHeader& slice);

/// A big-endian number of up to four bytes of a codestream; nullopt beyond its end.
using CodestreamNumber =
    std::function<std::optional<std::uint32_t>(std::uint64_t at, std::size_t bytes)>;

/// Whether a codestream says that it was made with loss: a JPEG-LS of near-lossless samples, or a
/// JPEG 2000 of the irreversible wavelet. Of the other syntaxes the transfer syntax says it.
/// nullopt: what should say it is not there.
std::optional<bool> isLossyCodestream(const CodestreamNumber& number,
                                      const std::string& transferSyntax);

} // namespace petrous::imaging
