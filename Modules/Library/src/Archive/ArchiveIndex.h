#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace petrous::library
{

constexpr const char* kIndexEntry = "petrous.json";
constexpr const char* kManifestEntry = "case.json";

/// The first entry of an archive.
struct ArchiveIndex
{
  struct Object
  {
    std::string object;      ///< its name in the library
    std::string file;        ///< the archive's entry
    std::uint64_t bytes = 0; ///< in the library
    bool packed = false;     ///< an NRRD whose voxels are packed (GzipMembers.h) in the entry
  };
  std::string name;      ///< of the case
  bool planOnly = false; ///< images, label maps and meshes are left out
  std::string manifest;  ///< SHA-256 of kManifestEntry
  /// archiveMark, salted: by it the library knows its own archive, and nobody that two are of one
  /// library.
  std::string library;
  std::vector<Object> objects;
  std::vector<std::uint8_t> thumbnail; ///< or empty
};

/// `manifest`: its SHA-256.
inline std::string archiveMark(const std::string& manifest)
{
  return "archive " + manifest;
}

constexpr const char* kMarkOfAll = "archive"; ///< of archives that older programs wrote

std::string toText(const ArchiveIndex& index);

/// Throws LibraryError (Damaged) naming `file`, also for a newer format.
ArchiveIndex archiveIndex(std::string_view text, const std::filesystem::path& file);

} // namespace petrous::library
