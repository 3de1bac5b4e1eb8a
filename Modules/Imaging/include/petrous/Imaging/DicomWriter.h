#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/SegmentCodes.h"

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
  std::string studyUid; ///< required
  std::string studyId = "1";
  std::string seriesUid;           ///< required; instance UIDs are derived from it
  std::string frameOfReferenceUid; ///< required
  /// CT: -1024; MR: 0, as its image module has no rescale; that of float voxels is added to it (a
  /// standard extended object, PS3.2).
  double rescaleIntercept = 0.0;
  double rescaleSlope = 1.0;      ///< > 0; value = slope * stored + intercept
  std::string rescaleType = "HU"; ///< of CT: "HU", or "US" for values that are not calibrated
  /// Exported from an image of a patient: DERIVED\\SECONDARY, with nothing about acquisition,
  /// position on the table or date, which are not known, and stated to be without identity. Else a
  /// phantom's.
  bool derived = false;
  /// What is known to be wrong with the pixels, which those that get the file must know, too. With
  /// text in them, also if only suspected, it is written that they have some (0028,0301), and
  /// nothing of a removed identity.
  PixelFaults faults = {};
  /// (0008,2111) what was done to the image, up to 900 characters; empty: nothing.
  std::string derivation = {};
  /// Slices in which nothing was measured, which derivation and Image Type (kInterpolatedType) of
  /// each of them say; readSeries knows them again.
  std::vector<volume::SliceRange> interpolated = {};
  double windowCenter = 700.0; ///< in the image's units
  double windowWidth = 4000.0;
};

/// How float voxels are stored in 16 bits: value = slope * stored + intercept.
struct StoredFractions
{
  double slope = 1.0;
  double intercept = 0.0;
  double error =
      0.0; ///< the largest of a voxel, at most half a slope but for the float's own digits
};

/// The finest rescale with which the voxels of a float image fit 16 bits unsigned: a power of two
/// if that keeps them exactly, else their range in 65535 steps. nullopt: a voxel is not finite.
std::optional<StoredFractions> storedFractions(const volume::Volume<float>& image);

/// SOP Instance UID of slice k (from 0) of a series that writeDicomSeries wrote.
std::string instanceUid(const std::string& seriesUid, int k);

/// Writes one file per slice, `slice-0001.dcm` onwards, as CT or MR Image Storage, explicit VR
/// little endian, 16 bits, in parallel. Dates are fixed: same input, same bytes.
///
/// folder     created if missing; files of the same name are replaced. For a series that is whole
///            or absent, and durable, give a folder in a core::OutputFolder
/// image      int16 or uint16 voxels; float ones are stored as uint16 by the description's rescale
///            (storedFractions). Padding that a voxel has goes to PixelPaddingValue
/// sliceStep  patient displacement (mm) from one slice to the next if it is not along the slice
///            normal, as with a tilted gantry
///
/// Throws InvalidParameter for an invalid description, Error (Internal) naming the file that could
/// not be written, CancelledError. Files written before the error remain.
void writeDicomSeries(const std::filesystem::path& folder, const volume::IntensityVolume& image,
                      const SeriesDescription& description,
                      const std::optional<Eigen::Vector3d>& sliceStep = std::nullopt,
                      const core::Progress& progress = {});

using CodedConcept = volume::CodedConcept;

/// Attributes of a DICOM segmentation to be written. None of them is a person's.
struct SegmentationDescription
{
  enum class Algorithm
  {
    Manual,
    SemiAutomatic,
    Automatic
  };

  struct Segment
  {
    std::size_t map = 0;          ///< which of the label maps
    std::uint16_t index = 0;      ///< its voxel value there
    std::string label;            ///< UTF-8, not empty; what is beyond 64 characters is cut off
    std::array<float, 3> color{}; ///< sRGB, 0 to 1
    CodedConcept category{"123037004", "SCT", "Anatomical Structure"}; ///< CID 7150
    CodedConcept type{"123037004", "SCT", "Anatomical Structure"};
    CodedConcept typeModifier = {}; ///< these are written if they are not empty
    CodedConcept region = {};
    CodedConcept regionModifier = {}; ///< of `region`, without which it is not written
    Algorithm algorithm = Algorithm::Manual;
    std::string algorithmName; ///< required unless Manual
  };

  /// The series that writeDicomSeries wrote from the image on which the segments are drawn.
  struct Source
  {
    SeriesDescription::Modality modality = SeriesDescription::Modality::Ct;
    std::string seriesUid;
    int slices = 0;
    bool onSlices = false; ///< the label maps' grid is the image's: frames refer to their slices
  };

  std::string description;
  int seriesNumber = 10;
  std::string patientId = "ANONYMOUS";
  std::string patientName = "Anonymous";
  std::string studyUid; ///< required
  std::string studyId = "1";
  std::string seriesUid;           ///< required; the instance's UID is derived from it
  std::string frameOfReferenceUid; ///< required
  std::optional<Source> source;
  std::vector<Segment> segments; ///< numbered from 1 in this order
};

/// Writes segments as one DICOM segmentation (PS3.3 A.51, BINARY), atomically: a frame for each
/// slice in which a segment has voxels, in the order of segments and slices, so that segments may
/// overlap. No date is known: the required content date is a fixed one (1 January 1900), and equal
/// input gives equal bytes.
///
/// maps   on one grid, patient LPS mm
///
/// Throws InvalidParameter for an invalid description, for maps on different grids and if no
/// segment has a voxel, FileError if the file cannot be written, CancelledError.
void writeDicomSegmentation(const std::filesystem::path& path,
                            const std::vector<volume::LabelMap>& maps,
                            const SegmentationDescription& description,
                            const core::Progress& progress = {});

} // namespace petrous::imaging
