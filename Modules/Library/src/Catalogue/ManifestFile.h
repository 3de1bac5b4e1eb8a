#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Catalogue.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

// The files in the folder cases/.

/// A manifest, without voxels; the case goes by `name`, whatever the manifest says. Throws
/// LibraryError and ManifestError.
scene::Case manifestIn(const std::filesystem::path& path, const std::string& name);

/// Names of all cases, sorted, damaged ones too. None where there is no such folder; throws
/// LibraryError (Damaged) where it cannot be read.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

struct FileState
{
  Catalogue::Stamp stamp;
  std::string modified; ///< UTC, ISO 8601
};
std::optional<FileState> stateOf(const std::filesystem::path& path);

CaseSummary summaryOf(const scene::Case& value, const std::string& modified);

/// A journal without its case must not be taken for that of a new case of this name. Throws
/// LibraryError, Conflict where another process still writes it.
void setOrphanAside(const std::filesystem::path& library, const std::string& name);

} // namespace petrous::library
