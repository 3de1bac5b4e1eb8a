#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// That a file of voxels is no head, ear or specimen in the unit of length that it states, or in
/// the mm that is assumed where it states none.
struct UnitDoubt
{
  double unit = 1.0; ///< mm
  bool isStated = false;
  double edge = 0.0;          ///< mm, its longest in that unit
  std::vector<double> likely; ///< mm, units in which it may be one; empty: there is no doubt
};

struct LoadedImage
{
  std::shared_ptr<const volume::IntensityVolume> volume;
  std::vector<std::string> notes; ///< what was assumed or changed, one sentence each
  /// Whether the file leaves open which side of the patient is left: axes RAS (true) or LPS (false)
  /// were taken. nullopt: it states it.
  std::optional<bool> assumedRas;
  /// Its values are Hounsfield units: this program wrote it of an image in these.
  bool isHounsfield = false;
};

/// Reads a CT or MR from a NIfTI, NRRD or MetaImage file.
///
/// int16, uint16 and float are kept; 8-bit integers become int16; wider types become int16 or
/// uint16 if all values are integral and fit, else float. With `roi`, only the smallest voxel box
/// whose hull covers it is kept. Positions are converted to patient LPS mm by the unit of length
/// that the file states, or `unit` (mm); one that is not stated is taken as mm and noted; a
/// doubtful one (unitDoubtOf) is taken all the same. Of a file that leaves open which side of
/// the patient is left (NIfTI without qform and sform, NRRD without a patient's 'space', MetaImage
/// without TransformMatrix) `isRas` says how its axes count. Of a file of several volumes (a fourth
/// axis; of a NRRD also a first one of kind "list" or "time") `volume` is the number of the one
/// that is read, from 1; 0: there is but one.
///
/// Throws FileError: NoGeometry for axes that are not perpendicular; Unsupported for 2-D images,
/// vectors, colours and non-finite values, for a roi outside the image, for a volume that is not
/// there, and for several if none is named; CancelledError.
LoadedImage readImageFile(const std::filesystem::path& path,
                          const std::optional<core::PatientBox>& roi = std::nullopt,
                          const core::Progress& progress = {},
                          const std::optional<bool>& isRas = std::nullopt, std::size_t volume = 0,
                          const std::optional<double>& unit = std::nullopt);

/// The likeliest of its units, mm, for who looks at the voxels before the user is asked where they
/// lie; nullopt: the file's own makes sense.
std::optional<double> likelyUnit(const UnitDoubt& doubt);

/// What the header of a file of voxels says.
struct ImageHeader
{
  core::GridGeometry grid;        ///< patient LPS mm
  std::size_t components = 1;     ///< numbers a voxel: layers of a segmentation, vectors, colours
  std::size_t volumes = 1;        ///< see readImageFile
  std::optional<bool> assumedRas; ///< LoadedImage
  UnitDoubt unitDoubt;
};
/// Throws FileError; with a `volume` also where readImageFile would, as far as the header tells.
ImageHeader readImageHeader(const std::filesystem::path& path,
                            const std::optional<std::size_t>& volume = std::nullopt);

/// The volume that a selector as of a DICOM series names ("#3", "3"); 0: none. Throws FileError for
/// one that is no number.
std::size_t volumeNumber(const std::filesystem::path& path, const std::string& selector);

/// LoadedImage::assumedRas of a file, by its header alone. Throws FileError.
std::optional<bool> assumedRasOf(const std::filesystem::path& path);
/// Likewise, whether its size makes sense.
UnitDoubt unitDoubtOf(const std::filesystem::path& path);

} // namespace petrous::imaging
