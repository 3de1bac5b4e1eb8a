#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// Writes a raw NRRD that opens by mapping it: patient LPS mm, numbers exact to the bit, voxels
/// uncompressed and little-endian from a multiple of 4096 bytes on. Other programs open it too.
/// The file appears whole, and safe on the disk, or not at all; equal volumes give equal bytes.
/// Throws FileError, CancelledError.
void writeRawNrrd(const std::filesystem::path& path, const volume::IntensityVolume& volume,
                  const core::Progress& progress = {});
void writeRawNrrd(const std::filesystem::path& path, const volume::Volume<std::uint16_t>& volume,
                  const core::Progress& progress = {});

/// Maps a file of writeRawNrrd: the voxels are read from the disk when they are touched, and the
/// map lives as long as the volume. The file must not be shortened meanwhile.
/// Throws FileError when the header is of another writer or the size is not exactly right.
std::shared_ptr<const volume::IntensityVolume> mapRawNrrd(const std::filesystem::path& path);

} // namespace petrous::imaging
