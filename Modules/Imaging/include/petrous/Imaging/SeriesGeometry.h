#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/PatientKey.h"
#include "petrous/Volume/ImageProvenance.h"

namespace petrous::imaging
{

/// Pixel encoding of a slice (DICOM C.7.6.3.1) and location of the pixels in the file.
struct PixelFormat
{
  int bitsAllocated = 0;
  int bitsStored = 0;
  int highBit = 0;
  bool isSigned = false;
  bool isReal = false; ///< float or double, in as many bits as are allocated
  int samplesPerPixel = 1;
  std::string photometric;    ///< e.g. MONOCHROME2
  std::string transferSyntax; ///< UID
  bool isEncapsulated = false;
  bool isBigEndian = false;
  bool isWords = false;          ///< written as words of 16 bits (OW), also if a pixel has fewer
  bool isDeflated = false;       ///< the offset then refers to the inflated file
  std::uint64_t offset = 0;      ///< of the value of the pixel data element, bytes
  std::uint64_t offsetTable = 0; ///< of the value of an extended offset table; 0: none
  int frame = 0;                 ///< of an encapsulated file with several
  int frameCount = 1;            ///< in the file
  std::uint64_t length = 0;      ///< bytes; up to the end of the file if encapsulated
};

/// What becomes of bits of a pixel beside those that the header says are stored, which neither an
/// overlay nor the sign explains. PS3.5 8.1.1 lets them be anything; but metal that needs more bits
/// than a careless header states has them too, and would be soft tissue without them.
enum class UndeclaredBits
{
  Refuse,
  LeaveOut, ///< as DICOM says
  Keep      ///< as if all bits allocated were stored
};

/// What distinguishes slices of one series at the same place. Absent or malformed: nullopt.
struct SliceTraits
{
  std::optional<double> bValue;       ///< s/mm^2
  std::optional<double> echoTime;     ///< ms
  std::optional<double> triggerTime;  ///< ms
  std::optional<double> phasePercent; ///< (0020,9241) nominal percentage of the cardiac phase
  std::optional<double> inversionTime;
  std::optional<int> echo;     ///< EchoNumbers
  std::optional<int> temporal; ///< TemporalPositionIdentifier or -Index
  std::string gradient;        ///< diffusion gradient orientation as written
  std::string stack;           ///< StackID of a multi-frame file
};

/// What tells that a file was replaced or changed.
struct FileStamp
{
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::uint64_t size = 0;    ///< bytes
  std::int64_t modified = 0; ///< contents, ns since 1970
  std::int64_t changed = 0;  ///< contents, name or rights, ns since 1970
};

using volume::BurnedInText;
using volume::PixelFaults;

/// Of an image's attributes. `sopClass`: its UID; `imageType`: all values; `isConverted`: it has a
/// Conversion Type (0008,0064).
BurnedInText burnedInText(const std::string& annotation, const std::string& modality,
                          const std::string& sopClass, const std::string& imageType,
                          bool isConverted);

/// Header of one slice. Absent or malformed numbers are nullopt.
struct SliceHeader
{
  std::filesystem::path file;
  FileStamp stamp;                                ///< of the file when its header was read
  std::optional<Eigen::Vector3d> position;        ///< centre of the first pixel, patient LPS mm
  std::optional<Eigen::Vector3d> rowDirection;    ///< along a row, increasing column index
  std::optional<Eigen::Vector3d> columnDirection; ///< along a column, increasing row index
  std::optional<Eigen::Vector2d> pixelSpacing;    ///< mm, DICOM order: between rows, columns
  int rows = 0;
  int columns = 0;
  int frames = 1; ///< more than one: without the functional groups that would place them
  double slope = 1.0;
  double intercept = 0.0;
  bool hasRescale = false;
  std::string rescaleType; ///< (0028,1054) unit of the rescaled values, e.g. HU; empty: not stated
  /// The values are Hounsfield units, as the file states of a helical CT or this program of its own
  /// file. Cone beam states them, too, and has others.
  bool isCalibrated = false;
  bool isLossy = false;             ///< the pixels were compressed with loss, once
  bool isLossUnknown = false;       ///< the compressed pixels do not say whether they were
  std::optional<double> lossyRatio; ///< of that compression, if stated
  BurnedInText burnedIn = BurnedInText::None;
  std::optional<double> declaredSpacing;   ///< SpacingBetweenSlices, mm; noted, never used
  std::optional<double> thickness;         ///< mm
  std::optional<double> declaredTilt;      ///< GantryDetectorTilt, degrees; noted only
  std::optional<double> padding;           ///< PixelPaddingValue, stored value
  std::optional<double> paddingRangeLimit; ///< other end of the padding range, stored value
  /// Acquisition date and time, for the user's own screen only: "20200131 1205", else those of the
  /// series or study; empty: not stated. Never stored.
  std::string taken;
  std::string patientPosition; ///< (0018,5100), e.g. HFS; likewise
  int instanceNumber = 0;
  std::optional<int> stackPosition;   ///< InStackPositionNumber of a frame
  std::optional<int> declaredCount;   ///< images of the series or acquisition, as the file states
  bool isImage = true;                ///< has pixel data
  std::vector<std::string> imageType; ///< values, e.g. ORIGINAL PRIMARY AXIAL
  std::string frameOfReferenceUid;
  PatientKey patient;
  std::string studyUid;
  std::string modality;
  std::string kernel;              ///< ConvolutionKernel
  std::optional<double> tube;      ///< KVP, kV
  std::optional<int> seriesNumber; ///< unique within a series
  std::optional<int> acquisition;  ///< AcquisitionNumber
  SliceTraits traits;
  double positionStep = 0.0;   ///< unit of the last decimal of the position, mm; 0: not known
  bool hasModalityLut = false; ///< a table replaces slope and intercept
  PixelFormat pixels;
  std::string damage; ///< empty, or why the file cannot be read ("is cut short")
};

PixelFaults pixelFaults(const std::vector<SliceHeader>& slices);

/// Value of Image Type (0008,0008; PS3.3 C.7.6.1.1.2 leaves those from the fourth on to programs)
/// of a slice that repair interpolated, as writeDicomSeries writes it.
constexpr const char* kInterpolatedType = "INTERPOLATED_GAP";
bool isInterpolated(const SliceHeader& slice);

/// Possible defects of a series; kindName gives the names used in the command's JSON.
enum class FindingKind
{
  GantryTilt,
  MissingSlice,
  UnevenSpacing,
  DuplicateSlice,
  SideBySide, ///< several stacks, at the same heights and places beside each other
  OddOrientation,
  OddSize,
  MixedRescale,
  ModalityLut,
  MixedPatients,
  MixedStudies,
  MixedAcquisitions,
  NoGeometry,
  LocalizerMixedIn,
  MissingEnd,     ///< no reason for a verdict
  MissingBetween, ///< likewise: every second slice of the whole stack, or more of them
  MultiFrame,
  NotAnImage,
  Unreadable
};
const char* kindName(FindingKind kind) noexcept;

struct Finding
{
  FindingKind kind;
  std::string text;     ///< one sentence; no patient data
  double errorMm = 0.0; ///< voxel position error if ignored; 0 if not geometric
};

enum class Verdict
{
  Ok,         ///< the grid describes the slices correctly
  Repairable, ///< would be misleading as it is; ReadOptions::repair resamples it
  Refused     ///< would be misleading
};
const char* verdictName(Verdict verdict) noexcept;

/// The slices of a series, ordered by position in the patient, and whether they form a straight
/// stack.
struct SeriesGeometry
{
  /// Usable slices, sorted by position along the normal (row x column); slice k of the volume.
  /// After a refusal still sorted, without those excluded by the findings.
  std::vector<SliceHeader> slices;

  /// Third axis along the normal, origin at slices.front(). After a refusal the nearest straight
  /// grid (ignoring shear and gaps); none if the files do not state positions.
  std::optional<core::GridGeometry> grid;

  /// No gap is wider than one missing slice leaves, and few slices would be guessed.
  bool isBridgeable = true;
  Verdict verdict = Verdict::Refused;
  /// Refused only since more than a few slices share their places: repairable if the pixels of
  /// those at one place are equal, which the headers do not tell.
  bool isRepairableIfEqual = false;
  /// The reasons for the verdict, localizers set aside, and slices that may be missing. Those of
  /// kinds Unreadable and NoGeometry name files.
  std::vector<Finding> findings;
  std::vector<std::string> notes; ///< accepted but worth knowing, e.g. jitter
};

/// Corners of slices of one orientation and size agree within this, and the ends of a straight
/// stack, mm; the lean of a straight stack.
constexpr double kJitterTolerance = 0.1;
constexpr double kJitterShare = 0.01;

/// A slice may lie this far from its place, mm; or this fraction of the slice spacing (sideways: of
/// the pixel spacing); or one unit of the last decimal of the positions, if that is more: of the
/// slice with the most decimals, as writers trim zeros.
constexpr double kPlaceTolerance = 0.05;
constexpr double kPlaceShare = 0.1;

/// Assesses the stack from the slice positions alone. The order of `slices` does not matter. Never
/// throws on bad headers: they become findings. Throws CancelledError.
SeriesGeometry assess(std::vector<SliceHeader> slices, const core::Progress& progress = {});

} // namespace petrous::imaging
