#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// Writes a raw NRRD that can be memory-mapped: patient LPS mm, numbers exact to the bit, voxels
/// uncompressed and little-endian from a multiple of 4096 bytes onwards. Other programs can open it
/// too. The file is written atomically and synced to disk; equal volumes give equal bytes. Throws
/// FileError, CancelledError.
void writeRawNrrd(const std::filesystem::path& path, const volume::IntensityVolume& volume,
                  const core::Progress& progress = {});
void writeRawNrrd(const std::filesystem::path& path, const volume::Volume<std::uint16_t>& volume,
                  const core::Progress& progress = {});

/// Maps a file written by writeRawNrrd: voxels are read from disk when accessed, and the mapping
/// lives as long as the volume. The file must not be truncated meanwhile. Throws FileError if the
/// header is from another writer or the size is not exact.
std::shared_ptr<const volume::IntensityVolume> mapRawNrrd(const std::filesystem::path& path);

} // namespace petrous::imaging
