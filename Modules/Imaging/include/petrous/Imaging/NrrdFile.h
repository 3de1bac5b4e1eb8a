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

enum class VoxelAccess
{
  Automatic, ///< Copied from network and user-space file systems and those of removable media,
             ///< where memory allows
  Mapped,    ///< read from disk when accessed; a page that cannot be read then ends the program
  Copied     ///< read whole; unplugging the medium afterwards changes nothing
};

/// Opens a file written by writeRawNrrd. A mapping lives as long as the volume; its file must not
/// be truncated meanwhile. Throws FileError if the header is from another writer, the size is not
/// exact or the voxels cannot be read.
std::shared_ptr<const volume::IntensityVolume>
mapRawNrrd(const std::filesystem::path& path, VoxelAccess access = VoxelAccess::Automatic);

} // namespace petrous::imaging
