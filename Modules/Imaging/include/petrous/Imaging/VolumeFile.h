#pragma once

#include <cstdint>
#include <filesystem>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// Writes voxels for other programs: .nrrd (gzip), .nii, .nii.gz or .mha, with their own type and
/// position (patient LPS mm; NIfTI states it as RAS). The file is written atomically, and equal
/// volumes give equal bytes. T: std::int16_t, std::uint16_t, std::uint8_t, float. Throws FileError,
/// CancelledError.
template <class T>
void writeVolume(const std::filesystem::path& path, const volume::Volume<T>& volume,
                 const core::Progress& progress = {});

/// As above, with the voxel type of the image. `isHounsfield`: its values are Hounsfield units,
/// which the file then states for this program (LoadedImage).
void writeVolume(const std::filesystem::path& path, const volume::IntensityVolume& volume,
                 const core::Progress& progress = {}, bool isHounsfield = false);

extern template void writeVolume(const std::filesystem::path&, const volume::Volume<std::int16_t>&,
                                 const core::Progress&);
extern template void writeVolume(const std::filesystem::path&, const volume::Volume<std::uint16_t>&,
                                 const core::Progress&);
extern template void writeVolume(const std::filesystem::path&, const volume::Volume<std::uint8_t>&,
                                 const core::Progress&);
extern template void writeVolume(const std::filesystem::path&, const volume::Volume<float>&,
                                 const core::Progress&);

} // namespace petrous::imaging
