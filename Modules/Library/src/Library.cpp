#include "petrous/Library/Library.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <optional>
#include <sstream>

#include <sys/stat.h>

#include "Catalogue.h"
#include "DurableFile.h"
#include "JournalFile.h"
#include "Recovery.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Manifest.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

using Reason = LibraryError::Reason;

std::string readText(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file)
    throw LibraryError(Reason::Damaged, path.string() + ": cannot be read");
  return text.str();
}

struct FileState
{
  Catalogue::Stamp stamp;
  std::string modified;
};

std::optional<FileState> stateOf(const fs::path& path)
{
  struct stat info
  {
  };
  if (::stat(path.c_str(), &info) != 0)
    return std::nullopt;
  std::tm utc{};
  ::gmtime_r(&info.st_mtim.tv_sec, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return FileState{
      {static_cast<std::uintmax_t>(info.st_size),
       static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec},
      text};
}

CaseSummary summaryOf(const scene::Case& value, const std::string& modified)
{
  CaseSummary summary;
  summary.name = value.name;
  summary.modified = modified;
  summary.dims = value.ct.geometry.dims();
  for (const auto& part : value.labels)
    summary.structures += part.structures.size();
  summary.strokes = value.applied();
  summary.removed = value.removedVolume();
  return summary;
}

// Puts the voxels of every part that has no object yet into the store.
void storeParts(scene::Case& value, ObjectStore& store, const core::Progress& progress)
{
  const auto storeImage = [&](scene::ImagePart& image, const core::Progress& part)
  {
    if (image.object.empty())
      image.object = store.add("nrrd", [&](const fs::path& path)
                               { imaging::writeRawNrrd(path, *image.volume.get(), part); });
  };
  storeImage(value.ct, progress.part(0.0, 0.7));
  for (auto& mr : value.mr)
    storeImage(mr, progress.part(0.7, 0.8));
  for (auto& part : value.labels)
    if (part.object.empty())
      part.object = store.add("seg.nrrd", [&](const fs::path& path)
                              { imaging::writeLabelFile(path, *part.labels.get()); });
  progress.report(0.9, "saving");
  for (auto& mesh : value.meshes)
    if (mesh.object.empty())
      mesh.object = store.add("obj", [&](const fs::path& path)
                              { imaging::writeMesh(path, *mesh.mesh.get()); });
  for (scene::StrokePart& part : value.strokes)
    if (part.object.empty())
    {
      part.bytes = part.stroke->packed.size();
      part.object = store.add("stroke", part.stroke->packed);
    }
}

} // namespace

Library::Library(fs::path folder)
  : m_folder(std::move(folder))
{
}

fs::path Library::manifestPath(const std::string& name) const
{
  return m_folder / "cases" / (name + ".json");
}

fs::path Library::objectFolder() const
{
  return m_folder / "objects";
}

std::vector<CaseSummary> Library::list() const
{
  std::vector<CaseSummary> cases;
  const Catalogue catalogue(m_folder / "library.sqlite");
  std::error_code error;
  fs::directory_iterator entry(m_folder / "cases", error);
  // A library that was never saved to has no folder yet; anything else is a fault to be told.
  if (error && error != std::errc::no_such_file_or_directory)
    throw LibraryError(Reason::Damaged,
                       (m_folder / "cases").string() + ": cannot be read (" + error.message() +
                           "); give the library's folder and check its permissions");
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
  {
    const fs::path& path = entry->path();
    const auto state = stateOf(path);
    if (path.extension() != ".json" || path.filename().string()[0] == '.' || !state)
      continue;
    const std::string name = path.stem().string();
    if (auto known = catalogue.find(name, state->stamp))
    {
      cases.push_back(std::move(*known));
      continue;
    }
    try
    {
      cases.push_back(
          summaryOf(scene::fromManifest(readText(path), path.string()), state->modified));
    }
    catch (const core::Error&)
    {
      CaseSummary damaged;
      damaged.name = name;
      damaged.modified = state->modified;
      damaged.damaged = true;
      cases.push_back(std::move(damaged));
    }
  }
  std::sort(cases.begin(), cases.end(),
            [](const CaseSummary& a, const CaseSummary& b) { return a.name < b.name; });
  return cases;
}

bool Library::contains(const std::string& name) const
{
  scene::checkCaseName(name);
  return fs::exists(manifestPath(name));
}

scene::Case Library::open(const std::string& name) const
{
  scene::checkCaseName(name);
  const fs::path path = manifestPath(name);
  if (!fs::exists(path))
  {
    std::string there;
    for (const CaseSummary& summary : list())
      there += (there.empty() ? "" : ", ") + summary.name;
    throw LibraryError(Reason::NotFound,
                       "no case '" + name + "' in " + m_folder.string() + "; " +
                           (there.empty() ? "the library is empty" : "there are: " + there));
  }
  const auto read = [&path] { return scene::fromManifest(readText(path), path.string()); };
  scene::Case value = read();
  if (value.name == name && fs::exists(journalPath(m_folder, name)))
  {
    const std::string words = recover(*this, value, read);
    if (m_notice && !words.empty())
      m_notice(words);
  }
  attach(value);
  return value;
}

void Library::attach(scene::Case& value) const
{
  const ObjectStore store(objectFolder());
  const auto attachImage = [&store](scene::ImagePart& image)
  {
    image.volume = core::Lazy<volume::IntensityVolume>(
        [store, object = image.object] { return imaging::mapRawNrrd(store.path(object)); });
  };
  attachImage(value.ct);
  for (auto& mr : value.mr)
    attachImage(mr);
  for (auto& part : value.labels)
    part.labels = core::Lazy<volume::LabelMap>(
        [store, object = part.object] {
          return std::make_shared<const volume::LabelMap>(
              imaging::readLabelFile(store.path(object)));
        });
  for (auto& mesh : value.meshes)
    mesh.mesh = core::Lazy<core::TriangleMesh>(
        [store, object = mesh.object] {
          return std::make_shared<const core::TriangleMesh>(imaging::readMesh(store.path(object)));
        });
}

void Library::loadDissection(scene::Case& value) const
{
  if (value.dissection)
    return;
  const ObjectStore store(objectFolder());
  std::vector<std::shared_ptr<const dissection::Stroke>> strokes;
  for (const scene::StrokePart& part : value.strokes)
    strokes.push_back(part.stroke ? part.stroke
                                  : std::make_shared<const dissection::Stroke>(dissection::Stroke{
                                        part.info, store.readWhole(part.object)}));
  try
  {
    value.dissection =
        std::make_shared<dissection::Dissection>(value.ct.geometry, strokes, value.history);
  }
  catch (const core::InvalidParameter& error)
  {
    throw LibraryError(Reason::Damaged, manifestPath(value.name).string() + ": " + error.what());
  }
  for (std::size_t n = 0; n < strokes.size(); ++n)
    value.strokes[n].stroke = std::move(strokes[n]);
}

void Library::save(scene::Case& value, const core::Progress& progress)
{
  scene::checkCaseName(value.name);
  makeFolder(m_folder / "cases");
  makeFolder(objectFolder());
  const FolderLock lock(m_folder / ".lock");

  const fs::path path = manifestPath(value.name);
  if (value.revision == 0 && fs::exists(path))
    throw LibraryError(Reason::NameTaken, "case '" + value.name + "' is there already in " +
                                              m_folder.string() + "; choose another name");
  if (value.revision != 0)
  {
    const bool there = fs::exists(path);
    const auto present =
        there ? scene::fromManifest(readText(path), path.string()).revision : std::uint64_t{0};
    if (present != value.revision)
      throw LibraryError(
          Reason::Conflict,
          "case '" + value.name + "' was " + (there ? "changed" : "removed") +
              " by another program since it was opened; open it again and repeat what you did");
  }

  ObjectStore store(objectFolder());
  store.removeLeftovers();
  try
  {
    scene::Case next = value;
    storeParts(next, store, progress);
    ++next.revision;
    progress.report(0.95, "saving");
    const std::string manifest = scene::toManifest(next);
    scene::fromManifest(manifest, path.string()); // what cannot be read again is never written
    replaceDurably(path, manifest);
    store.forget();
    value = std::move(next);
  }
  catch (...)
  {
    store.discardNew();
    throw;
  }
  if (const auto state = stateOf(path))
    Catalogue(m_folder / "library.sqlite").put(summaryOf(value, state->modified), state->stamp);
}

} // namespace petrous::library
