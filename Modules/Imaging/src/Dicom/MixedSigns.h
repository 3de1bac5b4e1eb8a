#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Whether slices of one rescale agree that their pixels are signed (Pixel Representation).
struct MixedSigns
{
  std::size_t slices = 0; ///< 0: they agree, or are not of one rescale
  std::size_t unsignedOnes = 0;
  /// A value depends on it: which slice's, and why. It names the file. Empty: none does.
  std::string unclear;
};

/// Of slices [first, last). Where they disagree, the highest stored bit makes a large value in one
/// and a negative one in the other: air would be metal, or bone air. Decodes the pixels of those
/// that may be wrong. Throws DicomError if these cannot be read, CancelledError.
MixedSigns mixedSigns(const std::vector<SliceHeader>& slices, std::size_t first, std::size_t last,
                      const core::Progress& progress);

} // namespace petrous::imaging
