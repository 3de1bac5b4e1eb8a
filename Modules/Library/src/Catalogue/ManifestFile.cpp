#include "ManifestFile.h"

#include <algorithm>
#include <ctime>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "AttachmentFiles.h"
#include "JournalFile.h"
#include "LibraryFolder.h"
#include "Sha256.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Library/NewerVersion.h"
#include "petrous/Scene/Manifest.h"

namespace petrous::library
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;

namespace
{
constexpr std::uintmax_t kLargestManifest = 256U << 20;
} // namespace

namespace
{

std::string textOf(const fs::path& path)
{
  try
  {
    return core::readFile(path, kLargestManifest);
  }
  catch (const core::InputFileError& error)
  {
    throw libraryError(error);
  }
}

} // namespace

Description descriptionIn(const fs::path& path)
{
  return scene::descriptionFromManifest(textOf(path), core::printable(path));
}

scene::Case manifestIn(const fs::path& path, const std::string& name)
{
  scene::Case value = scene::fromManifest(textOf(path), core::printable(path));
  value.name = name;
  return value;
}

scene::Case manifestIn(const fs::path& path, const std::string& name, bool& isUnchanged)
{
  const std::string text = textOf(path);
  scene::Case value = scene::fromManifest(text, core::printable(path));
  isUnchanged = hasItsChecksum(text);
  value.name = name;
  return value;
}

namespace
{

constexpr const char* kChecksum = "sha256";
constexpr std::string_view kEnd = "\n}\n"; // of a manifest

std::string checksumMember(const std::string& sum)
{
  return std::string(",\n \"") + kChecksum + "\": \"" + sum + "\"" + std::string(kEnd);
}

std::string sumOf(std::string_view text, std::string_view end = {})
{
  Sha256 sum;
  sum.add(text.data(), text.size());
  sum.add(end.data(), end.size());
  return sum.hexadecimal();
}

} // namespace

std::string withChecksum(std::string manifest)
{
  const std::string sum = sumOf(manifest);
  manifest.resize(manifest.size() - kEnd.size());
  return manifest + checksumMember(sum);
}

bool hasItsChecksum(std::string_view manifest)
{
  constexpr std::size_t kDigits = 64;
  static const std::size_t tail = checksumMember(std::string(kDigits, '0')).size();
  if (manifest.size() > tail) // as it was written, which takes no parsing
  {
    const std::string_view rest = manifest.substr(0, manifest.size() - tail);
    if (checksumMember(sumOf(rest, kEnd)) == manifest.substr(rest.size()))
      return true;
  }
  nlohmann::json all = nlohmann::json::parse(manifest);
  const auto stated = all.find(kChecksum);
  if (stated == all.end())
    return true;
  const nlohmann::json sum = *stated;
  all.erase(stated);
  return sum == sumOf(all.dump(1), "\n");
}

std::string changedText(const fs::path& path, const std::string& name)
{
  return core::printable(path) + ": the file of case '" + name +
         "' was changed outside of Petrous, or is damaged: it does not have the checksum that it "
         "states. Where images and structures lie, how an MR is registered and all else in it may "
         "be wrong: do not rely on it before you have compared it with a copy of the library, or "
         "restored it from there";
}

namespace
{

ObjectUse useOf(const scene::ImagePart& image, const scene::Case& value)
{
  const bool isPrimary = &image == &value.ct;
  return {image.object, ObjectUse::Kind::Image, isPrimary ? "ct" : image.name,
          !isPrimary                              ? "MR '" + image.name + "'"
          : image.modality == scene::Modality::Mr ? "the MR"
                                                  : "the CT"};
}

} // namespace

std::vector<ObjectUse> objectsOf(const scene::Case& value)
{
  std::vector<ObjectUse> uses;
  std::set<std::string> seen;
  const auto add = [&](const std::string& object, ObjectUse::Kind kind, const std::string& name,
                       const std::string& what)
  {
    if (seen.insert(object).second)
      uses.push_back({object, kind, name, what, false});
  };
  const auto addImage = [&](const scene::ImagePart& image)
  {
    if (seen.insert(image.object).second)
      uses.push_back(useOf(image, value));
  };
  addImage(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), addImage);
  for (const auto& part : value.labels)
    add(part.object, ObjectUse::Kind::Structures,
        part.structures.empty() ? "" : part.structures.front().name, "structures");
  for (const auto& mesh : value.meshes)
    add(mesh.object, ObjectUse::Kind::Mesh, mesh.name, "mesh '" + mesh.name + "'");
  if (const auto& instrument = value.view.instrument)
  {
    const auto mesh =
        std::find_if(uses.begin(), uses.end(),
                     [&](const ObjectUse& use) { return use.object == instrument->object; });
    if (mesh == uses.end())
      add(instrument->object, ObjectUse::Kind::Instrument, "instrument", "the instrument");
    else
    {
      mesh->what += ", which is the instrument, too,";
      mesh->isInstrument = true;
    }
  }
  const auto& strokes = value.dissection.strokes();
  for (std::size_t n = 0; n < strokes.size(); ++n)
    add(strokes[n]->object, ObjectUse::Kind::Stroke, std::to_string(dissection::strokeNumber(n)),
        "stroke " + std::to_string(dissection::strokeNumber(n)));
  for (const scene::Attachment& attachment : value.attachments)
    if (!attachment.object.empty())
      add(attachment.object, ObjectUse::Kind::Attachment, attachment.name,
          attachmentText(attachment));
  return uses;
}

ObjectText textOf(const ObjectUse& use, const std::string& ofCase)
{
  return {use.what + " of case '" + ofCase + "'", use.kind == ObjectUse::Kind::Instrument};
}

std::vector<ObjectUse> misplacedImages(const scene::Case& value, const ObjectStore& store)
{
  std::vector<ObjectUse> misplaced;
  const auto check = [&](const scene::ImagePart& image)
  {
    try
    {
      const auto voxels =
          imaging::mapRawNrrd(store.path(image.object), imaging::VoxelAccess::Mapped);
      if (!core::sameGrid(voxels->geometry(), image.geometry))
        misplaced.push_back(useOf(image, value));
    }
    catch (const core::Error&)
    {
      // Whoever reads the image is told.
    }
  };
  check(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), check);
  return misplaced;
}

std::string misplacedText(const fs::path& path, const std::string& name, const ObjectUse& image)
{
  return core::printable(path) + ": " + image.what + " of case '" + name +
         "' does not lie where its voxels say: what is placed by it may be wrong; restore the file "
         "from a copy of the library, or import the images again";
}

namespace
{

// After listing it. A library that was never saved to has no folder yet; any other error is
// reported.
void checkListed(const fs::path& folder, const std::error_code& error)
{
  if (error && error != std::errc::no_such_file_or_directory)
    throw LibraryError(Reason::Damaged,
                       core::printable(folder) + ": cannot be read (" + error.message() +
                           "); give the library's folder and check its permissions");
}

} // namespace

std::vector<std::string> namesIn(const fs::path& folder)
{
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
  {
    const fs::path& path = entry->path();
    if (path.extension() == ".json" && path.filename().string()[0] != '.')
      names.push_back(path.stem().string());
  }
  checkListed(folder, error);
  std::sort(names.begin(), names.end());
  return names;
}

std::string idIn(const fs::path& manifest, const std::string& name)
{
  try
  {
    return manifestIn(manifest, name).id;
  }
  catch (const core::Error&)
  {
    return {};
  }
}

std::vector<std::string> namesOf(const fs::path& folder, const std::string& id)
{
  std::vector<std::string> names;
  if (id.empty())
    return names;
  const auto known = Catalogue(folder.parent_path() / kIndex).entries();
  for (const std::string& name : namesIn(folder))
  {
    const fs::path path = folder / (name + ".json");
    const auto entry = known.find(name);
    const auto state = stateOf(path);
    const bool isCurrent = entry != known.end() && state && entry->second.stamp == state->stamp;
    if ((isCurrent ? entry->second.summary.id : idIn(path, name)) == id)
      names.push_back(name);
  }
  return names;
}

std::string deletedEnding(std::uint64_t number)
{
  return kDeletedEnding + std::to_string(number);
}

namespace
{

// The number of a deletion in the name of a file; 0: of none.
std::uint64_t deletionNumber(const fs::path& file)
{
  constexpr std::string_view kEnding = kDeletedEnding;
  constexpr std::size_t kMostDigits = 18;
  const std::string ending = file.extension().string();
  const std::string digits = ending.substr(std::min(kEnding.size(), ending.size()));
  return ending.rfind(kEnding, 0) != 0 || digits.empty() || digits.size() > kMostDigits ||
                 digits.find_first_not_of("0123456789") != digits.npos
             ? 0
             : std::stoull(digits);
}

// Without the ending of a deletion. A case may be named so, whose manifest then ends in ".json".
bool isJournal(const fs::path& file)
{
  const std::string name = file.string();
  return file.extension() == ".journal" || name.find(".journal.aside-") != name.npos ||
         (file.extension() == ".new" && file.stem().extension() == ".journal");
}

template <class Use>
void forEachDeleted(const fs::path& folder, const Use& use)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (const std::uint64_t number = deletionNumber(entry->path()); number > 0)
      use(entry->path(), entry->path().stem(), number);
  checkListed(folder, error);
}

} // namespace

std::vector<DeletedFile> deletedIn(const fs::path& folder)
{
  std::vector<DeletedFile> found;
  forEachDeleted(folder,
                 [&found](const fs::path& path, const fs::path& file, std::uint64_t number)
                 {
                   // Manifests of earlier versions have no ".json".
                   if (file.extension() == ".json")
                     found.push_back({file.stem().string(), number, path});
                   else if (!isJournal(file))
                     found.push_back({file.string(), number, path});
                 });
  std::sort(found.begin(), found.end(),
            [](const DeletedFile& a, const DeletedFile& b) { return a.number > b.number; });
  return found;
}

std::vector<fs::path> deletedJournalsIn(const fs::path& folder)
{
  std::vector<fs::path> found;
  forEachDeleted(folder,
                 [&found](const fs::path& path, const fs::path& file, std::uint64_t)
                 {
                   if (file.extension() != ".json" && isJournal(file))
                     found.push_back(path);
                 });
  return found;
}

std::uint64_t unusedDeletionNumber(const fs::path& folder)
{
  std::uint64_t last = 0;
  forEachDeleted(folder, [&last](const fs::path&, const fs::path&, std::uint64_t number)
                 { last = std::max(last, number); });
  return last + 1;
}

std::optional<FileState> stateOf(const fs::path& path)
{
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0 && ::lstat(path.c_str(), &info) != 0)
    return std::nullopt;
  const auto text = [](std::time_t time)
  {
    std::tm utc{};
    ::gmtime_r(&time, &utc);
    char words[32];
    std::strftime(words, sizeof words, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return std::string(words);
  };
  return FileState{
      {static_cast<std::uintmax_t>(info.st_size),
       static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec},
      text(info.st_mtim.tv_sec),
      text(info.st_ctim.tv_sec)};
}

Catalogue::Entry entryOf(const scene::Case& value, const FileState& state)
{
  Catalogue::Entry entry;
  entry.stamp = state.stamp;
  entry.summary.name = value.name;
  entry.summary.id = value.id;
  entry.summary.modified = state.modified;
  entry.summary.dims = value.ct.geometry.dims();
  for (const auto& part : value.labels)
    entry.summary.structures += part.structures.size();
  entry.summary.strokes = value.applied();
  entry.summary.removed = value.removedVolume();
  entry.text = value.name;
  const std::vector<std::string> names = scene::partNames(value);
  for (auto name = names.begin() + 1; name != names.end(); ++name) // after the CT's
    entry.text += "\n" + *name;
  Description& description = entry.summary.description;
  description = value.description;
  entry.summary.hasNote = !std::exchange(description.note, {}).empty();
  for (const std::string& tag : description.tags)
    entry.text += "\n" + tag;
  entry.text += "\n" + description.diagnosis + "\n" + description.procedure;
  entry.text = scene::lowerCase(std::move(entry.text));
  return entry;
}

namespace
{

bool hasCase(const fs::path& cases, const std::string& id)
{
  if (id.empty())
    return false;
  const std::vector<DeletedFile> deleted = deletedIn(cases);
  return !namesOf(cases, id).empty() ||
         std::any_of(deleted.begin(), deleted.end(),
                     [&id](const DeletedFile& one) { return idIn(one.manifest, one.name) == id; });
}

} // namespace

// A manifest that was copied by hand has the ID of its original, whose journal stays with that.
bool isOfNamesake(const fs::path& journal, const std::string& id)
{
  fs::path manifest = journal;
  manifest.replace_extension(".json");
  return idIn(manifest, manifest.stem().string()) == id;
}

fs::path journalOf(const fs::path& library, const std::string& name, const std::string& id)
{
  const fs::path own = journalPath(library, name);
  std::error_code error;
  const bool isThere = fs::exists(fs::symlink_status(own, error));
  if (isThere && !isOfOtherCase(own, id))
    return own;
  for (fs::directory_iterator entry(own.parent_path(), error), end;
       !id.empty() && !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".journal" && caseIdIn(entry->path()) == id &&
        !isOfNamesake(entry->path(), id))
      return entry->path();
  return isThere && !hasCase(own.parent_path(), caseIdIn(own)) ? own : fs::path();
}

fs::path newJournalPath(const fs::path& library, const std::string& name, const std::string& id)
{
  const fs::path cases = library / "cases";
  const std::string there = idIn(cases / (name + ".json"), name);
  std::string now = name;
  if (!id.empty() && there != id)
  {
    const std::vector<std::string> names = namesOf(cases, id);
    now = names.size() == 1 ? names.front() : there.empty() ? name : id;
  }
  if (isOfOtherCase(journalPath(library, now), id))
    now = id;
  scene::checkCaseName(now);
  return journalPath(library, now);
}

void setOrphanAside(const fs::path& library, const std::string& name)
{
  const fs::path path = journalPath(library, name);
  const JournalFile journal(path);
  if (journal.there() && !journal.held())
    throw LibraryError(Reason::Conflict, "case '" + name +
                                             "' was removed, and another process is still "
                                             "drilling in it; end that first");
  if (!journal.there())
    return;
  const std::string id = caseIdIn(path);
  const bool isKept = hasCase(path.parent_path(), id);
  if (isKept)
    scene::checkCaseName(id);
  const fs::path kept = journalPath(library, id);
  if (isKept && !fs::exists(fs::symlink_status(kept)))
    moveFile(path, kept);
  else
    setAside(path);
}

namespace
{

// Empty: it is whole or damaged.
std::string newerText(const fs::path& manifest, const std::string& name)
{
  try
  {
    manifestIn(manifest, name);
  }
  catch (const scene::ManifestError& error)
  {
    if (error.reason == scene::ManifestError::Reason::NewerFormat)
      return error.what();
  }
  catch (const core::Error&)
  {
    // Library::verify says so.
  }
  return {};
}

} // namespace

std::vector<NewerCase> casesOfNewerVersion(const fs::path& library)
{
  const fs::path folder = library / "cases";
  std::vector<NewerCase> found;
  for (const std::string& name : namesIn(folder))
    if (std::string text = newerText(folder / (name + ".json"), name); !text.empty())
      found.push_back({name, false, std::move(text)});
  for (const DeletedFile& file : deletedIn(folder))
    if (std::string text = newerText(file.manifest, file.name); !text.empty())
      found.push_back({file.name, true, std::move(text)});
  return found;
}

bool isOfNewerVersion(const fs::path& library, const std::string& name)
{
  return !newerText(library / "cases" / (name + ".json"), name).empty();
}

} // namespace petrous::library
