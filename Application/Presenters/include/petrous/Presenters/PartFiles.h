#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Presenters/SourceContent.h"

namespace petrous::presenters
{

/// Structures or meshes that lie as other files than DICOM among or beside the slices of a scan.
struct PartFiles
{
  Content content = Content::Labels; ///< Labels or Mesh
  /// A file, or a folder of masks; several meshes of one folder.
  std::vector<std::filesystem::path> paths;
  std::size_t count = 1;  ///< masks of a folder, or meshes
  std::string text;       ///< "12 masks, one structure a file", for the user
  bool isBelow = true;    ///< at or below the scanned path; otherwise in a folder beside it
  std::string image = {}; ///< selectorOf the series whose grid labels have; empty: of none
};

/// What can be told of the files by header, name and some of their slices: whole numbers in patches
/// are labels (contentOf), other volumes are not listed. Of a folder, files of one value are one
/// entry, and so are its meshes if they are many.
///
/// Beside the path (in the folder above it and in the folders there, if these are few) only labels
/// on the grid of an image of the scan are listed, and meshes together with such: nothing else
/// tells whose they are.
///
/// Sorted by path, first what lies below. Files that cannot be read are passed over. Throws
/// CancelledError.
std::vector<PartFiles> partFilesOf(const std::filesystem::path& path,
                                   const imaging::ScanResult& scan, const core::Progress& progress);

} // namespace petrous::presenters
