#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "DicomElements.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Classification of a file.
enum class FileKind
{
  Foreign,   ///< not DICOM; slice.damage is set if it may have been a slice
  Directory, ///< a DICOMDIR: an index without an object of its own
  Broken,    ///< DICOM, but damaged before its series is stated
  Dicom      ///< an object of a series; slice.damage is set if its pixels cannot be read
};

struct FileHeader
{
  FileKind kind = FileKind::Foreign;
  bool hasFailed = false; ///< opening or reading failed: another attempt may succeed
  std::string sopClass;   ///< UID
  std::string seriesUid;
  std::string modality;
  std::string description;
  SliceHeader slice;
  std::vector<SliceHeader> frames; ///< of an enhanced CT or MR; else empty, and `slice` is the one
};

/// Reads everything before the pixel data, and checks that the pixels are complete. Never throws on
/// bad content. Thread-safe.
FileHeader readHeader(const std::filesystem::path& file);

/// The identity that a data set states. Letters of a character set that is not read are taken as
/// they are.
PatientKey patientOf(const DicomElements& elements);

} // namespace petrous::imaging
