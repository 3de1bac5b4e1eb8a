#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"

namespace petrous::imaging
{

/// How the pixels of a slice are coded (DICOM C.7.6.3.1), and where they lie in the file.
struct PixelFormat
{
  int bitsAllocated = 0;
  int bitsStored = 0;
  int highBit = 0;
  bool isSigned = false;
  int samplesPerPixel = 1;
  std::string photometric;    ///< e.g. MONOCHROME2
  std::string transferSyntax; ///< UID
  bool isEncapsulated = false;
  bool isBigEndian = false;
  bool isDeflated = false;  ///< then the offset counts in the inflated file
  std::uint64_t offset = 0; ///< byte where the pixel element's value begins
  std::uint64_t length = 0; ///< bytes of it; up to the end of the file where encapsulated
};

/// What tells two patients apart, as hashes: nothing of it can reach a message. 0: not stated.
struct PatientKey
{
  std::size_t id = 0;
  std::size_t name = 0;
  std::size_t birthDate = 0;
};

/// What one file says about its slice. Absent or garbled numbers are nullopt.
struct SliceHeader
{
  std::filesystem::path file;
  std::optional<Eigen::Vector3d> position;        ///< first pixel's centre, patient LPS mm
  std::optional<Eigen::Vector3d> rowDirection;    ///< along a row, as the column index grows
  std::optional<Eigen::Vector3d> columnDirection; ///< down a column, as the row index grows
  std::optional<Eigen::Vector2d> pixelSpacing;    ///< mm, DICOM order: between rows, columns
  int rows = 0;
  int columns = 0;
  int frames = 1;
  double slope = 1.0;
  double intercept = 0.0;
  bool hasRescale = false;
  std::optional<double> declaredSpacing;   ///< SpacingBetweenSlices, mm; noted, never believed
  std::optional<double> thickness;         ///< mm
  std::optional<double> declaredTilt;      ///< GantryDetectorTilt, degrees; noted only
  std::optional<double> padding;           ///< PixelPaddingValue, stored value
  std::optional<double> paddingRangeLimit; ///< other end of the padding's range, stored value
  /// When it was taken, for the user's own screen only: "20200131 1205", else of the series or
  /// study; empty: not stated. Never stored.
  std::string taken;
  std::string patientPosition; ///< (0018,5100), e.g. HFS; likewise
  int instanceNumber = 0;
  bool isImage = true;                ///< has pixel data
  std::vector<std::string> imageType; ///< words, e.g. ORIGINAL PRIMARY AXIAL
  std::string frameOfReferenceUid;
  PatientKey patient;
  std::string studyUid;
  std::string modality;
  std::string kernel;              ///< ConvolutionKernel
  std::optional<double> tube;      ///< KVP, kV
  std::optional<int> seriesNumber; ///< one series has one
  std::optional<int> acquisition;  ///< AcquisitionNumber
  bool hasModalityLut = false;     ///< a table takes the place of slope and intercept
  PixelFormat pixels;
  std::string damage; ///< empty, or why the file cannot be read ("is cut short")
};

/// What can be wrong with a series; the names of kindName are those of the command's JSON.
enum class FindingKind
{
  GantryTilt,
  MissingSlice,
  UnevenSpacing,
  DuplicateSlice,
  OddOrientation,
  OddSize,
  MixedRescale,
  ModalityLut,
  MixedPatients,
  MixedStudies,
  MixedAcquisitions,
  NoGeometry,
  LocalizerMixedIn,
  MultiFrame,
  NotAnImage,
  Unreadable
};
const char* kindName(FindingKind kind) noexcept;

struct Finding
{
  FindingKind kind;
  std::string text;     ///< one sentence; no patient data
  double errorMm = 0.0; ///< how far off a voxel would lie were this passed over; 0 if not geometry
};

enum class Verdict
{
  Ok,         ///< reads as the grid says
  Repairable, ///< would mislead; a repair is known
  Refused     ///< would mislead
};
const char* verdictName(Verdict verdict) noexcept;

/// The slices of a series in their order in the patient, and whether they make a straight stack.
struct SeriesGeometry
{
  /// Usable slices, by position along the normal (row x column); slice k of the volume. After a
  /// refusal they are still in order, without those that the findings set aside.
  std::vector<SliceHeader> slices;

  /// Third axis along the normal, origin at slices.front(). After a refusal the nearest straight
  /// grid (shear and gaps passed over); none where the files do not say where they lie.
  std::optional<core::GridGeometry> grid;

  Verdict verdict = Verdict::Refused;
  std::vector<Finding> findings;  ///< what decided the verdict
  std::vector<std::string> notes; ///< accepted, worth knowing: e.g. jitter below 0.1 mm
};

/// A step of less than both is accepted: mm, and share of the slice spacing.
constexpr double kJitterTolerance = 0.1;
constexpr double kJitterShare = 0.01;

/// Judges the stack from the slices' own positions. The order of `slices` does not matter.
/// Never throws on bad headers: they become findings.
SeriesGeometry assess(std::vector<SliceHeader> slices);

} // namespace petrous::imaging
