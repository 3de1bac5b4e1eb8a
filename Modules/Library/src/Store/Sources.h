#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::library
{

/// Where parts of a library's cases were read from, in its file "sources": a line each, the salted
/// SHA-256 of the path and when it was read, in ns of the file clock. A path may name the patient,
/// and stands nowhere.
class Sources
{
public:
  /// Reads the file; empty where it is not there. Throws LibraryError if it cannot be read.
  explicit Sources(const std::filesystem::path& library);

  bool empty() const noexcept { return m_read.empty(); }

  /// When the file or folder itself was read for the last time. `path`: resolvedPath.
  std::optional<std::filesystem::file_time_type> whenRead(const std::filesystem::path& path) const;

  /// Adds them, and those that links in a folder lead to, and writes the file if any is new. The
  /// library must be locked. Throws LibraryError.
  void add(const std::vector<scene::PartsOrigin>& origins);

private:
  std::string hashOf(const std::filesystem::path& path) const;

  std::filesystem::path m_file;
  std::string m_salt;
  std::map<std::string, std::filesystem::file_time_type> m_read; ///< by hash
};

} // namespace petrous::library
