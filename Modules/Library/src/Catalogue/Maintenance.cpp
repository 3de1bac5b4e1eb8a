#include <algorithm>
#include <map>
#include <set>

#include <unistd.h>

#include "Catalogue.h"
#include "JournalFile.h"
#include "LibraryFolder.h"
#include "ManifestFile.h"
#include "petrous/Library/Library.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Manifest.h"

// Operations on the whole library, and on cases as files.
namespace petrous::library
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;

namespace
{

constexpr const char* kIndex = "library.sqlite";

std::string lower(std::string text)
{
  for (char& c : text)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return text;
}

// The journals of a case, including those set aside.
std::vector<fs::path> journalsOf(const fs::path& library, const std::string& name)
{
  const fs::path journal = journalPath(library, name);
  std::vector<fs::path> journals;
  std::error_code error;
  for (fs::directory_iterator entry(journal.parent_path(), error), end; !error && entry != end;
       entry.increment(error))
  {
    const std::string file = entry->path().filename().string();
    const std::string own = journal.filename().string();
    if (file == own || file == own + ".new" || file.rfind(own + ".aside-", 0) == 0)
      journals.push_back(entry->path());
  }
  return journals;
}

void removeFile(const fs::path& path)
{
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    throwForErrno(errno, path);
}

} // namespace

void Library::refuseWhereDrilled(const std::string& name) const
{
  std::error_code error;
  const fs::path path = journalPath(m_folder, name);
  if (!fs::is_regular_file(path, error))
    return;
  const JournalFile journal(path);
  if (journal.there() && !journal.held())
    throw LibraryError(Reason::Conflict,
                       "case '" + name + "' is being drilled by another process; end that first");
}

namespace
{

// A journal belongs to the case of its name; under another name it would never be recovered.
void refuseWhereUnrecovered(const fs::path& library, const std::string& name)
{
  const fs::path journal = journalPath(library, name);
  std::error_code error;
  if (fs::exists(fs::symlink_status(journal, error)))
    throw LibraryError(Reason::Conflict,
                       "case '" + name + "': " + core::printable(journal) +
                           " holds what a session drilled and did not save; open the case first, "
                           "which brings it back or says why it cannot, then rename it");
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
  const FolderLock lock(m_folder / ".lock");
  refuseWhereDrilled(from);
  refuseWhereUnrecovered(m_folder, from);
  checkedManifestPath(from);
  if (contains(to))
    throw LibraryError(Reason::NameTaken, "case '" + to + "' is there already in " +
                                              m_folder.string() + "; choose another name");
  setOrphanAside(m_folder, to);
  // The manifest first: a kill then leaves journals that are set aside when the old name is used
  // again, and never a journal beside the manifest of another case.
  bool onDisk = moveFile(path, manifestPath(to));
  // The case is renamed: nothing throws from here on.
  const std::string old = journalPath(m_folder, from).string();
  for (const fs::path& journal : journalsOf(m_folder, from))
    try
    {
      const fs::path renamed =
          journalPath(m_folder, to).string() + journal.string().substr(old.size());
      if (!fs::exists(fs::symlink_status(renamed)))
        onDisk = moveFile(journal, renamed) && onDisk;
    }
    catch (const std::exception&)
    {
      onDisk = false; // it stays beside no manifest, and is set aside when that name is used
    }
  Catalogue index(m_folder / kIndex);
  index.remove(from);
  try
  {
    if (const auto state = stateOf(manifestPath(to)); state && !damaged)
      index.put(summaryOf(readManifest(to), state->modified), state->stamp);
  }
  catch (const core::Error&)
  {
    // Without an entry the manifest is read, and says what is wrong.
  }
  if (!onDisk && m_notice)
    m_notice("case '" + to + "' is renamed, but the disk reported an error; check the disk");
}

void Library::remove(const std::string& name)
{
  scene::checkCaseName(name);
  const fs::path path = checkedManifestPath(name);
  const FolderLock lock(m_folder / ".lock");
  refuseWhereDrilled(name);
  // The journals first: one left behind would be taken for that of the next case of this name.
  for (const fs::path& journal : journalsOf(m_folder, name))
    removeFile(journal);
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(path, error)))
    throw LibraryError(Reason::Damaged, core::printable(path) + ": is a folder; remove it by hand");
  removeFile(path);
  core::syncFolder(m_folder / "cases");
  Catalogue(m_folder / kIndex).remove(name);
}

void Library::copy(const std::string& from, const std::string& to, const core::Progress& progress)
{
  scene::checkCaseName(to);
  scene::Case value = open(from);
  value.name = to;
  value.revision = 0;
  save(value, progress);
}

std::vector<CaseSummary> Library::search(const std::string& text) const
{
  const std::string wanted = lower(text);
  const auto matches = [&wanted](const std::string& name)
  { return lower(name).find(wanted) != std::string::npos; };
  std::vector<CaseSummary> found;
  for (CaseSummary& summary : list())
  {
    bool hit = matches(summary.name);
    if (!hit && !summary.damaged)
    {
      const scene::Case value = readManifest(summary.name);
      for (const auto& mr : value.mr)
        hit = hit || matches(mr.name);
      for (const auto& part : value.labels)
        for (const auto& structure : part.structures)
          hit = hit || matches(structure.name);
      for (const auto& mesh : value.meshes)
        hit = hit || matches(mesh.name);
    }
    if (hit)
      found.push_back(std::move(summary));
  }
  return found;
}

Inspection Library::verify(const core::Progress& progress) const
{
  Inspection result;
  struct Use
  {
    std::vector<std::string> cases;
    std::string what;
  };
  std::map<std::string, Use> uses;
  for (const std::string& name : namesIn(m_folder / "cases"))
  {
    ++result.cases;
    try
    {
      for (const ObjectUse& use : objectsOf(readManifest(name)))
      {
        uses[use.object].cases.push_back(name);
        uses[use.object].what = use.what + " of case '" + name + "'";
      }
    }
    catch (const core::Error& error)
    {
      result.damaged.push_back({"cases/" + name + ".json", {name}, error.what()});
    }
  }
  const ObjectStore store(objectFolder());
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
  for (const auto& [object, use] : uses)
  {
    const double from = static_cast<double>(done) / static_cast<double>(total);
    done += sizes.count(object) > 0 ? sizes[object] : 0;
    try
    {
      checkObject(store.path(object), use.what.empty() ? "of no case" : use.what,
                  progress.part(from, static_cast<double>(done) / static_cast<double>(total)));
    }
    catch (const LibraryError& error)
    {
      result.damaged.push_back({object, use.cases, error.what()});
    }
  }
  return result;
}

Collected Library::collectGarbage()
{
  Collected result;
  if (namesIn(m_folder / "cases").empty() && ObjectStore(objectFolder()).list().empty())
    return result;
  const FolderLock lock(m_folder / ".lock");
  std::set<std::string> used;
  for (const std::string& name : namesIn(m_folder / "cases"))
    try
    {
      for (const ObjectUse& use : objectsOf(readManifest(name)))
        used.insert(use.object);
    }
    catch (const core::Error& error)
    {
      throw LibraryError(Reason::Damaged,
                         std::string(error.what()) + "; what case '" + name +
                             "' needs is not known, so nothing was removed: delete the case first, "
                             "or restore its manifest");
    }
  removeLeftovers(objectFolder());
  removeLeftovers(m_folder / "cases");
  ObjectStore store(objectFolder());
  for (const auto& [object, bytes] : store.list())
    if (used.count(object) == 0)
    {
      store.remove(object);
      ++result.objects;
      result.bytes += bytes;
    }
  core::syncFolder(objectFolder());
  return result;
}

std::vector<std::string> Library::repair()
{
  std::vector<std::string> done;
  Library quiet = *this;
  quiet.onNotice([&done](const std::string& words) { done.push_back(words); });
  const std::vector<std::string> names = namesIn(m_folder / "cases");
  for (const std::string& name : names)
    try
    {
      quiet.open(name);
    }
    catch (const core::Error& error)
    {
      done.push_back(error.what());
    }
  if (names.empty())
    return done;
  const FolderLock lock(m_folder / ".lock");
  removeLeftovers(objectFolder());
  removeLeftovers(m_folder / "cases");
  for (const char* ending : {"", "-journal", "-wal", "-shm"})
    removeFile((m_folder / kIndex).string() + ending);
  Catalogue index(m_folder / kIndex);
  for (const std::string& name : names)
    try
    {
      if (const auto state = stateOf(manifestPath(name)))
        index.put(summaryOf(readManifest(name), state->modified), state->stamp);
    }
    catch (const core::Error&)
    {
      // reported above
    }
  done.push_back("the index holds " + std::to_string(index.entries().size()) + " of " +
                 std::to_string(names.size()) + " cases");
  return done;
}

} // namespace petrous::library
