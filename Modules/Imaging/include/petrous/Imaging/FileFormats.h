#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Imaging/FileError.h"

namespace petrous::imaging
{

class OutputFile;
class VoxelSource;
struct LoadedMesh;
struct VoxelsToWrite;

/// What a file can hold; combined as bits.
enum FileContent : unsigned
{
  kImage = 1,
  kLabels = 2,
  kMesh = 4,
  kDicom = 8,        ///< a slice of a series; see DicomScan.h
  kSegmentation = 16 ///< labels with identifiers, a DICOM SEG; see DicomWriter.h
};

/// A file format under one ending of a file's name: a row of the one table of formats, from which
/// reading, writing, file dialogs and messages are made. A new format is a row and its functions.
struct FileFormat
{
  std::string_view name;   ///< "NRRD"
  std::string_view ending; ///< ".nrrd", lower case
  unsigned reads;          ///< FileContent
  unsigned writes;         ///< FileContent

  /// Whether a file starts as the format does (its first 512 bytes, decompressed); null: the format
  /// has no mark.
  bool (*starts)(std::string_view bytes);

  // Private to the module; null for what is not read or written so.
  void (VoxelSource::*openVoxels)();
  void (*writeVoxels)(OutputFile& file, const VoxelsToWrite& voxels);
  LoadedMesh (*parseMesh)(const std::filesystem::path& path, std::string_view bytes,
                          const core::Progress& progress);
  std::string (*meshBytes)(const core::TriangleMesh& mesh,
                           const std::optional<std::array<float, 3>>& color);
};

/// The format by the ending of a file's name, case-insensitive, the longest that fits; else null.
const FileFormat* formatOf(const std::filesystem::path& path);

/// Whether the ending of a file's name is one that is read as any of these contents.
bool isReadAs(const std::filesystem::path& path, unsigned contents);

/// The format by a file's first bytes; null if it has no mark or cannot be read.
const FileFormat* recognisedFormat(const std::filesystem::path& path);

/// The endings under which any of these contents is read, without those that end in a shorter one
/// of them (".seg.nrrd").
std::vector<std::string_view> readEndings(unsigned contents);

/// All endings under which the contents are written.
std::vector<std::string_view> writtenEndings(unsigned contents);

/// ".obj, .stl, .ply or .vtp"
std::string orText(const std::vector<std::string_view>& endings);

/// The row with which to write `content` (one of several, combined as bits) under this name. Throws
/// FileError (UnknownFormat), which lists the endings that would be right.
const FileFormat& writingFormat(const std::filesystem::path& path, unsigned content);

/// File name without the ending of its format, or otherwise without its last extension.
std::string baseName(const std::filesystem::path& path);

} // namespace petrous::imaging
