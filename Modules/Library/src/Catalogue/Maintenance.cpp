#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include <unistd.h>

#include "Catalogue.h"
#include "JournalFile.h"
#include "LibraryFolder.h"
#include "LibraryState.h"
#include "ManifestFile.h"
#include "Salt.h"
#include "Thumbnail.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/Library.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/OpenMark.h"
#include "petrous/Library/OwnerLock.h"
#include "petrous/Scene/Manifest.h"

// Operations on the whole library, and on cases as files.
namespace petrous::library
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;

namespace
{

// That one is named as setAside does; a case may be named so, too.
bool isAsideOf(const std::string& journal, const std::string& file)
{
  const std::string start = journal + ".aside-";
  return file.size() > start.size() && file.rfind(start, 0) == 0 &&
         file.find_first_not_of("0123456789", start.size()) == file.npos;
}

// The journals of a case, by its name and its ID, including those set aside. `ending`: of a deleted
// case's (deletedEnding).
std::vector<fs::path> journalsOf(const fs::path& library, const std::string& name,
                                 const std::string& id, const std::string& ending = {})
{
  const fs::path journal = journalPath(library, name);
  std::vector<fs::path> journals;
  std::error_code error;
  for (fs::directory_iterator entry(journal.parent_path(), error), end; !error && entry != end;
       entry.increment(error))
  {
    std::string file = entry->path().filename().string();
    const std::string last = entry->path().extension().string();
    if (ending.empty() ? last.rfind(kDeletedEnding, 0) == 0 : last != ending)
      continue;
    file.resize(file.size() - ending.size());
    const std::string own = journal.filename().string();
    if (file == own || file == own + ".new" || isAsideOf(own, file)
            ? !isOfOtherCase(entry->path(), id)
            : !id.empty() && fs::path(file).extension() == ".journal" &&
                  caseIdIn(entry->path()) == id &&
                  !isOfNamesake(entry->path().parent_path() / file, id))
      journals.push_back(entry->path());
  }
  return journals;
}

// The recordings that the window named after a case, "CASE 2026-03-01 09-30-00.ticks", each with
// its name from the date on.
std::vector<std::pair<fs::path, std::string>> recordingsOf(const fs::path& library,
                                                           const std::string& name)
{
  constexpr std::string_view kDate = "0000-00-00 00-00-00";
  std::vector<std::pair<fs::path, std::string>> recordings;
  std::error_code error;
  for (fs::directory_iterator entry(library / "recordings", error), end; !error && entry != end;
       entry.increment(error))
  {
    const std::string file = entry->path().filename().string();
    if (file.rfind(name + " ", 0) != 0 || entry->path().extension() != ".ticks")
      continue;
    const std::string rest = file.substr(name.size() + 1);
    const bool isDated = rest.size() > kDate.size() &&
                         std::equal(kDate.begin(), kDate.end(), rest.begin(),
                                    [](char form, char c)
                                    { return form == '0' ? c >= '0' && c <= '9' : c == form; });
    if (isDated)
      recordings.emplace_back(entry->path(), rest);
  }
  return recordings;
}

// `to`: the case's new name; empty: none. They stay what they are; a failure leaves the old name.
bool renameRecordings(const fs::path& library, const std::string& from, const std::string& to)
{
  bool isDone = true;
  for (const auto& [file, rest] : recordingsOf(library, from))
    try
    {
      fs::path renamed = file.parent_path() / (to.empty() ? rest : to + " " + rest);
      std::error_code error;
      for (int n = 2; fs::exists(fs::symlink_status(renamed, error)); ++n)
        renamed.replace_filename((to.empty() ? "" : to + " ") + fs::path(rest).stem().string() +
                                 " (" + std::to_string(n) + ").ticks");
      isDone = moveFile(file, renamed) && isDone;
    }
    catch (const LibraryError&)
    {
      isDone = false;
    }
  return isDone;
}

void removeFile(const fs::path& path)
{
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    throwForErrno(errno, path);
}

} // namespace

namespace
{

bool isDrilled(const fs::path& library, const std::string& name, const std::string& id)
{
  std::error_code error;
  const fs::path path = journalOf(library, name, id);
  if (!fs::is_regular_file(path, error))
    return false;
  const JournalFile journal(path);
  return journal.there() && !journal.held();
}

void refuseDrilled(const fs::path& library, const std::string& name, const std::string& id)
{
  if (isDrilled(library, name, id))
    throw LibraryError(Reason::Conflict,
                       "case '" + name + "' is being drilled by another process; end that first");
}

} // namespace

std::vector<std::string> Library::unrecovered() const
{
  constexpr std::string_view kEnding = ".journal";
  std::vector<std::pair<fs::file_time_type, std::string>> found;
  std::error_code error;
  for (fs::directory_iterator entry(m_folder / "cases", error), end; !error && entry != end;
       entry.increment(error))
  {
    const std::string file = entry->path().filename().string();
    if (entry->path().extension() != kEnding)
      continue;
    std::string name = file.substr(0, file.size() - kEnding.size());
    const std::string id = caseIdIn(entry->path());
    if (!id.empty() && idIn(manifestPath(name), name) != id)
    {
      const std::vector<std::string> renamed = namesOf(m_folder / "cases", id);
      if (renamed.empty())
        continue;
      name = renamed.front();
    }
    std::error_code unknown;
    const auto written = fs::last_write_time(entry->path(), unknown);
    if (!unknown && fs::exists(manifestPath(name), unknown) && !isDrilled(m_folder, name, id))
      found.emplace_back(written, name);
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::string> names;
  for (auto& [written, name] : found)
    names.push_back(std::move(name));
  return names;
}

void Library::refuseWhereDrilled(const std::string& name) const
{
  refuseDrilled(m_folder, name, idIn(manifestPath(name), name));
}

namespace
{

// Older programs' journals belong to the case of their name; under another name they would never be
// recovered.
void refuseWhereUnrecovered(const fs::path& library, const std::string& name, const std::string& id)
{
  const fs::path journal = journalOf(library, name, id);
  if (!journal.empty())
    throw LibraryError(Reason::Conflict,
                       "case '" + name + "': " + core::printable(journal) +
                           " holds what a session drilled and did not save; open the case first, "
                           "which brings it back or says why it cannot, then rename it");
}

} // namespace

namespace
{

// Renames the case in its manifest, unless that cannot be read; false if the disk did not confirm
// it.
bool writeName(const fs::path& manifest, const std::string& from, const std::string& to)
{
  scene::Case value;
  try
  {
    value = manifestIn(manifest, from);
  }
  catch (const core::Error&)
  {
    return true;
  }
  value.name = to;
  try
  {
    core::OutputFile file(manifest);
    file.write(withChecksum(scene::toManifest(value)));
    return file.commit();
  }
  catch (const core::OutputFileError& error)
  {
    throw libraryError(error, "case '" + from + "' is as it was");
  }
}

} // namespace

void Library::rename(const std::string& from, const std::string& to)
{
  scene::checkCaseName(from);
  scene::checkCaseName(to);
  const fs::path path = checkedManifestPath(from);
  refuseWhereDrilled(from);
  const bool damaged = [&]
  {
    try
    {
      open(from); // recovers unsaved drilling
      return false;
    }
    catch (const core::Error&)
    {
      return true;
    }
  }();
  const core::FileLock lock = lockForWriting();
  refuseWhereDrilled(from);
  checkedManifestPath(from);
  const std::string id = idIn(path, from);
  refuseWhereUnrecovered(m_folder, from, id);
  refuseTakenName(m_folder, to, from);
  setOrphanAside(m_folder, to);
  // What it is called stands in the manifest too, and a former name must not leave with it. Where a
  // case stands in the folder is its name whatever its manifest says: killed here, it has its old
  // one.
  bool onDisk = writeName(path, from, to);
  // The manifest before the journals: a kill then leaves journals that are set aside when the old
  // name is used again, and never a journal beside the manifest of another case.
  onDisk = moveFile(path, manifestPath(to)) && onDisk;
  // The case is renamed: nothing throws from here on.
  const std::string old = journalPath(m_folder, from).string();
  for (const fs::path& journal : journalsOf(m_folder, from, id))
    try
    {
      // Of a program that began to drill just now: it has its case's ID, and goes on here.
      if (!id.empty() && journal.extension() == ".journal")
        continue;
      const fs::path renamed =
          journalPath(m_folder, to).string() + journal.string().substr(old.size());
      if (!fs::exists(fs::symlink_status(renamed)))
        onDisk = moveFile(journal, renamed) && onDisk;
    }
    catch (const std::exception&)
    {
      onDisk = false; // it stays beside no manifest, and is set aside when that name is used
    }
  onDisk = renameRecordings(m_folder, from, to) && onDisk;
  Catalogue index(m_folder / kIndex);
  index.remove(from);
  try
  {
    if (const auto state = stateOf(manifestPath(to)); state && !damaged)
      index.put(entryOf(readManifest(to), *state));
  }
  catch (const core::Error&)
  {
    // Without an entry the manifest is read, and says what is wrong.
  }
  if (!onDisk && m_notice)
    m_notice("case '" + to + "' is renamed, but the disk reported an error; check the disk");
  noticeOpenersOf(to, idIn(manifestPath(to), to), "what is changed there is saved under this name");
}

void Library::remove(const std::string& name)
{
  scene::checkCaseName(name);
  const fs::path path = checkedManifestPath(name);
  const core::FileLock lock = lockForWriting();
  refuseWhereDrilled(name);
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(path, error)))
    throw LibraryError(Reason::Damaged, core::printable(path) + ": is a folder; remove it by hand");
  const std::string id = idIn(path, name);
  const std::string ending = deletedEnding(unusedDeletionNumber(m_folder / "cases"));
  // The manifest first: a kill then leaves journals that are set aside when the name is used again,
  // or are still in place when the case is brought back.
  bool onDisk = moveFile(path, path.string() + ending);
  for (const fs::path& journal : journalsOf(m_folder, name, id))
    try
    {
      onDisk = moveFile(journal, journal.string() + ending) && onDisk;
    }
    catch (const LibraryError&)
    {
      onDisk = false;
    }
  Catalogue(m_folder / kIndex).remove(name);
  if (!onDisk && m_notice)
    m_notice("case '" + name + "' is deleted, but the disk reported an error; check the disk");
  if (!m_notice || !m_state->noticesOpeners)
    return;
  if (const std::string openersText = toString(openersOf(m_folder, id)); !openersText.empty())
    m_notice("case '" + name + "' is open in Petrous elsewhere (" + openersText +
             "), and deleted all the same; what is changed there cannot be saved unless the case "
             "is brought back");
}

std::vector<DeletedCase> Library::deleted() const
{
  std::vector<DeletedCase> cases;
  for (const DeletedFile& file : deletedIn(m_folder / "cases"))
    if (const auto state = stateOf(file.manifest))
      cases.push_back({file.name, state->renamed});
  return cases;
}

std::string Library::deletedName(const std::string& id, const std::string& name) const
{
  const fs::path folder = m_folder / "cases";
  const bool isThere = !name.empty() && idIn(manifestPath(name), name) == id;
  if (id.empty() || isThere || !namesOf(folder, id).empty())
    return {};
  for (const DeletedFile& file : deletedIn(folder))
    if (idIn(file.manifest, file.name) == id)
      return file.name;
  return {};
}

void Library::undelete(const std::string& name, const std::string& id)
{
  scene::checkCaseName(name);
  if (!fs::is_directory(m_folder / "cases"))
    throw LibraryError(Reason::NotFound, "no case '" + name + "' was deleted here");
  const core::FileLock lock = lockForWriting();
  const std::vector<DeletedFile> files = deletedIn(m_folder / "cases");
  const auto file =
      std::find_if(files.begin(), files.end(),
                   [&](const DeletedFile& one) {
                     return one.name == name && (id.empty() || idIn(one.manifest, one.name) == id);
                   });
  if (file == files.end())
  {
    std::string there;
    for (const DeletedFile& one : files)
      there += (there.empty() ? "; there are: " : ", ") + one.name;
    throw LibraryError(Reason::NotFound, "no deleted case '" + name + "' in " +
                                             core::printable(m_folder) + " can be brought back" +
                                             there);
  }
  if (const std::string taken = caseLike(m_folder, name); !taken.empty())
    throw LibraryError(Reason::NameTaken, "case '" + taken + "' is there already in " +
                                              m_folder.string() +
                                              "; rename that one, then bring the other back");
  const std::string ending = deletedEnding(file->number);
  try
  {
    manifestIn(file->manifest, name);
  }
  catch (const core::Error& error)
  {
    throw LibraryError(Reason::Damaged, std::string(error.what()) + "; deleted case '" + name +
                                            "' cannot be brought back as it is, and stays deleted");
  }
  const std::string ownId = idIn(file->manifest, name);
  refuseDrilled(m_folder, name, ownId);
  for (const fs::path& journal : journalsOf(m_folder, name, ownId, ending))
  {
    const std::string text = journal.string();
    fs::path back = text.substr(0, text.size() - ending.size());
    if (back == journalPath(m_folder, name))
      setOrphanAside(m_folder, name);
    if (fs::exists(fs::symlink_status(back)) && caseIdIn(journal) == ownId)
      back = newJournalPath(m_folder, ownId, ownId);
    if (!fs::exists(fs::symlink_status(back)))
      moveFile(journal, back);
  }
  const bool onDisk = moveFile(file->manifest, manifestPath(name));
  try
  {
    if (const auto state = stateOf(manifestPath(name)))
      Catalogue(m_folder / kIndex).put(entryOf(readManifest(name), *state));
  }
  catch (const core::Error&)
  {
    // Without an entry the manifest is read, and says what is wrong.
  }
  if (!onDisk && m_notice)
    m_notice("case '" + name + "' is back, but the disk reported an error; check the disk");
}

void Library::copy(const std::string& from, const std::string& to, const core::Progress& progress)
{
  constexpr int kAttempts = 20; // another program keeps saving
  scene::checkCaseName(to);
  std::vector<std::uint8_t> png;
  bool isCurrent = false;
  for (int attempt = 1; !isCurrent; ++attempt)
  {
    scene::Case value = open(from);
    const std::uint64_t revision = value.revision;
    png = readThumbnail(m_folder, value.id);
    value.name = to;
    value.revision = 0;
    // A copy shares what the original keeps, and that may have been deleted and removed for good
    // while this waited for the library.
    const auto requireOriginal = [&](scene::Case& next, ObjectStore&)
    {
      isCurrent = contains(from);
      if (isCurrent)
      {
        const scene::Case now = readManifest(from);
        isCurrent = now.id == next.id && now.revision == revision;
      }
      if (!isCurrent)
        throw LibraryError(Reason::Conflict, "case '" + from +
                                                 "' was changed by another program while it was "
                                                 "copied; copy it again");
    };
    try
    {
      saveWith(value, requireOriginal, progress);
    }
    catch (const LibraryError& error)
    {
      if (error.reason != Reason::Conflict || isCurrent || attempt == kAttempts || contains(to))
        throw;
    }
  }
  if (png.empty())
    return;
  try
  {
    setThumbnail(to, png);
  }
  catch (const core::Error&)
  {
    // The copy is complete without.
  }
}

std::vector<std::string> Library::lost(const scene::Case& value) const
{
  const ObjectStore store(objectFolder());
  std::vector<std::string> all;
  for (const ObjectUse& use : objectsOf(value))
    try
    {
      if (use.kind != ObjectUse::Kind::Attachment)
        store.path(use.object, textOf(use, value.name));
    }
    catch (const LibraryError& error)
    {
      all.emplace_back(error.what());
    }
  for (const scene::Attachment& one : value.attachments)
    if (one.link.empty() && !attachmentProblem(*this, one).empty())
      all.push_back("attachment '" + one.name + "' of case '" + value.name +
                    "' is lost: attach the same file again, which puts it back, or take it out "
                    "('petrous attachments " +
                    value.name + " --remove')");
  return all;
}

namespace
{

// Of the manifests that need an object.
struct Use
{
  struct By
  {
    fs::path manifest;
    std::string name; // of the case
    bool isDeleted = false;
    ObjectText what; // the object is in it
  };
  std::vector<By> all;

  ObjectText text() const
  {
    if (all.empty())
      return {"of no case"};
    const By& by = all.front();
    return {by.what.words + " of " + (by.isDeleted ? "deleted " : "") + "case '" + by.name + "'",
            by.what.isInstrument};
  }
};

std::string needText(const Use& use)
{
  std::string text;
  for (const Use::By& by : use.all)
    text += (text.empty() ? "needed by: '" : ", '") + by.name + "'" +
            (by.isDeleted ? " (deleted)" : "");
  return use.all.size() > 1 ? "; " + text : std::string();
}

// Another program may have deleted the case, or saved it without the part, since its manifest was
// read, and what nobody needs may be gone.
bool isStillNeeded(const std::string& object, const Use::By& by)
{
  try
  {
    if (!stateOf(by.manifest))
      return false;
    const auto uses = objectsOf(manifestIn(by.manifest, by.name));
    return std::any_of(uses.begin(), uses.end(),
                       [&object](const ObjectUse& use) { return use.object == object; });
  }
  catch (const core::Error&)
  {
    return true;
  }
}

} // namespace

namespace
{

bool isSalted(const scene::Case& value)
{
  return scene::hasSaltedIdentity(value.ct) ||
         std::any_of(value.mr.begin(), value.mr.end(), scene::hasSaltedIdentity);
}

constexpr const char* kLostSaltText =
    "the salt with which its marks of patient and frame of reference were made is lost; restore it "
    "from a copy, or import the images again: until then nothing tells whether a new image is of "
    "the same patient, and names that may be the patient's are withheld where the case leaves";

} // namespace

namespace
{

// Of a manifest that was given by hand a name that no case can have; empty: of any other.
std::string misnamedText(const fs::path& manifest, const std::string& name)
{
  try
  {
    scene::checkCaseName(name);
    return {};
  }
  catch (const core::InvalidParameter& error)
  {
    return core::printable(manifest) + ": cannot be opened under the name of this file, and no " +
           "case can have it; rename the file (" + error.what() + ")";
  }
}

// Whether it is there and leads to no file: a link to nowhere, a folder. Not one that may not be
// looked at, nor one that was removed meanwhile.
bool isNoFile(const fs::path& manifest)
{
  std::error_code error;
  if (!fs::exists(fs::symlink_status(manifest, error)))
    return false;
  const fs::file_type type = fs::status(manifest, error).type();
  return type == fs::file_type::not_found || type == fs::file_type::directory;
}

} // namespace

Inspection Library::verify(const core::Progress& progress) const
{
  Inspection result;
  std::map<std::string, Use> uses;
  std::vector<std::pair<std::string, std::string>> ids; // of cases, with their names
  std::vector<std::pair<std::string, scene::Attachment>> links;
  std::vector<Use::By> salted, ofLostSalt;
  std::optional<scene::IdentitySalt> salt; // none is drawn here
  if (hasSalt(m_folder))
    salt = frameSalter(*this);
  const auto damaged =
      [&result](const std::string& object, const std::vector<Use::By>& by, const std::string& text)
  {
    Inspection::Damage one;
    one.object = object;
    one.text = text;
    for (const Use::By& of : by)
      (of.isDeleted ? one.deletedCases : one.cases).push_back(of.name);
    result.damaged.push_back(std::move(one));
  };
  const auto unread =
      [&](const fs::path& path, const std::string& name, bool isDeleted, const core::Error& error)
  {
    if (stateOf(path)) // else deleted in the meantime
      damaged(path.lexically_relative(m_folder).string(), {Use::By{path, name, isDeleted, {}}},
              error.what() + (isDeleted ? "; deleted case '" + name + "' cannot be brought back"
                                        : std::string()));
  };
  struct Misplaced
  {
    std::string file;
    std::vector<Use::By> of;
    std::string object, text;
  };
  std::vector<Misplaced> misplaced;
  const ObjectStore store(objectFolder());
  const auto read = [&](const fs::path& path, const std::string& name, bool isDeleted)
  {
    try
    {
      bool isUnchanged = true;
      const scene::Case value = manifestIn(path, name, isUnchanged);
      const std::vector<Use::By> of{{path, name, isDeleted, {}}};
      const std::string file = path.lexically_relative(m_folder).string();
      if (!isUnchanged)
        damaged(file, of, changedText(path, name));
      for (const ObjectUse& image : misplacedImages(value, store))
        misplaced.push_back({file, of, image.object, misplacedText(path, name, image)});
      if (!isDeleted)
        ids.emplace_back(value.id, name);
      if (isSalted(value))
        salted.push_back({path, name, isDeleted, {}});
      if (salt && hasLostSalt(value, *salt))
        ofLostSalt.push_back({path, name, isDeleted, {}});
      for (const scene::Attachment& one : value.attachments)
        if (!isDeleted && !one.link.empty())
          links.emplace_back(name, one);
      for (const ObjectUse& use : objectsOf(value))
        uses[use.object].all.push_back(
            {path, name, isDeleted, {use.what, use.kind == ObjectUse::Kind::Instrument}});
    }
    catch (const scene::ManifestError& error)
    {
      if (error.reason != scene::ManifestError::Reason::NewerFormat) // casesOfNewerVersion
        unread(path, name, isDeleted, error);
    }
    catch (const core::Error& error)
    {
      unread(path, name, isDeleted, error);
    }
  };
  for (const std::string& name : namesIn(m_folder / "cases"))
  {
    ++result.cases;
    const fs::path path = manifestPath(name);
    if (const std::string words = misnamedText(path, name); !words.empty())
      damaged(path.lexically_relative(m_folder).string(), {Use::By{path, name, false, {}}}, words);
    read(path, name, false);
  }
  for (const DeletedFile& file : deletedIn(m_folder / "cases"))
    read(file.manifest, file.name, true);
  for (const auto& [id, name] : ids)
  {
    const fs::path path = thumbnailPath(m_folder, id);
    std::error_code error;
    if (!path.empty() && fs::exists(fs::symlink_status(path, error)) &&
        readThumbnail(m_folder, id).empty())
      damaged(path.lexically_relative(m_folder).string(), {Use::By{{}, name, false, {}}},
              core::printable(path) + ": the thumbnail of case '" + name +
                  "' is damaged; make it anew: petrous describe '" + name + "' --thumbnail");
  }
  if (!ofLostSalt.empty())
    damaged("salt", ofLostSalt, core::printable(m_folder / "salt") + ": " + kLostSaltText);
  if (!salted.empty() && !salt)
    damaged("salt", salted,
            core::printable(m_folder / "salt") +
                ": is missing, or not what this program wrote; restore it from a copy: without it "
                "nothing tells whether a new image is of the patient of an older one");
  std::set<std::string> unsound;
  std::map<std::string, std::uintmax_t> sizes;
  std::uintmax_t total = 1;
  for (const auto& [object, bytes] : store.list())
  {
    uses[object]; // unreferenced objects are verified too
    sizes[object] = bytes;
    total += bytes;
  }
  result.objects = sizes.size();
  std::uintmax_t done = 0;
  for (auto& [object, use] : uses)
  {
    const double from = static_cast<double>(done) / static_cast<double>(total);
    done += sizes.count(object) > 0 ? sizes[object] : 0;
    try
    {
      checkObject(store.path(object, use.text()), use.text(),
                  progress.part(from, static_cast<double>(done) / static_cast<double>(total)));
    }
    catch (const LibraryError& error)
    {
      if (!store.contains(object))
      {
        auto& all = use.all;
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [&object = object](const Use::By& by)
                                 { return !isStillNeeded(object, by); }),
                  all.end());
        if (all.empty())
          continue;
      }
      damaged(object, use.all, error.what() + needText(use));
      unsound.insert(object);
    }
  }
  for (const Misplaced& one : misplaced)
    if (unsound.count(one.object) == 0) // else it is the object's header that is wrong
      damaged(one.file, one.of, one.text);
  // That a linked file is not there is no damage: its disk may be elsewhere.
  for (const auto& [name, one] : links)
    if (attachmentChange(*this, one, progress.part(1.0, 1.0)) == "changed")
      damaged(one.link, {Use::By{{}, name, false, {}}},
              core::printable(one.link) + ": attachment '" + one.name + "' of case '" + name +
                  "': the linked file is another one than was attached; put the former one back, "
                  "or remove the attachment and attach this one");
  return result;
}

Collected Library::collectGarbage(const core::Progress& progress)
{
  Collected result;
  if (namesIn(m_folder / "cases").empty() && deletedIn(m_folder / "cases").empty() &&
      deletedJournalsIn(m_folder / "cases").empty() && ObjectStore(objectFolder()).list().empty())
    return result;
  const core::FileLock lock = lockForWriting(progress);
  if (const std::vector<Opener> openers = openersOfAny(m_folder); !openers.empty())
    throw LibraryError(Reason::Conflict,
                       "a case of the library is open in Petrous elsewhere (" + toString(openers) +
                           "), where what was removed can still be put back; nothing was cleaned "
                           "up: close it there first. Where no such program runs any more, remove "
                           "what is in the library's folder 'open'");
  std::set<std::string> used;
  std::set<std::string> ids;
  const std::vector<std::string> names = namesIn(m_folder / "cases");
  std::size_t read = 0;
  for (const std::string& name : names)
    try
    {
      progress.report(0.5 * static_cast<double>(read++) / static_cast<double>(names.size()),
                      "reading cases");
      const scene::Case value = readManifest(name);
      ids.insert(value.id);
      for (const ObjectUse& use : objectsOf(value))
        used.insert(use.object);
    }
    catch (const core::CancelledError&)
    {
      throw;
    }
    catch (const scene::ManifestError& error)
    {
      const bool isNewer = error.reason == scene::ManifestError::Reason::NewerFormat;
      throw LibraryError(Reason::Damaged,
                         std::string(error.what()) + "; what case '" + name +
                             "' needs is not known, so nothing was removed: " +
                             (isNewer ? "clean up with that version"
                                      : "delete the case first, or restore its manifest"));
    }
    catch (const core::Error& error)
    {
      throw LibraryError(Reason::Damaged,
                         std::string(error.what()) + "; what case '" + name +
                             "' needs is not known, so nothing was removed: delete the case first, "
                             "or restore its manifest");
    }
  // What was removed when it is cancelled stays removed, and the next run goes on.
  progress.check("removing deleted cases");
  for (const DeletedFile& file : deletedIn(m_folder / "cases"))
  {
    // Journals first: what was drilled in a case that is gone would be found by nothing.
    const std::string id = idIn(file.manifest, file.name);
    for (const fs::path& journal : journalsOf(m_folder, file.name, id, deletedEnding(file.number)))
      removeFile(journal);
    // Of a deletion that was killed, or drilled after it. Without an ID they are those of another
    // case of that name, if there is one.
    if (!isDrilled(m_folder, file.name, id))
      for (const fs::path& journal : journalsOf(m_folder, file.name, id))
        if (const std::string of = caseIdIn(journal);
            of.empty() ? !contains(file.name) : ids.count(of) == 0)
          removeFile(journal);
    if (!contains(file.name)) // they may be of that one
      renameRecordings(m_folder, file.name, {});
    removeFile(file.manifest);
    ++result.cases;
  }
  for (const fs::path& journal : deletedJournalsIn(m_folder / "cases"))
    removeFile(journal);
  core::syncFolder(m_folder / "cases");
  removeLeftovers(objectFolder());
  removeLeftovers(m_folder / "cases");
  removeAbandoned(m_folder, &core::isLeftover); // its other files have locks of their own
  ObjectStore store(objectFolder());
  const auto objects = store.list();
  std::size_t looked = 0;
  for (const auto& [object, bytes] : objects)
    if (progress.report(0.5 + 0.5 * static_cast<double>(looked++) /
                                  static_cast<double>(objects.size()),
                        "removing what no case needs");
        used.count(object) == 0)
    {
      store.remove(object);
      ++result.objects;
      result.bytes += bytes;
    }
  core::syncFolder(objectFolder());
  removeStaleMarks(m_folder);
  removeLeftovers(m_folder / kThumbnailFolder);
  for (const std::string& id : thumbnailIds(m_folder))
    if (ids.count(id) == 0)
      removeFile(thumbnailPath(m_folder, id));
  return result;
}

Repaired Library::repair(const core::Progress& progress, bool acceptChanged)
{
  Repaired result;
  std::vector<std::string>& done = result.done;
  Library quiet = *this;
  quiet.onNotice([&done](const std::string& words) { done.push_back(words); });
  const std::vector<std::string> names = namesIn(m_folder / "cases");
  std::vector<Catalogue::Entry> entries; // made before the library is locked: others may save
  const scene::IdentitySalt salt = frameSalter(*this);
  std::size_t read = 0;
  ObjectStore(objectFolder()).list(); // throws where nothing is lost, but cannot be read
  for (const std::string& name : names)
    try
    {
      if (std::string words = misnamedText(manifestPath(name), name); !words.empty())
      {
        done.push_back(std::move(words));
        continue;
      }
      progress.report(static_cast<double>(read++) / static_cast<double>(names.size()), "repairing");
      bool isUnchanged = true;
      scene::Case value = quiet.open(name);
      manifestIn(manifestPath(name), name, isUnchanged);
      if (acceptChanged && !isUnchanged)
      {
        quiet.save(value);
        done.push_back("case '" + name + "' is saved anew as its file says");
      }
      for (std::string& words : lost(value))
        result.lost.push_back(std::move(words));
      if (isSalted(value) && (!hasSalt(m_folder) || hasLostSalt(value, salt)))
        result.lost.push_back("case '" + name + "': " + kLostSaltText);
      if (const auto state = stateOf(manifestPath(name)))
        entries.push_back(entryOf(readManifest(name), *state));
    }
    catch (const core::CancelledError&)
    {
      throw;
    }
    catch (const scene::ManifestError& error)
    {
      (error.reason == scene::ManifestError::Reason::Damaged ? result.lost : done)
          .emplace_back(error.what());
    }
    catch (const core::Error& error)
    {
      (isNoFile(manifestPath(name)) ? result.lost : done).emplace_back(error.what());
    }
  if (names.empty())
    return result;
  const core::FileLock lock = lockForWriting(progress);
  removeLeftovers(objectFolder());
  removeLeftovers(m_folder / "cases");
  removeAbandoned(m_folder, &core::isLeftover); // its other files have locks of their own
  for (const char* ending : {"", "-journal", "-wal", "-shm"})
    removeFile((m_folder / kIndex).string() + ending);
  Catalogue index(m_folder / kIndex);
  index.put(entries);
  done.push_back("the index holds " + std::to_string(index.entries().size()) + " of " +
                 std::to_string(names.size()) + " cases");
  return result;
}

} // namespace petrous::library
