#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// A DICOM folder or series that cannot be used. The message never carries patient data.
struct DicomError : core::Error
{
  enum class Reason
  {
    NotFound,     ///< no such file or folder, or it may not be read
    NoImages,     ///< nothing there that is a DICOM image
    NoSuchSeries, ///< the UID asked for is not there
    Ambiguous,    ///< several series, and none asked for
    Misleading,   ///< the geometry verdict is not ok
    Unreadable,   ///< a file is damaged, or gone since the scan
    Unsupported,  ///< colour, palette, an unknown compression
    OutsideRoi    ///< the box asked for does not meet the volume
  };
  DicomError(Reason reason, const std::string& message)
    : core::Error(core::Fault::BadInput, message)
    , m_reason(reason)
  {
  }
  Reason reason() const noexcept { return m_reason; }

private:
  Reason m_reason;
};

/// One SeriesInstanceUID below the scanned path.
struct DicomSeries
{
  std::string uid;
  std::string modality;
  std::string description; ///< may say who the patient is: for the user's own screen only
  std::string frameOfReferenceUid;
  std::size_t files = 0; ///< all of the series, also those that are not slices
  SeriesGeometry geometry;
};

struct ScanResult
{
  std::vector<DicomSeries> series; ///< by first file's path
  std::vector<Finding> unreadable; ///< damaged DICOM files that belong to no known series
  std::size_t foreignFiles = 0;    ///< files that are not DICOM
  /// What was left out below the path, one sentence each. Names files and folders, which may be
  /// called after the patient: for the user's own screen only.
  std::vector<std::string> notes;
};

/// Reads the header of every DICOM file at or below `path`, in parallel, and judges each series.
///
/// Files are known by content, not by name; each file is read once. Links to files are followed,
/// links to folders where they stay below `path`. A file that is not DICOM, but is named as the
/// slices beside it are, is a lost slice; so is an empty one with their ending. A series is refused
/// where a lost slice in its folder, or a folder that may not be read, may hold more of it. Links
/// that are not followed are noted.
///
/// Throws DicomError (NotFound) and CancelledError.
ScanResult scanDicom(const std::filesystem::path& path, const core::Progress& progress);

/// The series that a user who named `path` means: the one of that UID; without one, the only
/// series that is ok, else the largest image series (reading it tells what is wrong with it).
/// Throws DicomError naming what was found instead; Ambiguous lists the UIDs.
const DicomSeries& chooseSeries(const ScanResult& result, const std::filesystem::path& path,
                                const std::string& uid = {});

} // namespace petrous::imaging
