#include "MixedSigns.h"

#include <cmath>

#include "PaddingRange.h"
#include "PixelCodec.h"

namespace petrous::imaging
{

MixedSigns mixedSigns(const std::vector<SliceHeader>& slices, std::size_t first, std::size_t last,
                      const core::Progress& progress)
{
  std::size_t counts[2] = {}; // unsigned, signed
  for (std::size_t k = first; k < last; ++k)
  {
    const SliceHeader& slice = slices[k];
    if (slice.pixels.isReal || slice.slope != slices[first].slope ||
        slice.intercept != slices[first].intercept ||
        slice.pixels.bitsStored != slices[first].pixels.bitsStored)
      return {};
    ++counts[slice.pixels.isSigned ? 1 : 0];
  }
  if (counts[0] == 0 || counts[1] == 0)
    return {};
  MixedSigns result{counts[0] + counts[1], counts[0], {}};
  // Negative values are what most slices are signed for; large ones are of no CT.
  const bool areFewSigned = counts[1] < counts[0];
  StoredPixels pixels;
  for (std::size_t k = first; k < last; ++k)
  {
    const SliceHeader& slice = slices[k];
    const bool isSigned = slice.pixels.isSigned;
    if (isSigned && !areFewSigned)
      continue;
    progress.check("reading slices");
    decodePixels(slice, pixels, UndeclaredBits::LeaveOut);
    const PaddingRange<double> padding(slice, true);
    const double half = std::ldexp(1.0, slice.pixels.bitsStored - 1);
    std::size_t unclear = 0;
    for (std::size_t n = 0; n < pixels.size(); ++n)
    {
      const double value = pixels.at(n);
      unclear += (isSigned ? value < 0.0 : value >= half) && !padding.contains(value) ? 1 : 0;
    }
    if (unclear == 0)
      continue;
    result.unclear = slice.file.filename().string() + " says that its pixels are " +
                     (isSigned ? "signed" : "unsigned") +
                     ", and other slices of the series that theirs are not (Pixel "
                     "Representation): " +
                     std::to_string(unclear) + (unclear == 1 ? " value" : " values") +
                     " would be another one if it is as they are. Export the series again.";
    break;
  }
  return result;
}

} // namespace petrous::imaging
