#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

struct LoadedImage
{
  std::shared_ptr<const volume::IntensityVolume> volume;
  std::vector<std::string> notes; ///< what was assumed or changed, one sentence each
};

/// Whether the name ends in .nii, .nii.gz, .nrrd, .nhdr, .mha or .mhd (upper or lower case).
bool isImageFileName(const std::filesystem::path& path);

/// Reads a CT or MR from a NIfTI, NRRD or MetaImage file.
///
/// int16, uint16 and float stay as they are; 8-bit integers become int16; wider types become
/// int16 or uint16 where every value is integral and fits, else float. With `roi` only the
/// smallest box of voxels whose hull covers it is kept. Positions become patient LPS mm; a unit
/// that the file does not state is taken as mm and noted.
///
/// Throws FileError: NoGeometry for axes that are not perpendicular, Unsupported for images that
/// are 2-D, 4-D or hold vectors, colours or values that are not finite, and for a roi that misses
/// the image; CancelledError.
LoadedImage readImageFile(const std::filesystem::path& path,
                          const std::optional<core::PatientBox>& roi = std::nullopt,
                          const core::Progress& progress = {});

} // namespace petrous::imaging
