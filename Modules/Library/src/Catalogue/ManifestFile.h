#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Catalogue.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

// Files of the folder cases/.

/// Reads a manifest, without voxels; the case is named `name`, whatever the manifest says. Throws
/// LibraryError and ManifestError.
scene::Case manifestIn(const std::filesystem::path& path, const std::string& name);
/// The same; `isUnchanged`: hasItsChecksum.
scene::Case manifestIn(const std::filesystem::path& path, const std::string& name,
                       bool& isUnchanged);

/// The text of scene::toManifest as the library keeps it: with the member "sha256", the SHA-256 of
/// that text.
std::string withChecksum(std::string manifest);

/// False of a manifest, sound JSON, that a program other than Petrous or a fault of the medium has
/// changed since it was written; where only its layout was, true. True of those of older programs,
/// which have no checksum.
bool hasItsChecksum(std::string_view manifest);

/// The ID of the case; empty if the manifest cannot be read.
std::string idIn(const std::filesystem::path& manifest, const std::string& name);

/// What the user is told of a manifest that has not its checksum.
std::string changedText(const std::filesystem::path& path, const std::string& name);

/// The description in a manifest. Throws LibraryError and ManifestError.
Description descriptionIn(const std::filesystem::path& path);

/// An object that a case refers to.
struct ObjectUse
{
  enum class Kind
  {
    Image,
    Structures,
    Mesh,
    Instrument,
    Stroke,
    Attachment
  };
  std::string object;
  Kind kind;
  std::string name;          ///< of the part; of a stroke, its number
  std::string what;          ///< for messages
  bool isInstrument = false; ///< of a mesh: it is the instrument, too
};

/// "mesh 'cochlea' of case 'ear'"; `ofCase`: its name.
ObjectText textOf(const ObjectUse& use, const std::string& ofCase);

/// Whether an archive of a plan has it: what was made, not what was imported.
inline bool isOfPlan(const ObjectUse& use) noexcept
{
  return use.kind == ObjectUse::Kind::Instrument || use.isInstrument ||
         use.kind == ObjectUse::Kind::Stroke || use.kind == ObjectUse::Kind::Attachment;
}

/// The objects of a case in the order CT, MRs, structures, meshes, instrument, strokes,
/// attachments; each once.
std::vector<ObjectUse> objectsOf(const scene::Case& value);

/// The images that by the manifest lie elsewhere than by their object, of which the header alone is
/// read. Objects that are missing or cannot be read are left out.
std::vector<ObjectUse> misplacedImages(const scene::Case& value, const ObjectStore& store);
/// What the user is told of one.
std::string misplacedText(const std::filesystem::path& path, const std::string& name,
                          const ObjectUse& image);

/// Names of all cases, sorted, including damaged ones. Empty if the folder does not exist; throws
/// LibraryError (Damaged) if it cannot be read.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

/// The names of the cases of this ID, sorted: several only where files were copied by hand. None of
/// an empty ID. Reads the manifests that changed since the index knew them. Throws like namesIn.
std::vector<std::string> namesOf(const std::filesystem::path& folder, const std::string& id);

/// A deleted case: its files stay in the folder, with ".deleted-NUMBER" after their names (instead
/// of the manifest's ".json").
struct DeletedFile
{
  std::string name;         ///< of the case
  std::uint64_t number = 0; ///< ascending in the order of deletion
  std::filesystem::path manifest;
};

/// The manifests of deleted cases in the folder, the newest first. Throws like namesIn.
std::vector<DeletedFile> deletedIn(const std::filesystem::path& folder);

/// The journals of deleted cases in the folder. Throws like namesIn.
std::vector<std::filesystem::path> deletedJournalsIn(const std::filesystem::path& folder);

/// That no file of a deleted case has, whether its manifest is there or not.
std::uint64_t unusedDeletionNumber(const std::filesystem::path& folder);

/// What the names of files of a deleted case end in.
constexpr const char* kDeletedEnding = ".deleted-";
std::string deletedEnding(std::uint64_t number);

struct FileState
{
  Catalogue::Stamp stamp;
  std::string modified; ///< UTC, ISO 8601
  std::string renamed;  ///< the same, of the last change of the file's name, content or rights
};
std::optional<FileState> stateOf(const std::filesystem::path& path);

Catalogue::Entry entryOf(const scene::Case& value, const FileState& state);

/// Whether beside the journal lies a manifest of its own name with that ID.
bool isOfNamesake(const std::filesystem::path& journal, const std::string& id);

/// The journal of a case: the one with its ID, whatever its name, or the one with its name, unless
/// that is of another case that is here or deleted. Empty if there is none. `id` may be empty.
std::filesystem::path journalOf(const std::filesystem::path& library, const std::string& name,
                                const std::string& id);

/// Where the journal of a case is made that was opened under this name: under the name that it has
/// now, or under its ID if another case has its name. Throws LibraryError, and InvalidParameter if
/// that ID cannot be a name.
std::filesystem::path newJournalPath(const std::filesystem::path& library, const std::string& name,
                                     const std::string& id);

/// Clears the name of a new case of a journal that is of another case: if that one is here or
/// deleted, the journal gets its ID as name, where journalOf finds it; else it is set aside. Throws
/// LibraryError, Conflict if another process is still writing it.
void setOrphanAside(const std::filesystem::path& library, const std::string& name);

} // namespace petrous::library
