#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/DerivedStore.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// A DICOM folder or series that cannot be used. The message never contains patient data.
struct DicomError : core::Error
{
  enum class Reason
  {
    NotFound,     ///< does not exist or is not readable
    NoImages,     ///< no DICOM images found
    NoSuchSeries, ///< no series with the requested UID
    Ambiguous,    ///< several series, none requested
    Misleading,   ///< the geometry verdict is not Ok
    Unreadable,   ///< a file is damaged, or has disappeared since the scan
    BitsUnclear,  ///< values of more than the bits stored: ReadOptions::undeclaredBits
    Unsupported,  ///< colour, palette, or an unknown compression
    OutsideRoi,   ///< the requested box does not intersect the volume
    TooLarge      ///< more than fits the memory that is free; the input is sound
  };
  DicomError(Reason reason, const std::string& message)
    : core::Error(reason == Reason::TooLarge ? core::Fault::Refused : core::Fault::BadInput,
                  message)
    , m_reason(reason)
  {
  }
  Reason reason() const noexcept { return m_reason; }

private:
  Reason m_reason;
};

/// What the files of a series are, by their SOP classes.
enum class SeriesKind
{
  Image,        ///< or none that is read as another
  Segmentation, ///< loadLabels
  StructureSet  ///< readStructureSet
};
/// "image", "segmentation" or "structure-set"
const char* kindName(SeriesKind kind) noexcept;

/// A SeriesInstanceUID found below the scanned path; or one of its volumes, if its slices make
/// several stacks (orientations, sizes, b-values, echoes, phases, kernels, repetitions).
struct DicomSeries
{
  std::string uid;
  std::string volume; ///< e.g. "b 1000", "echo 2"; distinct within the series; empty: its only one
  SeriesKind kind = SeriesKind::Image; ///< of what is no image none of the files is damaged
  std::string modality;
  std::string description; ///< may identify the patient: for the user's own screen only
  std::string frameOfReferenceUid;
  std::size_t files = 0; ///< all files of the series, including those that are not slices
  std::vector<std::filesystem::path> structures; ///< segmentations and structure sets in it
  std::size_t lostFiles = 0;                     ///< that a DICOMDIR lists and that are not there
  SeriesGeometry geometry;
};

struct ScanResult
{
  std::vector<DicomSeries>
      series; ///< sorted by path of the first file; volumes of one series adjoin
  std::vector<Finding> unreadable; ///< damaged DICOM files of no known series
  std::size_t foreignFiles = 0;    ///< files that are not DICOM
  /// Those of them whose names are of voxels or meshes (FileFormats.h): perhaps structures.
  std::vector<std::filesystem::path> notDicom;
  /// Files that a DICOMDIR lists and that are not there. Those of a series that is are a finding of
  /// it (MissingEnd), too.
  std::size_t lostFiles = 0;
  /// What was skipped below the path, one sentence each. Contains file and folder names, which may
  /// identify the patient: for the user's own screen only.
  std::vector<std::string> notes;
  /// Likewise, of each DICOMDIR with files that are not there.
  std::vector<std::string> lossNotes;
};

/// Reads the header of every DICOM file at or below `path` (of a DICOMDIR: its folder), in
/// parallel, and assesses each series.
///
/// Files are recognized by content, not by name; each file is read once. Symbolic links to files
/// are followed, links to folders only if they stay below `path`. A file that is not DICOM but is
/// named like the slices beside it is a lost slice; so is an empty one with their extension. A
/// series is refused if a lost slice in its folder may belong to it, unless it is whole without it:
/// its stack has no gap, and its instance numbers run from 0 or 1 without one (and to the number of
/// images that the header states, if it does). The lost slice is then set aside and noted, with the
/// millimetres by which the volume would be too short. An unreadable folder, which may hold any
/// number of slices, refuses all series. Links that are not followed are listed in `notes`.
///
/// With a `cache`, the headers of files that have not changed since an earlier scan of the same
/// path are taken from it; the result is the same. What it holds can be read only by someone who
/// has the files themselves.
///
/// Throws DicomError (NotFound) and CancelledError.
ScanResult scanDicom(const std::filesystem::path& path, const core::Progress& progress,
                     core::DerivedStore* cache = nullptr);

/// Selects the series meant by a user who gave `path`, by "UID", "UID#VOLUME" or "#VOLUME"; without
/// a UID the only series that is Ok, else the largest image series (reading it reports its
/// defects). One of several volumes is never chosen unasked, nor a sound series beside a repairable
/// one of the same modality with thinner slices or a longer stack. Throws DicomError listing what
/// was found; Ambiguous lists the UIDs and volumes.
const DicomSeries& chooseSeries(const ScanResult& result, const std::filesystem::path& path,
                                const std::string& selector = {});

/// Other CT or MR series and volumes of a scan, of more slices than a scout has: what may have been
/// meant instead of `series`, of any verdict.
std::vector<const DicomSeries*> otherImages(const ScanResult& result, const DicomSeries& series);

/// The slices of a series; of an image that cannot be used, as nothing places it, its files; 0: it
/// is no image.
std::size_t imageCount(const DicomSeries& series);

/// What chooseSeries selects this one by.
std::string selectorOf(const DicomSeries& series);

} // namespace petrous::imaging
