#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// Every few voxels of an image, for a look at a file that may be larger than the memory.
struct ImagePreview
{
  std::shared_ptr<const volume::IntensityVolume> volume;
  core::GridGeometry grid; ///< of the whole image
};

/// `slices`: along the third axis, about; at most twice as many are kept, one at a time is decoded.
/// Within a slice every voxel is kept if the memory holds them, else every second, third ... along
/// both axes.
///
/// memory  bytes that it may take; 0: what the machine has left
///
/// `isRas`, `volume`, `unit` and what is thrown: as readImageFile.
ImagePreview previewImageFile(const std::filesystem::path& path, std::size_t slices,
                              const core::Progress& progress = {},
                              const std::optional<bool>& isRas = std::nullopt,
                              std::uint64_t memory = 0, std::size_t volume = 0,
                              const std::optional<double>& unit = std::nullopt);

} // namespace petrous::imaging
