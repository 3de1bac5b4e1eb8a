#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <future>
#include <optional>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ArchiveIndex.h"
#include "AttachmentFiles.h"
#include "GzipMembers.h"
#include "LibraryFolder.h"
#include "ManifestFile.h"
#include "Sha256.h"
#include "Thumbnail.h"
#include "ZipEntries.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/OwnerLock.h"
#include "petrous/Scene/GoneNames.h"
#include "petrous/Scene/Manifest.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kLongestHeader = 1U << 20;
constexpr std::size_t kBatch = MemberLevels::kCycle; // members packed at once, 48 MiB

/// The parts of a producer's bytes that do not fit the reader's buffer wait here.
Produce fromMemory(std::vector<std::uint8_t> bytes)
{
  auto state =
      std::make_shared<std::pair<std::vector<std::uint8_t>, std::size_t>>(std::move(bytes), 0);
  return [state](char* buffer, std::size_t room)
  {
    auto& [all, at] = *state;
    const std::size_t count = std::min(room, all.size() - at);
    std::memcpy(buffer, all.data() + at, count);
    at += count;
    return count;
  };
}

/// An NRRD object with gzip encoding, its voxels packed as they are read, in another thread than
/// that which writes them; verified against its hash.
class PackedImage
{
public:
  PackedImage(fs::path path, ObjectText what, std::optional<int> level)
    : m_file(path)
    , m_what(std::move(what))
    , m_levels(level ? MemberLevels{*level, *level} : levelsFor(samples()))
  {
    std::string head = next(std::min<std::uintmax_t>(kLongestHeader, m_file.size()));
    const std::size_t end = head.find("\n\n");
    const std::size_t encoding = head.find("\nencoding: raw\n");
    if (end == head.npos || encoding == head.npos || encoding > end)
      throw LibraryError(LibraryError::Reason::Damaged,
                         core::printable(path) + ": is no image as this program stores it; "
                                                 "'petrous library verify' lists what is damaged");
    m_pending = packedHeader(head.substr(0, end + 2));
    m_carried = head.substr(end + 2);
  }

  /// The header of the packed file. `raw`: that of the object.
  static std::string packedHeader(std::string raw)
  {
    constexpr std::string_view kRaw = "\nencoding: raw\n";
    return raw.replace(raw.find(kRaw), kRaw.size(), "\nencoding: gzip\n");
  }

  std::size_t produce(char* buffer, std::size_t room)
  {
    if (m_given == m_pending.size())
    {
      m_given = 0;
      if (!m_coming.valid())
        pack();
      m_pending = m_coming.get();
      if (m_pending.empty())
        check();
      else
        pack(); // while this is written
    }
    const std::size_t count = std::min(room, m_pending.size() - m_given);
    std::memcpy(buffer, m_pending.data() + m_given, count);
    m_given += count;
    return count;
  }

private:
  void pack()
  {
    m_coming = std::async(
        std::launch::async,
        [this]
        {
          std::string raw = std::exchange(m_carried, {});
          const std::size_t wanted = kBatch * kMemberBytes;
          if (raw.size() < wanted)
            raw += next(std::min<std::uintmax_t>(wanted - raw.size(), m_file.size() - m_read));
          return packMembers(raw, m_levels);
        });
  }

  /// Of the whole file, from the middle of each part; not more than an eighth of it, so that they
  /// take less time than the file.
  std::vector<std::string> samples() const
  {
    constexpr std::uintmax_t kMost = 8;
    const auto parts = std::clamp<std::uintmax_t>(m_file.size() / (8 * kSampleBytes), 1, kMost);
    std::vector<std::string> all;
    for (std::uintmax_t n = 0; n < parts; ++n)
    {
      const std::uintmax_t middle = (2 * n + 1) * m_file.size() / (2 * parts);
      const std::uintmax_t from = middle - std::min<std::uintmax_t>(middle, kSampleBytes / 2);
      all.push_back(bytesAt(from, std::min<std::uintmax_t>(kSampleBytes, m_file.size() - from)));
    }
    return all;
  }

  std::string next(std::uintmax_t count)
  {
    std::string bytes = bytesAt(m_read, count);
    m_hash.add(bytes.data(), bytes.size());
    m_read += count;
    return bytes;
  }

  std::string bytesAt(std::uintmax_t from, std::uintmax_t count) const
  {
    std::string bytes(count, '\0');
    for (std::size_t done = 0; done < bytes.size();)
    {
      const ssize_t got = ::pread(m_file.descriptor(), bytes.data() + done, bytes.size() - done,
                                  static_cast<off_t>(from + done));
      if (got < 0 && errno == EINTR)
        continue;
      if (got <= 0)
        throw LibraryError(LibraryError::Reason::Damaged,
                           core::printable(m_file.path()) + ": cannot be read to its end");
      done += static_cast<std::size_t>(got);
    }
    return bytes;
  }

  void check()
  {
    if (m_checked)
      return;
    m_checked = true;
    if (m_file.path().filename().string().rfind(m_hash.hexadecimal(), 0) == 0)
      return;
    checkObject(m_file.path(), m_what); // throws, naming what to do
    throw LibraryError(LibraryError::Reason::Damaged,
                       core::printable(m_file.path()) + ": changed while it was read; try again");
  }

  core::InputFile m_file;
  ObjectText m_what;
  MemberLevels m_levels;
  Sha256 m_hash;
  std::uintmax_t m_read = 0;
  std::string m_carried; ///< read, not packed
  std::string m_pending; ///< packed, not given
  std::size_t m_given = 0;
  bool m_checked = false;
  std::future<std::string> m_coming; ///< packed; last: it uses the others
};

/// An object as it is, verified against its hash.
Produce fromObject(const fs::path& path, const ObjectText& what)
{
  struct State
  {
    core::InputFile file;
    Sha256 hash;
    std::uintmax_t read = 0;
    bool isChecked = false;
  };
  auto state = std::make_shared<State>(State{core::InputFile(path), {}});
  return [state, what](char* buffer, std::size_t room)
  {
    const auto count =
        static_cast<std::size_t>(std::min<std::uintmax_t>(room, state->file.size() - state->read));
    ssize_t got = 0;
    do
      got = count == 0
                ? 0
                : ::pread(state->file.descriptor(), buffer, count, static_cast<off_t>(state->read));
    while (got < 0 && errno == EINTR);
    if (got < 0 || (got == 0 && count > 0))
      throw LibraryError(LibraryError::Reason::Damaged,
                         core::printable(state->file.path()) + ": cannot be read to its end");
    state->hash.add(buffer, static_cast<std::size_t>(got));
    state->read += static_cast<std::uintmax_t>(got);
    if (state->read == state->file.size() && !std::exchange(state->isChecked, true) &&
        state->file.path().filename().string().rfind(state->hash.hexadecimal(), 0) != 0)
      checkObject(state->file.path(), what); // throws, naming what to do
    return static_cast<std::size_t>(got);
  };
}

/// A part's name as a file name: valid on every system, unique among `used`.
std::string fileName(const std::string& name, const std::string& ending,
                     std::set<std::string>& used)
{
  std::string stem = core::utf8Prefix(name, 100);
  for (char& c : stem)
    if (static_cast<unsigned char>(c) < 32 || c == 127 || std::strchr("/\\:*?\"<>|", c))
      c = '_';
  while (!stem.empty() && (stem.back() == ' ' || stem.back() == '.'))
    stem.pop_back();
  if (stem.empty() || stem.front() == '.')
    stem = "_" + stem;
  const auto key = [&ending](const std::string& text) // on systems that ignore case, too
  {
    std::string lower = text + ending;
    for (char& c : lower)
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
  };
  std::string unique = stem;
  for (int n = 2; !used.insert(key(unique)).second; ++n)
    unique = stem + "-" + std::to_string(n);
  return unique + ending;
}

/// A label map as the case shows it: with current names, and without the voxels of structures that
/// were removed. nullopt where the object says just that. `object`: its file.
std::optional<volume::LabelMap> asShown(const scene::LabelPart& part, const fs::path& object,
                                        const std::string& what)
{
  const auto shown = [&part](const volume::Segment& segment)
  {
    return std::find_if(part.structures.begin(), part.structures.end(),
                        [&segment](const scene::StructurePart& structure)
                        { return structure.index == segment.index; });
  };
  const auto isShown = [&](const volume::Segment& segment)
  {
    const auto structure = shown(segment);
    return structure != part.structures.end() && structure->name == segment.name;
  };
  std::vector<volume::Segment> segments;
  try
  {
    segments = imaging::readSegments(object);
  }
  catch (const imaging::FileError&)
  {
    checkObject(object, what); // throws, naming what to do
    throw;
  }
  if (segments.size() == part.structures.size() &&
      std::all_of(segments.begin(), segments.end(), isShown))
    return std::nullopt;

  const std::shared_ptr<const volume::LabelMap> stored = part.labels.get();
  std::vector<volume::Segment> kept;
  std::array<bool, 65536> stays{};
  for (const volume::Segment& segment : stored->segments)
    if (const auto structure = shown(segment); structure != part.structures.end())
    {
      kept.push_back(segment);
      kept.back().name = structure->name;
      stays[segment.index] = true;
    }
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(*stored->voxels);
  std::transform(voxels->data(), voxels->data() + voxels->size(), voxels->data(),
                 [&stays](std::uint16_t label) { return stays[label] ? label : std::uint16_t{0}; });
  return volume::makeLabelMap(std::move(voxels), std::move(kept));
}

/// A folder beside an archive, in which it and the objects that are made for it alone grow: voxels
/// and copies of linked files of a patient. What a killed process left there is removed first.
class ArchiveStaging
{
public:
  explicit ArchiveStaging(const fs::path& archive)
  {
    const fs::path target = core::outputTarget(archive);
    removeAbandoned(target.has_parent_path() ? target.parent_path() : fs::path("."), isLeftover);
    constexpr int kAttempts = 10;
    for (int n = 0; n < kAttempts && (!m_lock || !m_lock->isThere()); ++n)
    {
      m_lock.reset();
      if (std::error_code ignored; !m_folder.empty())
        fs::remove(m_folder, ignored);
      m_folder = core::temporaryBeside(target);
      if (::mkdir(m_folder.c_str(), 0700) != 0)
        core::throwOutputError(errno, archive);
      m_lock = std::make_unique<OwnerLock>(m_folder);
    }
    if (!m_lock->isThere())
      core::throwOutputError(EBUSY, archive);
    const fs::path objects = m_folder / kObjects;
    if (::mkdir(objects.c_str(), 0700) != 0)
    {
      const int error = errno;
      ::rmdir(m_folder.c_str());
      core::throwOutputError(error, archive);
    }
    m_store = std::make_unique<ObjectStore>(objects);
  }
  ~ArchiveStaging()
  {
    std::error_code ignored;
    fs::remove_all(m_folder, ignored);
  }
  ArchiveStaging(const ArchiveStaging&) = delete;
  ArchiveStaging& operator=(const ArchiveStaging&) = delete;

  const fs::path& folder() const noexcept { return m_folder; }

  ObjectStore& store() { return *m_store; } ///< of objects for this archive alone

private:
  static constexpr const char* kObjects = "objects";

  // Such a folder, and not one in which something else grows: it has what is made here, and no
  // more. An empty one may be about to be filled, unless it is old.
  static bool isLeftover(const fs::path& path)
  {
    std::error_code error;
    if (!core::isLeftover(path) || !fs::is_directory(fs::symlink_status(path, error)))
      return false;
    bool isEmpty = true;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error))
    {
      const std::string name = entry->path().filename().string();
      isEmpty = false;
      if (name != kObjects && name.rfind("archive", 0) != 0) // libzip adds an ending
        return false;
    }
    constexpr auto kOld = std::chrono::hours(1);
    if (!error && isEmpty)
      isEmpty = fs::last_write_time(path, error) + kOld > fs::file_time_type::clock::now();
    return !error && !isEmpty;
  }

  fs::path m_folder;
  std::unique_ptr<OwnerLock> m_lock;
  std::unique_ptr<ObjectStore> m_store;
};

/// Makes an attachment one whose object can be archived: sound, embedded, and of a PNG without what
/// is no picture. Returns what is wrong with its file where that cannot be, else nothing.
std::string embed(scene::Attachment& one, const Library& library, ArchiveStaging& passing,
                  const core::Progress& progress)
{
  const ObjectStore kept(library.folder() / "objects");
  if (one.bytes > kLargestEmbedded)
    return "larger than can be embedded";
  if (!one.link.empty())
  {
    scene::Case linked;
    one.source = std::exchange(one.link, {});
    linked.attachments.push_back(one);
    storeAttachments(linked, passing.store(), progress);
    const std::string expected = std::exchange(one.sha256, {});
    one.object = linked.attachments.front().object;
    if (one.object.rfind(expected, 0) != 0)
      return "changed";
  }
  else
    try
    {
      checkObject(kept.path(one.object), attachmentText(one), progress);
    }
    catch (const LibraryError&)
    {
      return "damaged";
    }
  if (one.kind != scene::Attachment::Kind::Screenshot)
    return {};
  if (one.bytes > kLargestPng)
    return "too large for its metadata to be removed";
  // A link was kept as it is, and so may another program have done that wrote an archive.
  const ObjectStore& store = passing.store().contains(one.object) ? passing.store() : kept;
  const std::vector<std::uint8_t> png = store.readChecked(one.object, attachmentText(one));
  try
  {
    const std::vector<std::uint8_t> cleaned = cleanedPng(png);
    if (cleaned != png)
      one.object = passing.store().add("png", cleaned);
    one.bytes = cleaned.size();
  }
  catch (const core::InvalidParameter&)
  {
    return "no PNG whose metadata can be removed";
  }
  return {};
}

/// A lost tool keeps no case back.
void chooseInstrument(scene::Case& value, const ObjectStore& kept, std::vector<std::string>& notes,
                      const core::Progress& progress)
{
  auto& instrument = value.view.instrument;
  if (!instrument)
    return;
  instrument->name.clear(); // its file may be called after the patient, or who owns it
  try
  {
    checkObject(kept.path(instrument->object), {"the instrument", true}, progress);
  }
  catch (const LibraryError&)
  {
    instrument.reset();
    notes.emplace_back("the instrument is not in the archive: its file is damaged or missing");
  }
}

/// Leaves out what stays in the library, embeds what is linked, and notes both.
void chooseAttachments(scene::Case& value, const Library& library, const ArchiveOptions& options,
                       ArchiveStaging& passing, std::vector<std::string>& notes,
                       const core::Progress& progress)
{
  using scene::Attachment;
  std::vector<Attachment> chosen;
  std::string unclean;
  for (Attachment one : value.attachments)
  {
    const std::string what = attachmentText(one);
    const bool isPlain =
        one.kind == Attachment::Kind::Screenshot || one.kind == Attachment::Kind::Recording;
    if (!takesAlong(options, one))
      notes.push_back(what + " stays in this library: " +
                      (options.planOnly ? "a plan takes small screenshots and recordings along"
                       : one.kind == Attachment::Kind::Video
                           ? "a video may show or name the patient (--with-videos takes it along)"
                           : "a PDF may name the patient, also in its metadata "
                             "(--with-documents takes it along)"));
    else if (const std::string problem = attachmentProblem(library, one); !problem.empty())
      notes.push_back(what + " is not in the archive: its file is " + problem);
    else if (const std::string fault = embed(one, library, passing, progress); !fault.empty())
      notes.push_back(what + " is not in the archive: its file is " + fault);
    else
    {
      if (!options.keepIdentity)
        one.date.clear();
      if (options.withoutNotes)
        one.note.clear();
      if (!isPlain)
        unclean += (unclean.empty() ? "" : ", ") + what;
      chosen.push_back(std::move(one));
    }
  }
  value.attachments = std::move(chosen);
  if (!value.attachments.empty())
    notes.emplace_back("attachments go along under their names; see that they show and name "
                       "nobody");
  if (!unclean.empty())
    notes.push_back("metadata is not removed from " + unclean);
}

/// When strokes were drilled, and who signed registrations and when. Their order, and that they
/// were signed, stay.
void forgetTimesAndSigners(scene::Case& value, std::vector<std::string>& notes)
{
  dissection::Dissection::Strokes strokes;
  for (const auto& stroke : value.dissection.strokes())
  {
    dissection::Stroke timeless = *stroke;
    timeless.info.startedAt.clear();
    strokes.push_back(std::make_shared<const dissection::Stroke>(std::move(timeless)));
  }
  value.dissection = dissection::Dissection(std::move(strokes), value.dissection.history());
  bool isSigned = false;
  for (scene::ImagePart& mr : value.mr)
    if (mr.registration && mr.registration->signOff)
    {
      isSigned = true;
      mr.registration->signOff->who.clear();
      mr.registration->signOff->when.clear();
    }
  if (isSigned)
    notes.emplace_back("who signed a registration, and when, stays in this library; that it was "
                       "signed goes along");
}

std::size_t noteCount(const scene::Case& value)
{
  std::size_t count = value.ct.notes.size();
  const auto add = [&count](const auto& parts)
  {
    for (const auto& part : parts)
      count += part.notes.size();
  };
  add(value.mr);
  add(value.labels);
  add(value.meshes);
  return count;
}

std::string entryOf(const ObjectUse& use, bool isCt, std::set<std::string>& used)
{
  switch (use.kind)
  {
  case ObjectUse::Kind::Image:
    return isCt ? "ct.nrrd" : "mr/" + fileName(use.name, ".nrrd", used);
  case ObjectUse::Kind::Structures:
    return "labels/" + fileName(use.name, ".seg.nrrd", used);
  case ObjectUse::Kind::Mesh:
    return "meshes/" + fileName(use.name, ".obj", used);
  case ObjectUse::Kind::Instrument:
    return "tools/" + use.name + ".obj";
  case ObjectUse::Kind::Attachment:
    return "attachments/" + fileName(use.name, "", used);
  case ObjectUse::Kind::Stroke:
    break;
  }
  const std::string number = std::to_string(std::stoul(use.name));
  return "strokes/" + std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number +
         ".stroke";
}

} // namespace

bool takesAlong(const ArchiveOptions& options, const scene::Attachment& attachment) noexcept
{
  using Kind = scene::Attachment::Kind;
  switch (attachment.kind)
  {
  case Kind::Video:
    return options.withVideos && !options.planOnly;
  case Kind::Document:
    return options.withDocuments && !options.planOnly;
  case Kind::Recording:
  case Kind::Screenshot:
    break;
  }
  return !options.planOnly || attachment.bytes <= kLargestOfPlan;
}

std::string toText(const ArchiveIndex& index)
{
  nlohmann::json objects = nlohmann::json::array();
  for (const ArchiveIndex::Object& one : index.objects)
    objects.push_back(
        {{"object", one.object}, {"file", one.file}, {"bytes", one.bytes}, {"packed", one.packed}});
  nlohmann::json all = {{"petrous_archive", kArchiveFormat}, {"case", index.name},
                        {"plan_only", index.planOnly},       {"manifest_sha256", index.manifest},
                        {"library_sha256", index.library},   {"objects", std::move(objects)}};
  if (!index.thumbnail.empty())
  {
    std::string text(
        sodium_base64_ENCODED_LEN(index.thumbnail.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
    sodium_bin2base64(text.data(), text.size(), index.thumbnail.data(), index.thumbnail.size(),
                      sodium_base64_VARIANT_ORIGINAL);
    text.pop_back(); // the zero at its end
    all["thumbnail_png"] = text;
  }
  return all.dump(1) + "\n";
}

ArchiveSummary archiveCase(const Library& library, const std::string& name, const fs::path& file,
                           const ArchiveOptions& options, const core::Progress& progress)
try
{
  if (options.level && (*options.level < 1 || *options.level > 12))
    throw core::InvalidParameter("archive: the level of compression is 1 to 12");
  refuseOverwriting(file, library.folder());
  scene::Case value = library.open(name); // recovers unsaved drilling
  ArchiveSummary summary;
  const bool isPrepared = !options.planOnly && options.prepare;
  if (isPrepared)
    summary.notes = options.prepare(value, progress.part(0.0, 0.3));
  const auto salt = [salted = frameSalter(library)](scene::ImagePart& image)
  {
    scene::saltIdentity(image, salted); // older manifests have plain hashes
  };
  salt(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), salt);
  const ObjectStore kept(library.folder() / "objects");
  ArchiveStaging passing(file);
  if (!options.planOnly)
    for (scene::LabelPart& part : value.labels)
    {
      progress.check("archiving");
      const std::string what = "structures of case '" + name + "'";
      if (const auto shown = asShown(part, kept.path(part.object, what), what))
        part.object = passing.store().add("seg.nrrd", [&shown](const fs::path& path)
                                          { imaging::writeLabelFile(path, *shown); });
    }
  if (isPrepared)
  {
    const auto store = [&](scene::ImagePart& image)
    {
      if (image.object.empty())
        image.object = passing.store().add("nrrd", [&](const fs::path& path)
                                           { imaging::writeRawNrrd(path, *image.volume.get()); });
    };
    store(value.ct);
    std::for_each(value.mr.begin(), value.mr.end(), store);
  }
  Description& description = value.description;
  if (!description.date.empty() && !options.keepIdentity)
  {
    description.date.clear();
    summary.notes.emplace_back("the planned date stays in this library");
  }
  if (!options.keepIdentity)
    forgetTimesAndSigners(value, summary.notes);
  if (!description.note.empty() && options.withoutNotes)
  {
    description.note.clear();
    summary.notes.emplace_back("the note stays in this library");
  }
  else if (!description.note.empty())
    summary.notes.emplace_back("the note goes along as it was typed; see that it names nobody");
  chooseInstrument(value, kept, summary.notes, progress.part(0.0, 0.0));
  chooseAttachments(value, library, options, passing, summary.notes, progress.part(0.0, 0.0));
  const std::size_t before = noteCount(value);
  scene::forgetGoneNames(value);
  if (const std::size_t left = before - noteCount(value); left > 0)
    summary.notes.push_back(
        std::to_string(left) +
        (left == 1 ? " note on the import names" : " notes on the import name") +
        " what the case does not have, or calls otherwise by now, and " +
        (left == 1 ? "stays" : "stay") + " in this library");
  sealIdentity(library, value);
  const std::string manifest = scene::toManifest(value);
  const auto storeOf = [&](const std::string& object) -> const ObjectStore&
  { return passing.store().contains(object) ? passing.store() : kept; };

  summary.name = name;
  summary.planOnly = options.planOnly;
  ArchiveIndex index;
  index.name = name;
  index.planOnly = options.planOnly;
  index.manifest =
      sha256Of(reinterpret_cast<const std::uint8_t*>(manifest.data()), manifest.size());
  index.library = saltedFrame(library, archiveMark(index.manifest));
  if (!options.planOnly && !isPrepared)
    index.thumbnail = readThumbnail(library.folder(), value.id);
  std::set<std::string> used;
  std::vector<ObjectUse> uses = objectsOf(value);
  std::vector<const ObjectUse*> stored;
  for (ObjectUse& use : uses)
  {
    if (options.planOnly && !isOfPlan(use))
      continue;
    if (options.planOnly && use.isInstrument) // a plan has no meshes
    {
      use.kind = ObjectUse::Kind::Instrument;
      use.name = "instrument";
    }
    const fs::path path = storeOf(use.object).path(use.object, textOf(use, name));
    const std::uintmax_t bytes = core::InputFile(path).size();
    index.objects.push_back({use.object, entryOf(use, &use == &uses.front(), used), bytes,
                             use.kind == ObjectUse::Kind::Image});
    stored.push_back(&use);
    summary.inputBytes += bytes;
  }
  summary.parts = stored.size();

  ZipWriter zip(file, passing.folder());
  const auto bytesOf = [](const std::string& text)
  { return std::vector<std::uint8_t>(text.begin(), text.end()); };
  zip.add(kIndexEntry, true, [bytes = bytesOf(toText(index))] { return fromMemory(bytes); });
  zip.add(kManifestEntry, true, [bytes = bytesOf(manifest)] { return fromMemory(bytes); });
  for (std::size_t n = 0; n < stored.size(); ++n)
  {
    const ObjectUse& use = *stored[n];
    const ObjectText what = textOf(use, name);
    if (use.kind == ObjectUse::Kind::Image)
      zip.add(index.objects[n].file, false,
              [path = storeOf(use.object).path(use.object, what), what,
               level = options.level]() -> Produce
              {
                auto image = std::make_shared<PackedImage>(path, what, level);
                return [image](char* buffer, std::size_t room)
                { return image->produce(buffer, room); };
              });
    else if (use.kind == ObjectUse::Kind::Attachment)
      zip.add(index.objects[n].file, false,
              [path = storeOf(use.object).path(use.object, what), what]
              { return fromObject(path, what); });
    else
      zip.add(index.objects[n].file,
              use.kind == ObjectUse::Kind::Mesh || use.kind == ObjectUse::Kind::Instrument,
              [&store = storeOf(use.object), object = use.object, what]
              { return fromMemory(store.readChecked(object, what)); });
  }
  summary.durable = zip.commit(isPrepared ? progress.part(0.3, 1.0) : progress);
  summary.archiveBytes = fs::file_size(file);
  return summary;
}
catch (const core::InputFileError& error)
{
  throw libraryError(error);
}

} // namespace petrous::library
