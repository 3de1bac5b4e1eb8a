#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Library/LibraryError.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

struct CaseSummary
{
  std::string name;
  std::string modified; ///< UTC, ISO 8601
  core::Index3 dims{0, 0, 0};
  std::size_t structures = 0;
  std::size_t strokes = 0; ///< that are done
  double removed = 0.0;    ///< mm^3
  bool damaged = false;    ///< the manifest cannot be read; the other fields are then empty
};

/// The cases on this machine: a folder with cases/NAME.json (the truth), objects/ (the voxels,
/// named by their hash) and library.sqlite (an index that can be made again).
///
/// A case on disk is always the old state or the new one: objects first, then the manifest by
/// temporary file, fsync and rename. Several programs may use one library: a save is refused where
/// the case was changed since it was opened.
class Library
{
public:
  /// The folder is made when something is first saved.
  explicit Library(std::filesystem::path folder);

  const std::filesystem::path& folder() const noexcept { return m_folder; }

  /// Is told in words what the user should know of a case that was opened: one sentence.
  void onNotice(std::function<void(const std::string&)> notice) { m_notice = std::move(notice); }

  std::vector<CaseSummary> list() const; ///< by name
  bool contains(const std::string& name) const;

  /// The case without its voxels: they are read where a part is asked for. What a session drilled
  /// that ended without saving (see Journal) is brought back and saved first.
  /// Throws LibraryError (NotFound, Damaged) and ManifestError.
  scene::Case open(const std::string& name) const;

  /// Reads the strokes into `value.dissection` where that is not done yet.
  void loadDissection(scene::Case& value) const;

  /// Writes what is new and the manifest. A case with revision 0 is new: its name must be free.
  /// On any exception the library and the case are as before.
  /// Throws LibraryError, CancelledError.
  void save(scene::Case& value, const core::Progress& progress = {});

private:
  std::filesystem::path manifestPath(const std::string& name) const;
  std::filesystem::path objectFolder() const;
  void attach(scene::Case& value) const;

  std::filesystem::path m_folder;
  std::function<void(const std::string&)> m_notice;
};

} // namespace petrous::library
