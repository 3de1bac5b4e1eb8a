#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Volume/FaceMask.h"

class DcmItem;

namespace petrous::library
{

/// Faces in the CT and MR volumes below a path, by the files of their slices.
class FaceSlices
{
public:
  struct File
  {
    /// Of its volume; nullptr: no face is in it.
    std::shared_ptr<const volume::FaceRegion> region;
    std::string text;                         ///< why there is none
    std::vector<imaging::SliceHeader> frames; ///< in the order of the file
  };

  /// Reads all volumes, one after the other. What is not a volume has no entry. Throws
  /// CancelledError.
  FaceSlices(const std::filesystem::path& path, const core::Progress& progress);

  const File* find(const std::filesystem::path& file) const; ///< nullptr: none

private:
  std::map<std::filesystem::path, File> m_files;
};

/// Puts air in place of the face in native pixels of 16 bits. Returns why that cannot be done, and
/// has then changed nothing; empty: done.
std::string maskFaceInPixels(DcmItem& dataSet, const FaceSlices::File& file);

} // namespace petrous::library
