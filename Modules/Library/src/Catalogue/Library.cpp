#include "petrous/Library/Library.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "AttachmentFiles.h"
#include "Catalogue.h"
#include "Graft.h"
#include "JournalFile.h"
#include "LibraryFolder.h"
#include "LibraryState.h"
#include "ManifestFile.h"
#include "Recovery.h"
#include "Salt.h"
#include "Sources.h"
#include "Thumbnail.h"
#include "petrous/Core/Log.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Library/CaseSearch.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/OpenMark.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Volume/VolumeBytes.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

using Reason = LibraryError::Reason;

// A missing object (its last case was deleted meanwhile) is stored again if the part is still in
// memory; else refuseMissing.
bool mustStore(const std::string& object, const ObjectStore& store, bool inMemory)
{
  return object.empty() || (inMemory && !store.contains(object));
}

// Stores the voxels of every part that has no object yet.
void storeParts(const Library& library, scene::Case& value, ObjectStore& store,
                const core::Progress& progress)
{
  const auto storeImage = [&](scene::ImagePart& image, const core::Progress& part)
  {
    if (!library.isStandIn(image) && mustStore(image.object, store, image.volume.peek() != nullptr))
      image.object = store.add("nrrd", [&](const fs::path& path)
                               { imaging::writeRawNrrd(path, *image.volume.get(), part); });
  };
  storeImage(value.ct, progress.part(0.0, 0.7));
  for (auto& mr : value.mr)
    storeImage(mr, progress.part(0.7, 0.8));
  for (auto& part : value.labels)
    if (mustStore(part.object, store, part.labels.peek() != nullptr))
      part.object = store.add("seg.nrrd", [&](const fs::path& path)
                              { imaging::writeLabelFile(path, *part.labels.get()); });
  progress.report(0.9, "saving");
  for (auto& mesh : value.meshes)
    if (mustStore(mesh.object, store, mesh.mesh.peek() != nullptr))
      mesh.object = store.add("obj", [&](const fs::path& path)
                              { imaging::writeMesh(path, *mesh.mesh.get()); });
  if (auto& instrument = value.view.instrument;
      instrument && mustStore(instrument->object, store, instrument->mesh.peek() != nullptr))
    instrument->object = store.add("obj", [&](const fs::path& path)
                                   { imaging::writeMesh(path, *instrument->mesh.get()); });
  const auto& strokes = value.dissection.strokes();
  for (std::size_t n = 0; n < strokes.size(); ++n)
    if (const auto packed = strokes[n]->packed;
        mustStore(strokes[n]->object, store, !!packed.peek()))
      value.dissection.setStored(n, store.add("stroke", *packed.get()), packed);
  storeAttachments(value, store, progress);
}

// No manifest gets a reference to an object that is not there, but for those of a damaged case:
// what is drilled in it is kept, also under another name, and its file may come back. Nor does a
// lost attachment or instrument keep a case from another library.
void refuseMissing(const scene::Case& next, const scene::Case& present, const fs::path& cases,
                   const ObjectStore& store)
{
  std::vector<ObjectUse> missing;
  for (const ObjectUse& use : objectsOf(next))
    if (!use.object.empty() && !store.contains(use.object))
      missing.push_back(use);
  if (missing.empty())
    return;
  std::set<std::string> damaged;
  const auto had = [&damaged](const scene::Case& value)
  {
    for (const ObjectUse& use : objectsOf(value))
      damaged.insert(use.object);
  };
  if (present.revision > 0)
    had(present);
  else
    for (const std::string& name : namesIn(cases))
      try
      {
        had(manifestIn(cases / (name + ".json"), name));
      }
      catch (const core::Error&)
      {
        // told where it is opened
      }
  std::string lost;
  std::size_t count = 0;
  for (const ObjectUse& use : missing)
    if (damaged.count(use.object) == 0 &&
        (present.revision > 0 ||
         (use.kind != ObjectUse::Kind::Attachment && use.kind != ObjectUse::Kind::Instrument)))
      lost += (count++ == 0 ? "" : ", ") + use.what;
  if (count > 0)
    throw LibraryError(Reason::NotFound,
                       "case '" + next.name +
                           "' cannot be saved, as of what it needs the library "
                           "has lost " +
                           lost +
                           " (removed by another program, or by hand); restore the library's files "
                           "from a copy, or take out of the case what is lost, and save again");
}

// With the files that attachments are links to.
std::vector<scene::PartsOrigin> originsOf(const scene::Case& value)
{
  std::vector<scene::PartsOrigin> origins = value.origins;
  for (const scene::Attachment& one : value.attachments)
    if (!one.link.empty())
      origins.push_back({one.link, fs::file_time_type::min()}); // no folder: of any time
  return origins;
}

std::string labelsText(const scene::Case& value, const scene::LabelPart& part)
{
  constexpr std::size_t kMaxNamed = 3;
  const std::size_t count = part.structures.size();
  std::string names;
  for (std::size_t n = 0; n < count && n < kMaxNamed; ++n)
    names += (n > 0 ? ", '" : "'") + part.structures[n].name + "'";
  if (count > kMaxNamed)
    names += " and " + std::to_string(count - kMaxNamed) + " more structures";
  return (count == 1   ? "structure "
          : count == 0 ? "a label map"
                       : "the label map of ") +
         names + " of case '" + value.name + "'";
}

std::string meshText(const scene::Case& value, const scene::MeshPart& mesh)
{
  return "mesh '" + mesh.name + "' of case '" + value.name + "'";
}

std::string imageText(const scene::Case& value, const scene::ImagePart& image)
{
  return (&image != &value.ct                     ? "MR '" + image.name + "'"
          : image.modality == scene::Modality::Mr ? "the MR"
                                                  : "the CT") +
         " of case '" + value.name + "'";
}

void refuse(const std::vector<std::string>& damage)
{
  if (damage.empty())
    return;
  std::string all;
  for (const std::string& words : damage)
    all += (all.empty() ? "" : "; ") + words;
  throw LibraryError(Reason::Damaged, all);
}

void saltFrames(scene::Case& value, const fs::path& folder)
{
  const scene::IdentitySalt salt = identitySalt([&folder] { return saltOf(folder); });
  const auto salted = [&salt](scene::ImagePart& image) { scene::saltIdentity(image, salt); };
  salted(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), salted);
}

// Incremented with every change of what readLabelFile makes of a file of the library, which states
// mm and its side, or of the bytes of a label map.
constexpr int kUnpackedLabelsVersion = 2;

// Decompressing a label file takes longer than most uses of it.
std::shared_ptr<const volume::LabelMap> unpackedLabels(const ObjectStore& store,
                                                       const std::string& object,
                                                       const std::string& what,
                                                       core::DerivedStore& derived)
{
  // No cached data replace a damaged object, or are derived from it.
  const fs::path path = store.checkedPath(object, what);
  const std::string key = "labels " + std::to_string(kUnpackedLabelsVersion) + " " + object;
  if (const auto bytes = derived.find(key))
    if (auto labels = volume::labelMapFrom(*bytes))
      return labels;
  auto labels = std::make_shared<const volume::LabelMap>(imaging::readLabelFile(path));
  derived.put(key, volume::bytesOf(*labels));
  return labels;
}

std::vector<Catalogue::Entry> entriesIn(const fs::path& folder, const core::Progress& progress = {})
{
  std::vector<Catalogue::Entry> cases;
  Catalogue catalogue(folder / kIndex);
  auto known = catalogue.entries();
  std::vector<Catalogue::Entry> unknown;
  const std::set<std::string> thumbnails = thumbnailIds(folder);
  for (const std::string& name : namesIn(folder / "cases"))
  {
    const fs::path path = folder / "cases" / (name + ".json");
    const auto state = stateOf(path);
    if (!state)
      continue; // removed in the meantime
    const auto entry = known.find(name);
    if (entry != known.end() && entry->second.stamp == state->stamp)
    {
      cases.push_back(std::move(entry->second));
      continue;
    }
    progress.check("listing the cases");
    try
    {
      cases.push_back(entryOf(manifestIn(path, name), *state));
      unknown.push_back(cases.back());
    }
    catch (const core::Error&)
    {
      Catalogue::Entry damaged;
      damaged.summary.name = name;
      damaged.summary.modified = state->modified;
      damaged.summary.damaged = true;
      damaged.text = scene::lowerCase(name);
      cases.push_back(std::move(damaged));
    }
  }
  if (!unknown.empty())
    catalogue.putIfThere(unknown);
  for (Catalogue::Entry& entry : cases)
    entry.summary.hasThumbnail = thumbnails.count(entry.summary.id) > 0;
  return cases;
}

template <class Read>
auto structure(const Read& read)
{
  try
  {
    return read();
  }
  catch (const LibraryError& error)
  {
    throw StructureError(error.reason, error.what());
  }
}

} // namespace

Library::Library(fs::path folder)
  : m_folder(std::move(folder))
  , m_state(std::make_shared<LibraryState>())
{
}

void Library::onWait(std::function<void(double)> waiting)
{
  m_state->waiting = std::move(waiting);
}

void Library::noticeOpeners()
{
  m_state->noticesOpeners = true;
}

void Library::noticeOpenersOf(const std::string& name, const std::string& id,
                              const std::string& advice) const
{
  if (!m_notice || !m_state->noticesOpeners)
    return;
  if (const std::string openersText = toString(openersOf(m_folder, id)); !openersText.empty())
    m_notice("case '" + name + "' is open in Petrous elsewhere (" + openersText + "); " + advice);
}

core::FileLock Library::lockForWriting(const core::Progress& progress) const
{
  return lockFolder(m_folder, progress, m_state->waiting);
}

fs::path Library::manifestPath(const std::string& name) const
{
  return m_folder / "cases" / (name + ".json");
}

fs::path Library::objectFolder() const
{
  return m_folder / "objects";
}

fs::path Library::checkedManifestPath(const std::string& name) const
{
  fs::path path = manifestPath(name);
  std::error_code error;
  if (fs::exists(fs::symlink_status(path, error)))
    return path;
  std::string there;
  for (const CaseSummary& summary : list())
    there += (there.empty() ? "" : ", ") + summary.name;
  throw LibraryError(Reason::NotFound,
                     "no case '" + name + "' in " + m_folder.string() + "; " +
                         (there.empty() ? "the library is empty" : "there are: " + there));
}

scene::Case Library::readManifest(const std::string& name) const
{
  return manifestIn(manifestPath(name), name);
}

std::vector<CaseSummary> Library::list() const
{
  std::vector<CaseSummary> cases;
  for (Catalogue::Entry& entry : entriesIn(m_folder))
    cases.push_back(std::move(entry.summary));
  return cases;
}

namespace
{

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream stream(scene::lowerCase(text));
  return {std::istream_iterator<std::string>(stream), {}};
}

bool hasAll(const std::string& text, const std::vector<std::string>& words)
{
  return std::all_of(words.begin(), words.end(),
                     [&text](const std::string& word) { return text.find(word) != text.npos; });
}

void checkDates(const CaseFilter& filter)
{
  for (const std::string* date : {&filter.from, &filter.to})
    if (!date->empty() && !scene::isDate(*date))
      throw core::InvalidParameter("date: must be a day as YYYY-MM-DD, e.g. 2026-03-31");
  if (!filter.to.empty() && filter.from > filter.to)
    throw core::InvalidParameter("dates: the first is later than the last");
}

} // namespace

std::vector<CaseSummary> Library::search(const CaseFilter& filter) const
{
  std::set<std::string> tags;
  return search(filter, tags);
}

std::vector<CaseSummary> Library::search(const CaseFilter& filter,
                                         std::set<std::string>& tags) const
{
  return searchCases(*this, filter, tags, {});
}

std::vector<CaseSummary> searchCases(const Library& library, const CaseFilter& filter,
                                     std::set<std::string>& tags, const core::Progress& progress)
{
  checkDates(filter);
  const auto words = wordsOf(filter.text);
  const auto diagnosis = wordsOf(filter.diagnosis);
  const auto procedure = wordsOf(filter.procedure);
  const auto isTagged = [](const Description& description, const std::string& tag)
  {
    return std::any_of(description.tags.begin(), description.tags.end(),
                       [wanted = scene::lowerCase(tag)](const std::string& one)
                       { return scene::lowerCase(one) == wanted; });
  };
  const auto noteOf = [&](const std::string& name)
  {
    progress.check("searching the notes");
    return scene::lowerCase(descriptionIn(library.folder() / "cases" / (name + ".json")).note);
  };
  std::vector<CaseSummary> found;
  for (Catalogue::Entry& entry : entriesIn(library.folder(), progress))
  {
    const Description& description = entry.summary.description;
    tags.insert(description.tags.begin(), description.tags.end());
    if (!hasAll(scene::lowerCase(description.diagnosis), diagnosis) ||
        !hasAll(scene::lowerCase(description.procedure), procedure) ||
        (filter.side && (*filter.side != description.side || entry.summary.damaged)) ||
        (!filter.from.empty() && description.date < filter.from) ||
        (!filter.to.empty() && (description.date.empty() || description.date > filter.to)) ||
        !std::all_of(filter.tags.begin(), filter.tags.end(),
                     [&](const std::string& tag) { return isTagged(description, tag); }))
      continue;
    if (!hasAll(entry.text, words))
      try
      {
        if (!filter.inNotes || !entry.summary.hasNote ||
            !hasAll(entry.text + "\n" + noteOf(entry.summary.name), words))
          continue;
      }
      catch (const core::CancelledError&)
      {
        throw;
      }
      catch (const core::Error&)
      {
        continue; // removed or damaged in the meantime
      }
    found.push_back(std::move(entry.summary));
  }
  return found;
}

std::vector<CaseSummary> Library::search(const std::string& text) const
{
  CaseFilter filter;
  filter.text = text;
  return search(filter);
}

namespace
{

// What the case is called now: another program may have renamed it, and given its name to another.
std::string nameInLibrary(const fs::path& cases, const scene::Case& value)
{
  if (idIn(cases / (value.name + ".json"), value.name) == value.id)
    return value.name;
  const std::vector<std::string> names = namesOf(cases, value.id);
  return names.size() == 1 ? names.front() : value.name;
}

// Why a case is not saved over `present`, which has its name in the library, `name`.
std::string conflictText(const scene::Case& value, const std::string& name,
                         const scene::Case& present)
{
  if (present.revision > 0 && present.id == value.id && name != value.name)
    return "case '" + value.name + "' was renamed '" + name +
           "' and changed by another program since it was opened; open it again and repeat what "
           "you did";
  if (present.revision > 0 && present.id == value.id)
    return "case '" + value.name +
           "' was changed by another program since it was opened; open it again and repeat what "
           "you did";
  if (present.revision > 0)
    return "case '" + value.name +
           "' was deleted by another program since it was opened, and another case has its name; "
           "save it under another name";
  return "case '" + value.name +
         "' was deleted by another program since it was opened; bring it back ('petrous library "
         "undelete'), or save it under another name";
}

} // namespace

std::string caseLike(const fs::path& library, const std::string& name)
{
  const std::string read = scene::asRead(name);
  std::string like;
  for (const std::string& one : namesIn(library / "cases"))
    if (one == name)
      return one;
    else if (scene::asRead(one) == read)
      like = one;
  return like;
}

void refuseTakenName(const fs::path& library, const std::string& name, const std::string& besides)
{
  const std::string read = scene::asRead(name);
  for (const std::string& taken : namesIn(library / "cases"))
    if (taken != besides && scene::asRead(taken) == read)
      throw LibraryError(Reason::NameTaken,
                         "case '" + taken + "' is there already in " + library.string() +
                             "; choose another name" +
                             (taken == name ? "" : " than '" + name + "', which reads the same"));
}

bool Library::contains(const std::string& name) const
{
  scene::checkCaseName(name);
  std::error_code error;
  return fs::exists(fs::symlink_status(manifestPath(name), error));
}

scene::Case Library::open(const std::string& name) const
{
  scene::checkCaseName(name);
  checkedManifestPath(name);
  bool isUnchanged = true;
  const auto read = [this, &name, &isUnchanged]
  {
    scene::Case manifest = manifestIn(manifestPath(name), name, isUnchanged);
    attach(manifest);
    return manifest;
  };
  scene::Case value = read();
  noticeDoubts(value, isUnchanged); // before recovery saves it
  if (const fs::path journal = journalOf(m_folder, name, value.id); !journal.empty())
  {
    const std::string words = recover(*this, value, journal, read);
    if (!words.empty())
      core::log::warning("library: a journal of a session that ended unexpectedly");
    if (m_notice && !words.empty())
      m_notice(words);
    attach(value); // without what recovery read
  }
  return value;
}

void Library::noticeDoubts(const scene::Case& value, bool isUnchanged) const
{
  const fs::path path = manifestPath(value.name);
  const auto tell = [this](const std::string& words)
  {
    core::log::warning("library: the file of a case is not as it was written");
    if (m_notice)
      m_notice(words);
  };
  if (const std::string text = changedText(path, value.name); !isUnchanged)
    tell(
        text +
        ". Saving the case accepts it as it is, as 'petrous library repair --accept-changed' does");
  for (const ObjectUse& image : misplacedImages(value, ObjectStore(objectFolder())))
    tell(misplacedText(path, value.name, image));
}

std::shared_ptr<core::DerivedStore> Library::derived() const
{
  return std::make_shared<DerivedCache>(derivedFolder(m_folder));
}

void Library::attach(scene::Case& value) const
{
  const ObjectStore store(objectFolder());
  const auto attachImage = [&](scene::ImagePart& image)
  {
    image.volume = core::Lazy<volume::IntensityVolume>(
        [store, checks = m_state->checks, object = image.object, what = imageText(value, image)]
        {
          const fs::path path = store.path(object, what);
          auto volume = imaging::mapRawNrrd(path);
          checks->start(path, what);
          return volume;
        });
  };
  attachImage(value.ct);
  for (auto& mr : value.mr)
    attachImage(mr);
  value.derived = derived();
  for (auto& part : value.labels)
    part.labels = core::Lazy<volume::LabelMap>(
        [store, object = part.object, what = labelsText(value, part), derived = value.derived]
        { return structure([&] { return unpackedLabels(store, object, what, *derived); }); });
  const auto meshOf = [&store](const std::string& object, const ObjectText& what)
  {
    return core::Lazy<core::TriangleMesh>(
        [store, object, what]
        {
          return structure(
              [&]
              {
                return std::make_shared<const core::TriangleMesh>(
                    imaging::readMesh(store.checkedPath(object, what)));
              });
        });
  };
  for (auto& mesh : value.meshes)
    mesh.mesh = meshOf(mesh.object, meshText(value, mesh));
  if (auto& instrument = value.view.instrument)
    instrument->mesh =
        meshOf(instrument->object, {"the instrument of case '" + value.name + "'", true});
  const auto& strokes = value.dissection.strokes();
  for (std::size_t n = 0; n < strokes.size(); ++n)
    value.dissection.setStored(n, strokes[n]->object,
                               core::Lazy<dissection::Stroke::Voxels>(
                                   [store, object = strokes[n]->object,
                                    what = "stroke " + std::to_string(dissection::strokeNumber(n)) +
                                           " of case '" + value.name + "'"] {
                                     return std::make_shared<const dissection::Stroke::Voxels>(
                                         store.readChecked(object, what));
                                   }));
}

void Library::loadDissection(scene::Case& value) const
{
  if (value.dissection.loaded())
    return;
  const auto line = value.dissection.history().lineTo(value.dissection.history().position());
  for (std::size_t n = 0; n < line.size(); ++n)
    try
    {
      value.dissection.strokes()[line[n]]->packed.get();
    }
    catch (const LibraryError& error)
    {
      throw LibraryError(error.reason,
                         std::string(error.what()) +
                             "; or go back to before it, which loses nothing: " + "petrous undo '" +
                             value.name + "' " + std::to_string(line.size() - n));
    }
  try
  {
    value.dissection.load(value.ct.geometry);
  }
  catch (const core::InvalidParameter& error)
  {
    throw LibraryError(Reason::Damaged, manifestPath(value.name).string() + ": " + error.what());
  }
}

std::vector<std::string> Library::loadSoundDissection(scene::Case& value) const
{
  const auto& strokes = value.dissection.strokes();
  const auto line = value.dissection.history().lineTo(value.dissection.history().position());
  std::size_t sound = line.size();
  std::vector<std::string> damage;
  for (std::size_t n = 0; n < strokes.size(); ++n)
    try
    {
      strokes[n]->packed.get();
    }
    catch (const LibraryError& error)
    {
      damage.emplace_back(error.what());
      const auto at = std::find(line.begin(), line.end(), n);
      sound = std::min(sound, static_cast<std::size_t>(at - line.begin()));
    }
  value.dissection.undo(line.size() - sound);
  loadDissection(value);
  return damage;
}

// The images that were read from here, each with a description.
std::vector<std::pair<fs::path, std::string>> Library::mappedImages(const scene::Case& value) const
{
  std::vector<std::pair<fs::path, std::string>> images;
  const auto add = [&](const scene::ImagePart& image)
  {
    const fs::path path = objectFolder() / image.object;
    if (image.volume.peek() && m_state->checks->knows(path)) // others were created in memory
      images.emplace_back(path, imageText(value, image));
  };
  add(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), add);
  return images;
}

void Library::checkVoxels(const scene::Case& value, const core::Progress& progress) const
{
  std::vector<std::string> damage;
  for (const auto& [path, what] : mappedImages(value))
    if (const std::string words = m_state->checks->wait(path, what, progress); !words.empty())
      damage.push_back(words);
  refuse(damage);
}

void Library::checkStructures(const scene::Case& value, const core::Progress& progress) const
{
  const ObjectStore store(objectFolder());
  std::optional<LibraryError> first;
  std::size_t more = 0;
  const auto check = [&](const std::string& object, const std::string& what)
  {
    if (object.empty()) // created in memory
      return;
    try
    {
      progress.check("checking structures");
      checkObject(store.path(object, what), what, progress);
    }
    catch (const LibraryError& error)
    {
      if (first)
        ++more;
      else
        first = error;
    }
  };
  for (const auto& part : value.labels)
    check(part.object, labelsText(value, part));
  for (const auto& mesh : value.meshes)
    check(mesh.object, meshText(value, mesh));
  if (first)
    throw StructureError(first->reason,
                         first->what() + (more == 0 ? std::string()
                                                    : "; " + std::to_string(more) +
                                                          (more == 1 ? " more is" : " more are") +
                                                          " missing or damaged"));
}

void Library::checkAllRead(const core::Progress& progress) const
{
  refuse(m_state->checks->waitForAll(progress));
}

bool Library::standInForCt(scene::Case& value, const core::Progress& progress) const
{
  const fs::path object = objectFolder() / value.ct.object;
  m_state->checks->forget(object);
  if (m_state->checks->wait(object, imageText(value, value.ct), progress).empty())
    return false;
  constexpr double kLeast = -32768.0, kMost = 32767.0; // of 16 bits
  using Voxels = volume::Volume<std::int16_t>;
  const auto standIn =
      std::make_shared<const volume::IntensityVolume>(std::make_shared<const Voxels>(
          value.ct.geometry,
          static_cast<std::int16_t>(std::clamp(value.ct.range.min, kLeast, kMost))));
  value.ct.volume = standIn;
  value.derived.reset(); // its keys identify the stored voxels
  const std::lock_guard<std::mutex> guard(m_state->mutex);
  m_state->standIns.insert(standIn);
  return true;
}

bool Library::isStandIn(const scene::ImagePart& image) const
{
  const std::shared_ptr<const volume::IntensityVolume> volume = image.volume.peek();
  const std::lock_guard<std::mutex> guard(m_state->mutex);
  return volume && m_state->standIns.count(volume) > 0;
}

std::vector<std::string> Library::damageFound(const scene::Case& value) const
{
  std::vector<std::string> damage;
  for (const auto& [path, what] : mappedImages(value))
    if (const std::string words = m_state->checks->found(path); !words.empty())
      damage.push_back(words);
  return damage;
}

std::string saltedFrame(const Library& library, const std::string& frameOfReference)
{
  return frameSalter(library)(frameOfReference);
}

scene::IdentitySalt frameSalter(const Library& library)
{
  struct Salt
  {
    std::mutex mutex;
    std::string text; ///< empty: not read yet
  };
  const auto read = [folder = library.folder(), salt = std::make_shared<Salt>()]
  {
    const std::lock_guard<std::mutex> guard(salt->mutex);
    std::error_code error;
    if (salt->text.empty() && fs::exists(folder / "salt", error))
      salt->text = saltOf(folder);
    if (salt->text.empty())
    {
      makeFolder(folder);
      const core::FileLock lock = lockFolder(folder);
      salt->text = saltOf(folder);
    }
    return salt->text;
  };
  return identitySalt(read);
}

bool hasLostSalt(const scene::Case& value, const scene::IdentitySalt& salt)
{
  const auto isLost = [&salt](const scene::ImagePart& image)
  { return !scene::isComparable(image, salt); };
  return isLost(value.ct) || std::any_of(value.mr.begin(), value.mr.end(), isLost);
}

namespace
{

// Of two texts of 64 hexadecimal digits; empty of any other text.
std::string exclusiveOr(const std::string& a, const std::string& b)
{
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  for (std::size_t n = 0; n < a.size() && a.size() == b.size(); ++n)
  {
    const std::size_t x = kDigits.find(a[n]);
    const std::size_t y = kDigits.find(b[n]);
    if (x == kDigits.npos || y == kDigits.npos)
      return {};
    result += kDigits[x ^ y];
  }
  return result;
}

} // namespace

void sealIdentity(const Library& library, scene::Case& value)
{
  const auto seal = [&](const char* field, std::string& hash)
  {
    if (!hash.empty())
      hash = exclusiveOr(
          hash, saltedFrame(library, std::string("leaving ") + field + " " + value.ct.object)
                    .substr(0, hash.size()));
  };
  const auto sealAll = [&seal](scene::ImagePart& image)
  {
    seal("frame", image.frameOfReference);
    seal("salt", image.saltId);
    seal("id", image.patient.id);
    seal("issuer", image.patient.issuer);
    seal("name", image.patient.name);
    seal("birth date", image.patient.birthDate);
    for (std::size_t n = 0; n < image.patient.nameParts.size(); ++n)
      seal(("name part " + std::to_string(n)).c_str(), image.patient.nameParts[n]);
  };
  sealAll(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), sealAll);
}

std::vector<std::string> forgetForeignIdentity(scene::Case& value)
{
  std::vector<std::string> notes;
  for (const scene::ImagePart& mr : value.mr)
    if (!mr.registered && mr.isFrameSalted && value.ct.isFrameSalted &&
        !mr.frameOfReference.empty() && mr.frameOfReference == value.ct.frameOfReference)
      notes.push_back("MR '" + mr.name +
                      "' was acquired in the CT's position, which the library that it comes to "
                      "cannot know; register it");
  const auto forget = [](scene::ImagePart& image)
  {
    if (image.isFrameSalted)
      scene::forgetIdentity(image);
  };
  forget(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), forget);
  return notes;
}

Description Library::description(const std::string& name) const
{
  scene::checkCaseName(name);
  checkedManifestPath(name);
  return descriptionIn(manifestPath(name));
}

void Library::describe(const std::string& name, const Description& description)
{
  scene::checkDescription(description);
  scene::Case value = open(name);
  if (value.description == description)
    return;
  value.description = description;
  save(value);
}

void Library::save(scene::Case& value, const core::Progress& progress)
{
  const bool isFirst = value.revision == 0;
  saveWith(
      value,
      [this, &progress](scene::Case& next, ObjectStore& store)
      { storeParts(*this, next, store, progress); },
      progress);
  if (!isFirst)
    noticeOpenersOf(value.name, value.id,
                    "what is changed there is not saved over this: open it there again");
}

void Library::saveWith(scene::Case& value,
                       const std::function<void(scene::Case&, ObjectStore&)>& storeObjects,
                       const core::Progress& progress)
{
  scene::checkCaseName(value.name);
  makeFolder(m_folder / "cases");
  makeFolder(objectFolder());
  const core::FileLock lock = lockForWriting(progress);

  const std::string former = value.name;
  std::string name = former;
  scene::Case present;
  if (value.revision == 0)
  {
    refuseTakenName(m_folder, name);
    setOrphanAside(m_folder, name);
  }
  else
  {
    if (contains(name))
      present = readManifest(name);
    if (present.id != value.id)
    {
      name = nameInLibrary(m_folder / "cases", value);
      if (name != former)
        present = readManifest(name);
    }
    if (present.revision != value.revision || present.id != value.id)
      throw LibraryError(Reason::Conflict, conflictText(value, name, present));
  }
  const fs::path path = manifestPath(name);
  const bool there = present.revision > 0;

  const auto started = std::chrono::steady_clock::now();
  removeLeftovers(objectFolder());
  removeLeftovers(m_folder / "cases");
  ObjectStore store(objectFolder());
  bool onDisk = true;
  std::vector<scene::PartsOrigin> origins;
  try
  {
    scene::Case next = value;
    next.name = name;
    storeObjects(next, store);
    refuseMissing(next, present, m_folder / "cases", store);
    if (next.revision == 0)
      next.id = drawnId();
    saltFrames(next, m_folder);
    ++next.revision;
    progress.report(0.95, "saving");
    const std::string manifest = withChecksum(scene::toManifest(next));
    scene::fromManifest(manifest, path.string()); // never writes what cannot be read again
    core::OutputFile file(path);
    file.write(manifest);
    onDisk = file.commit();
    // The manifest is published: no rollback from here on.
    store.forget();
    origins = originsOf(next);
    next.origins.clear();
    value = std::move(next);
  }
  catch (const core::OutputFileError& error)
  {
    store.discardNew();
    throw libraryError(error, "case '" + value.name + (there ? "' is as it was" : "' is not kept"));
  }
  catch (...)
  {
    store.discardNew();
    throw;
  }
  try
  {
    if (m_notice && name != former)
      m_notice("case '" + former +
               "' was renamed by another program since it was opened, and was saved under its new "
               "name, '" +
               name + "'");
    if (!onDisk && m_notice)
      m_notice("case '" + value.name +
               "' is saved, but the disk reported an error; check the disk");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started;
    core::log::info("library: case saved in " + core::fixedText(seconds.count(), 3) + " s, " +
                    std::to_string(value.dissection.strokes().size()) + " strokes, " +
                    std::to_string(1 + value.mr.size()) + " images, " +
                    std::to_string(value.labels.size()) + " label maps, " +
                    std::to_string(value.meshes.size()) + " meshes" +
                    (onDisk ? "" : "; the disk reported an error"));
    if (const auto state = stateOf(path))
      Catalogue(m_folder / kIndex).put(entryOf(value, *state));
    if (!origins.empty())
      Sources(m_folder).add(origins);
  }
  catch (const std::exception& error) // the case is saved, whatever is said of it
  {
    core::log::error("library: after saving: " + core::log::typeOf(error));
  }
}

std::string Library::saveDrilled(scene::Case& value, const SavedState& base,
                                 const core::Progress& progress)
{
  constexpr int kAttempts = 20; // another program keeps saving
  for (int attempt = 1;; ++attempt)
  {
    try
    {
      save(value, progress);
      return {};
    }
    catch (const LibraryError& error)
    {
      if (error.reason != Reason::Conflict || attempt == kAttempts)
        throw;
    }
    if (auto now = mergedWithSaved(value, base))
    {
      try
      {
        save(*now, progress);
      }
      catch (const LibraryError& error)
      {
        if (error.reason != Reason::Conflict || attempt == kAttempts)
          throw;
        continue;
      }
      value = std::move(*now);
      return "case '" + value.name +
             "' was changed by another program meanwhile; what was drilled was added to it, on "
             "branch '" +
             value.dissection.history().branch().name + "'";
    }
    scene::Case own = value;
    own.revision = 0;
    std::string stem = core::utf8Prefix(value.name, 80);
    while (!stem.empty() && stem.back() == ' ') // at which names must not end
      stem.pop_back();
    for (int n = 1; own.name == value.name || !caseLike(m_folder, own.name).empty(); ++n)
      own.name = stem + " drilled " + std::to_string(n);
    save(own, progress);
    const std::string name = std::exchange(value, std::move(own)).name;
    return "case '" + name +
           "' was removed or changed by another program meanwhile so that what was drilled does "
           "not fit; it was saved as case '" +
           value.name + "'";
  }
}

// The state saved by another program, with the strokes drilled since `base`; nullopt if they do not
// fit.
std::optional<scene::Case> Library::mergedWithSaved(const scene::Case& value,
                                                    const SavedState& base) const
{
  if (value.dissection.strokes().size() < base.strokes.size())
    return std::nullopt;
  try
  {
    bool isUnchanged = true;
    const std::string name = nameInLibrary(m_folder / "cases", value);
    scene::Case now = manifestIn(manifestPath(name), name, isUnchanged);
    if (now.id != base.id || !goesOnFrom(now, base))
      return std::nullopt;
    noticeDoubts(now, isUnchanged);
    attach(now);
    loadDissection(now);
    return graft(now, base, value.dissection);
  }
  catch (const core::Error&) // damaged in the meantime
  {
    return std::nullopt;
  }
}

} // namespace petrous::library
