#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/FileLock.h"
#include "petrous/Core/Progress.h"
#include "petrous/Library/LibraryError.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

using scene::Description;

struct CaseSummary
{
  std::string name;
  std::string id;       ///< Case::id
  std::string modified; ///< UTC, ISO 8601
  core::Index3 dims{0, 0, 0};
  std::size_t structures = 0;
  std::size_t strokes = 0; ///< applied strokes
  double removed = 0.0;    ///< mm^3
  bool damaged = false;    ///< the manifest cannot be read; the other fields are then empty
  Description description; ///< without its note
  bool hasNote = false;
  bool hasThumbnail = false;
};

/// What Library::search looks for: cases to which everything applies that is not empty. All text is
/// case-insensitive.
struct CaseFilter
{
  std::string text; ///< each word: in the name, the name of a part, a tag, diagnosis or procedure
  bool inNotes = false;          ///< also in the note; slower, since the manifests are read
  std::vector<std::string> tags; ///< each a tag of the case
  std::string diagnosis;         ///< each word in it
  std::string procedure;         ///< each word in it
  std::optional<scene::Side> side;
  std::string from, to; ///< of the planned date, both included: "2026-03-31"
};

struct LibraryState;
class ObjectStore;
struct SavedState;

/// Result of Library::verify.
struct Inspection
{
  struct Damage
  {
    std::string object;             ///< its name, or the manifest's path relative to the library
    std::vector<std::string> cases; ///< cases that use it
    std::vector<std::string> deletedCases; ///< that use it and could be brought back
    std::string text;
  };
  std::size_t cases = 0;
  std::size_t objects = 0;
  std::vector<Damage> damaged;
};

constexpr int kThumbnailWidth = 256;  ///< pixels
constexpr int kThumbnailHeight = 192; ///< pixels

/// Whether this is a thumbnail: a PNG of that size, RGB of 8 bits, not interlaced, sound to its
/// last bit, which holds the picture and nothing else.
bool isThumbnail(const std::vector<std::uint8_t>& png) noexcept;

/// A case that was deleted and can be brought back.
struct DeletedCase
{
  std::string name;
  std::string deleted; ///< when; UTC, ISO 8601
};

/// What Library::repair did, a sentence each.
struct Repaired
{
  std::vector<std::string> done;
  std::vector<std::string>
      lost; ///< what cases need and cannot be brought back: Library::lost, manifests
};

/// What Library::collectGarbage removed.
struct Collected
{
  std::size_t cases = 0; ///< deleted ones, which could have been brought back
  std::size_t objects = 0;
  std::uintmax_t bytes = 0;
};

/// The local case library: a folder with cases/NAME.json (the source of truth), objects/ (the
/// voxels, named by their hash) and library.sqlite (an index that can be rebuilt). A case has the
/// name of its file.
///
/// Objects are verified against their hash before use. Images are memory-mapped instead of read, so
/// they are verified on a background thread; `checkVoxels` waits for it.
///
/// Saving is atomic: objects first, then the manifest by temporary file, fsync and rename, so a
/// case on disk is always in the old or the new state. Several programs may use one library: a save
/// is refused if the case was changed since it was opened. Which case it is tells Case::id: one
/// that was only renamed since is saved under its new name, also if another case has the old one.
class Library
{
public:
  /// The folder is created by the first save.
  explicit Library(std::filesystem::path folder);

  const std::filesystem::path& folder() const noexcept { return m_folder; }

  /// Called with one sentence that the user should know about a case that was opened.
  void onNotice(std::function<void(const std::string&)> notice) { m_notice = std::move(notice); }

  /// After a case was saved, renamed or removed, tells by the notice who has it open (OpenMark):
  /// what is changed there is then refused. Of all copies.
  void noticeOpeners();

  /// Called ten times a second while another program has the library's lock, with the time waited,
  /// s; what it throws ends the wait and what was to be done. Of all copies.
  void onWait(std::function<void(double)> waiting);

  std::vector<CaseSummary> list() const; ///< sorted by name
  /// Sorted by name. Throws InvalidParameter if `from` or `to` is no date, or `from` the later one.
  std::vector<CaseSummary> search(const CaseFilter& filter) const;
  /// The same; adds the tags of all cases to `tags`, of one listing.
  std::vector<CaseSummary> search(const CaseFilter& filter, std::set<std::string>& tags) const;
  std::vector<CaseSummary> search(const std::string& text) const; ///< CaseFilter::text
  bool contains(const std::string& name) const;                   ///< including damaged ones

  /// Opens a case without its voxels: they are read when a part is accessed. Drilling that was not
  /// saved because a program was killed (see Journal) is recovered and saved first. A manifest that
  /// does not have the checksum that it states, or places an image elsewhere than its voxels say,
  /// is opened as it is, and told by the notice. Throws LibraryError (NotFound, Damaged) and
  /// ManifestError.
  scene::Case open(const std::string& name) const;

  /// Loads `value.dissection` unless already loaded (Dissection::load). Throws LibraryError
  /// (Damaged, NotFound) naming the applied stroke that cannot be read, and how to go on without.
  void loadDissection(scene::Case& value) const;

  /// The same for a case that opens with what is sound of it: undoes the first applied stroke that
  /// cannot be read, and those after it. Reads all strokes, also those not applied; returns the
  /// damage, one sentence a stroke.
  std::vector<std::string> loadSoundDissection(scene::Case& value) const;

  /// Cache of data derived from the library's objects (DerivedCache.h).
  std::shared_ptr<core::DerivedStore> derived() const;

  /// Verifies the objects of all structures and meshes against their hash: also of those that need
  /// not be read, because they are hidden, stand behind another of their name, or because derived
  /// data suffice. Throws StructureError naming the first that is missing or damaged, and how many
  /// more are; CancelledError.
  void checkStructures(const scene::Case& value, const core::Progress& progress = {}) const;

  /// Waits until the images of the case that were read from here are verified against their hash.
  /// Throws LibraryError (Damaged) listing the damaged ones, CancelledError.
  void checkVoxels(const scene::Case& value, const core::Progress& progress = {}) const;
  /// The same for all images, of any case, that were read through this object or a copy of it.
  void checkAllRead(const core::Progress& progress = {}) const;
  /// For a case whose CT cannot be read, and that is to be opened with what is left of it: puts the
  /// CT's least intensity in the place of its voxels. `save` keeps the reference to the lost ones;
  /// checkVoxels refuses them, and damageFound has them. Returns false, and changes nothing, if the
  /// file is sound.
  bool standInForCt(scene::Case& value, const core::Progress& progress = {}) const;
  bool isStandIn(const scene::ImagePart& image) const;
  /// Damage of the case's images found so far, one sentence each. Does not wait.
  std::vector<std::string> damageFound(const scene::Case& value) const;

  /// Writes new objects, those of parts in memory whose objects are gone, and the manifest;
  /// remembers Case::origins (isSource) and clears them. A case with revision 0 is new: its name
  /// must not be in use. One that was renamed gets its new name, told by the notice. On any
  /// exception the library and the case are unchanged. Throws
  /// LibraryError: NotFound naming what the case would refer to and is not there, unless it was
  /// damaged before: the case on disk, or of a new one any case, refers to it; CancelledError.
  void save(scene::Case& value, const core::Progress& progress = {});

  /// Saves what was drilled since `base`, the state in which `value` was opened. If another program
  /// has saved the case since, the strokes are merged into that (see graft); if that is impossible
  /// or the case is gone, they become a new case, and `value` becomes that case. Returns one
  /// sentence describing this, else an empty string. Throws like `save`.
  std::string saveDrilled(scene::Case& value, const SavedState& base,
                          const core::Progress& progress = {});

  /// The whole description of a saved case. Throws LibraryError (NotFound) and ManifestError.
  Description description(const std::string& name) const;
  /// Replaces it and saves the case, unless it is the same. While a program has the case open, that
  /// program's next save would be refused: there, change Case::description and save. Throws
  /// InvalidParameter, and like `open` and `save`.
  void describe(const std::string& name, const Description& description);

  /// A small picture of the case, kThumbnailWidth x kThumbnailHeight pixels, as PNG without
  /// metadata; empty if there is none, or a damaged one.
  std::vector<std::uint8_t> thumbnail(const CaseSummary& summary) const;
  /// The same. Throws LibraryError (NotFound) and ManifestError.
  std::vector<std::uint8_t> thumbnail(const std::string& name) const;
  /// Keeps a picture, beside the case's manifest, which stays as it is: also while a program has
  /// the case open. Throws InvalidParameter unless isThumbnail(png), LibraryError (NotFound,
  /// DiskFull, Unwritable) and ManifestError.
  void setThumbnail(const std::string& name, const std::vector<std::uint8_t>& png);

  /// Cases with drilling that a program which was killed did not save, and `open` brings back: the
  /// one drilled last first.
  std::vector<std::string> unrecovered() const;

  /// Throws LibraryError (Conflict) if another process is drilling in the case.
  void refuseWhereDrilled(const std::string& name) const;

  /// Both also accept a damaged case. `rename` recovers unsaved drilling first, and leaves the
  /// former name nowhere, recordings that were named after the case included; `remove` takes what
  /// is unsaved along. Throw LibraryError: NotFound; NameTaken; Conflict while another process is
  /// drilling in the case, or for a rename if recovery failed.
  void rename(const std::string& from, const std::string& to);
  void remove(const std::string& name);

  /// Until collectGarbage a deleted case stays in the library, with what was drilled and not saved.
  std::vector<DeletedCase> deleted() const; ///< newest first
  /// Brings back the case of this name that was deleted last. Throws LibraryError: NotFound,
  /// NameTaken, Damaged if its manifest cannot be read. `id`, if not empty: of the cases of this
  /// name that were deleted, the one of this ID.
  void undelete(const std::string& name, const std::string& id = {});
  /// The name under which the case of this ID was deleted and can be brought back; empty: it was
  /// not deleted, or is back under any name. `name`, if not empty: under which it is presumably
  /// there; that manifest is asked first.
  std::string deletedName(const std::string& id, const std::string& name = {}) const;

  /// The copy shares the objects. Throws like `open` and `save`.
  void copy(const std::string& from, const std::string& to, const core::Progress& progress = {});

  /// What the case needs and the library has not, a sentence each. A look at the folder alone: what
  /// is there may be damaged.
  std::vector<std::string> lost(const scene::Case& value) const;

  /// Reads and verifies everything, also what only deleted cases need that could be brought back.
  /// Throws LibraryError if the library cannot be read at all.
  Inspection verify(const core::Progress& progress = {}) const;

  /// Removes deleted cases, objects that no manifest references, and leftovers of killed writers;
  /// recordings that were named after such a case lose that name. Throws LibraryError without
  /// removing anything: Damaged if a manifest cannot be read, since its references are unknown;
  /// Conflict while another process has a case open, in which it can put back what was removed.
  Collected collectGarbage(const core::Progress& progress = {});

  /// Recovers unsaved drilling, removes leftovers of killed writers, and rebuilds the index.
  /// `acceptChanged`: saves cases anew whose manifests do not have the checksum that they state,
  /// which are otherwise only named.
  Repaired repair(const core::Progress& progress = {}, bool acceptChanged = false);

  /// Like `save`; `storeObjects` adds the objects of the case, whose names it completes, while the
  /// library is locked. What it added is removed again if anything throws.
  void saveWith(scene::Case& value,
                const std::function<void(scene::Case&, ObjectStore&)>& storeObjects,
                const core::Progress& progress = {});

private:
  std::filesystem::path manifestPath(const std::string& name) const;
  std::filesystem::path objectFolder() const;
  std::filesystem::path checkedManifestPath(const std::string& name) const;
  scene::Case readManifest(const std::string& name) const;
  void attach(scene::Case& value) const;
  void noticeDoubts(const scene::Case& value, bool isUnchanged) const;
  void noticeOpenersOf(const std::string& name, const std::string& id,
                       const std::string& advice) const;
  core::FileLock lockForWriting(const core::Progress& progress = {}) const;
  std::vector<std::pair<std::filesystem::path, std::string>>
  mappedImages(const scene::Case& value) const;
  std::optional<scene::Case> mergedWithSaved(const scene::Case& value,
                                             const SavedState& base) const;

  std::filesystem::path m_folder;
  std::function<void(const std::string&)> m_notice;
  std::shared_ptr<LibraryState> m_state; ///< shared by copies
};

} // namespace petrous::library
