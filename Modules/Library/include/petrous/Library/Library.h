#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
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

class ObjectChecks;
struct SavedState;

/// What Library::verify found.
struct Inspection
{
  struct Damage
  {
    std::string object;             ///< its name, or the manifest's path below the library
    std::vector<std::string> cases; ///< that use it
    std::string text;
  };
  std::size_t cases = 0;
  std::size_t objects = 0;
  std::vector<Damage> damaged;
};

/// What Library::collectGarbage removed.
struct Collected
{
  std::size_t objects = 0;
  std::uintmax_t bytes = 0;
};

/// The cases on this machine: a folder with cases/NAME.json (the truth), objects/ (the voxels,
/// named by their hash) and library.sqlite (an index that can be made again). A case goes by the
/// name of its file.
///
/// What is read of an object is held against its hash first. Images are mapped and not read, so
/// that is done in another thread: `checkVoxels` waits for it.
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
  /// Those whose name, or a part's name, contains the text; ASCII letters in either case.
  std::vector<CaseSummary> search(const std::string& text) const;
  bool contains(const std::string& name) const; ///< also one that is damaged

  /// The case without its voxels: they are read where a part is asked for. What a session drilled
  /// that ended without saving (see Journal) is brought back and saved first.
  /// Throws LibraryError (NotFound, Damaged) and ManifestError.
  scene::Case open(const std::string& name) const;

  /// Reads the strokes into `value.dissection` where that is not done yet.
  void loadDissection(scene::Case& value) const;

  /// Where what follows from the library's objects is kept (DerivedCache.h).
  std::shared_ptr<core::DerivedStore> derived() const;

  /// Waits until the images of the case that were read from here have been held against their hash.
  /// Throws LibraryError (Damaged) naming those that are damaged, CancelledError.
  void checkVoxels(const scene::Case& value, const core::Progress& progress = {}) const;
  /// The same for all images that were read through this object or a copy of it, of whatever case.
  void checkAllRead(const core::Progress& progress = {}) const;
  /// Damage of the case's images that was found until now, one sentence each. Does not wait.
  std::vector<std::string> damageFound(const scene::Case& value) const;

  /// Writes what is new and the manifest. A case with revision 0 is new: its name must be free.
  /// On any exception the library and the case are as before.
  /// Throws LibraryError, CancelledError.
  void save(scene::Case& value, const core::Progress& progress = {});

  /// Saves what was drilled since `base`, the state that `value` was opened in. Where another
  /// program has saved the case since, the strokes are put on what it saved (see graft), and where
  /// that cannot be or the case is gone, they become a case of their own; `value` is that then.
  /// One sentence that says so, empty otherwise. Throws as `save`.
  std::string saveDrilled(scene::Case& value, const SavedState& base,
                          const core::Progress& progress = {});

  /// Throw LibraryError (Conflict) where another process is drilling in the case.
  void refuseWhereDrilled(const std::string& name) const;

  /// Also of a case that is damaged. What a session drilled and did not save is brought back first,
  /// and goes with a case that is removed. Throws LibraryError: NotFound, NameTaken, Conflict while
  /// another process is drilling in it, or for a rename where it could not be brought back.
  void rename(const std::string& from, const std::string& to);
  void remove(const std::string& name);
  /// Shares the objects. Throws as `open` and `save`.
  void copy(const std::string& from, const std::string& to, const core::Progress& progress = {});

  /// Reads everything there is. Throws LibraryError where the library cannot be read at all.
  Inspection verify(const core::Progress& progress = {}) const;

  /// Removes objects that no manifest names, and what killed writers left. Throws LibraryError
  /// (Damaged), and nothing is removed, where a manifest cannot be read: what it names is not
  /// known.
  Collected collectGarbage();

  /// Brings back what sessions drilled that ended without saving, clears what killed writers left,
  /// and makes the index again. What was done, one sentence each.
  std::vector<std::string> repair();

private:
  std::filesystem::path manifestPath(const std::string& name) const;
  std::filesystem::path objectFolder() const;
  std::filesystem::path checkedManifestPath(const std::string& name) const;
  scene::Case readManifest(const std::string& name) const;
  void attach(scene::Case& value) const;
  std::vector<std::pair<std::filesystem::path, std::string>>
  mappedImages(const scene::Case& value) const;
  std::optional<scene::Case> mergedWithSaved(const scene::Case& value,
                                             const SavedState& base) const;

  std::filesystem::path m_folder;
  std::function<void(const std::string&)> m_notice;
  std::shared_ptr<ObjectChecks> m_checks; ///< shared by copies and by the cases they opened
};

} // namespace petrous::library
