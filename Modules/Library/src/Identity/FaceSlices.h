#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
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
  struct Frame
  {
    imaging::SliceHeader slice;
    /// Of its volume, else of another one of the file; nullptr: no face is in it.
    std::shared_ptr<const volume::FaceRegion> region;
  };
  struct File
  {
    std::map<std::uint64_t, Frame> frames; ///< of all its volumes, by the place of their pixels
    std::set<std::string> texts;           ///< why there is no face in volumes of it
    std::string doubt;                     ///< why a face that it may hold cannot be masked

    bool hasFace() const;
  };

  /// Reads all volumes, one after the other. What is not a volume has no entry. Throws
  /// CancelledError.
  FaceSlices(const std::filesystem::path& path, const core::Progress& progress);

  const File* find(const std::filesystem::path& file) const; ///< nullptr: none

private:
  std::map<std::filesystem::path, File> m_files;
};

/// Why the file cannot leave with its face masked; empty: it can. `frames`: that it states.
std::string unmaskable(const FaceSlices::File& file, std::size_t frames);

/// Puts air in place of the face in native pixels of 16 bits. Returns why that cannot be done, and
/// has then changed nothing; empty: done.
std::string maskFaceInPixels(DcmItem& dataSet, const FaceSlices::File& file);

} // namespace petrous::library
