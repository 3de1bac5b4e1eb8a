#pragma once

#include <filesystem>
#include <string>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// What a file turned out to be.
enum class FileKind
{
  Foreign,   ///< not DICOM; slice.damage says where it may have been a slice
  Directory, ///< a DICOMDIR: an index, no object of its own
  Broken,    ///< DICOM, but damaged before it says to which series it belongs
  Dicom      ///< an object of a series; slice.damage says whether its pixels can be read
};

struct FileHeader
{
  FileKind kind = FileKind::Foreign;
  std::string seriesUid;
  std::string modality;
  std::string description;
  SliceHeader slice;
};

/// Reads everything before the pixels, and checks that the pixels are all there. Never throws on
/// bad content. Thread-safe.
FileHeader readHeader(const std::filesystem::path& file);

} // namespace petrous::imaging
