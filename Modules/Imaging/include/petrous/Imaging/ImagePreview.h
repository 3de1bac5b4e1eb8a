#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// Every few slices of an image, for a look at a file that may be larger than the memory.
struct ImagePreview
{
  std::shared_ptr<const volume::IntensityVolume> volume;
  core::GridGeometry grid; ///< of the whole image
};

/// `slices`: along the third axis, about; at most twice as many are kept, one at a time is decoded.
/// `isRas` and what is thrown: as readImageFile.
ImagePreview previewImageFile(const std::filesystem::path& path, std::size_t slices,
                              const core::Progress& progress = {},
                              const std::optional<bool>& isRas = std::nullopt);

} // namespace petrous::imaging
