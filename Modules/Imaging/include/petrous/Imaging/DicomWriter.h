#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// A UID below 2.25 (ITU-T X.667) that depends only on seed and role, so that the same seed gives
/// the same files, e.g. deterministicUid(1, "ct.series").
std::string deterministicUid(std::uint64_t seed, const std::string& role);

/// Attributes of a series to be written. None of them is a person's.
struct SeriesDescription
{
  enum class Modality
  {
    Ct,
    Mr
  };

  Modality modality = Modality::Ct;
  std::string description;
  int seriesNumber = 1;
  std::string patientId = "PHANTOM";
  std::string patientName = "Phantom^Petrous";
  std::string studyUid;            ///< required
  std::string seriesUid;           ///< required; instance UIDs are derived from it
  std::string frameOfReferenceUid; ///< required
  double rescaleIntercept = 0.0;   ///< CT: -1024; MR: 0 (its image module has no rescale)
  double rescaleSlope = 1.0;       ///< > 0; value = slope * stored + intercept
  std::string rescaleType = "HU";  ///< of CT: "HU", or "US" for values that are not calibrated
  /// Exported from an image of a patient: DERIVED\\SECONDARY, with nothing about acquisition,
  /// position on the table or date, which are not known, and stated to be without identity. Else a
  /// phantom's.
  bool derived = false;
  double windowCenter = 700.0;     ///< in the image's units
  double windowWidth = 4000.0;
};

/// Writes one file per slice, `slice-0001.dcm` onwards, as CT or MR Image Storage, explicit VR
/// little endian, 16 bits, in parallel. Dates are fixed: same input, same bytes.
///
/// folder     created if missing; files of the same name are replaced. For a series that is whole
///            or absent, and durable, give a folder in a core::OutputFolder
/// image      int16 or uint16 voxels (float is rejected); padding goes to PixelPaddingValue
/// sliceStep  patient displacement (mm) from one slice to the next if it is not along the slice
///            normal, as with a tilted gantry
///
/// Throws InvalidParameter for an invalid description, Error (Internal) naming the file that could
/// not be written, CancelledError. Files written before the error remain.
void writeDicomSeries(const std::filesystem::path& folder, const volume::IntensityVolume& image,
                      const SeriesDescription& description,
                      const std::optional<Eigen::Vector3d>& sliceStep = std::nullopt,
                      const core::Progress& progress = {});

} // namespace petrous::imaging
