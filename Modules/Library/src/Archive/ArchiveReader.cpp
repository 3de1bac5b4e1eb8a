#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <future>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>
#include <sodium.h>

#include "ArchiveIndex.h"
#include "AttachmentFiles.h"
#include "GzipMembers.h"
#include "LibraryFolder.h"
#include "ManifestFile.h"
#include "Sha256.h"
#include "Thumbnail.h"
#include "ZipEntries.h"
#include "petrous/Dissection/StrokeCodec.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Imaging/PatientKey.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/GoneNames.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/RemoveMr.h"

namespace petrous::library
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;

namespace
{

constexpr std::uint64_t kLargestIndex = 64U << 20;
constexpr std::uint64_t kLargestManifest = 256U << 20;
constexpr std::size_t kLongestHeader = 1U << 20;
constexpr std::size_t kBatch = 8; // members unpacked at once, 32 MiB, while as many are written
constexpr std::uint64_t kBlock = 1U << 20;

/// Whether a name is that of an object whose content can be what `use` needs.
bool fits(const std::string& object, const ObjectUse& use)
{
  constexpr std::size_t kDigits = 64;
  const auto hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (object.size() <= kDigits || !std::all_of(object.begin(), object.begin() + kDigits, hex))
    return false;
  const std::string ending = object.substr(kDigits);
  switch (use.kind)
  {
  case ObjectUse::Kind::Image:
    return ending == ".nrrd";
  case ObjectUse::Kind::Structures:
    return ending == ".seg.nrrd";
  case ObjectUse::Kind::Mesh:
  case ObjectUse::Kind::Instrument:
    return ending == ".obj";
  case ObjectUse::Kind::Stroke:
    return ending == ".stroke";
  case ObjectUse::Kind::Attachment:
    return ending.size() <= 9 && ending[0] == '.' &&
           ending.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789", 1) == ending.npos;
  }
  return false;
}

/// Text of JSON that would take far more memory than any case needs once it is parsed.
void refuseBloated(const fs::path& path, std::string_view text, const char* entry)
{
  constexpr std::size_t kMostValues = 4'000'000; // some 50 for a stroke
  std::size_t values = 0;
  bool isInText = false;
  for (std::size_t n = 0; n < text.size(); ++n)
    if (isInText && text[n] == '\\')
      ++n;
    else if (text[n] == '"')
      isInText = !isInText;
    else if (!isInText && (text[n] == ',' || text[n] == '[' || text[n] == '{'))
      ++values;
  if (values > kMostValues)
    throwUnsound(path, std::string("'") + entry + "' holds more than " +
                           std::to_string(kMostValues) + " values");
}

/// What the manifest says of the parts can be so, whatever their objects are.
void checkSense(const scene::Case& value, const fs::path& path)
{
  constexpr double kLargest = 1e9; // of intensities
  const auto isSensible = [](double number) { return std::abs(number) <= kLargest; };
  if (!isSensible(value.iso) || !isSensible(value.denseBone))
    throwUnsound(path, "its threshold of bone is no intensity");
  if (const auto& soft = value.softTissueValues;
      soft && !(isSensible(soft->foot) && isSensible(soft->peak)))
    throwUnsound(path, "its values of soft tissue are no intensities");
  std::set<std::string> images, structures, meshes;
  const auto checkRange = [&](const scene::ImagePart& image)
  {
    if (!(image.range.min <= image.range.max))
      throwUnsound(path, "an image's least intensity is above its largest");
  };
  checkRange(value.ct);
  for (const scene::ImagePart& mr : value.mr)
  {
    checkRange(mr);
    if (!images.insert(mr.name).second)
      throwUnsound(path, "it has two MRs of one name");
  }
  const auto checkDrawnOn = [&](const std::string& mr)
  {
    if (!mr.empty() && images.count(mr) == 0)
      throwUnsound(path, "a part was drawn on an MR that it does not have");
  };
  for (const scene::LabelPart& part : value.labels)
  {
    checkDrawnOn(part.drawnOn.value_or(std::string()));
    std::set<std::uint16_t> indices;
    for (const scene::StructurePart& structure : part.structures)
    {
      if (!structures.insert(structure.name).second)
        throwUnsound(path, "it has two structures of one name");
      if (structure.index == 0 || !indices.insert(structure.index).second)
        throwUnsound(path, "two of its structures have one label, or one has none");
    }
  }
  for (const scene::MeshPart& mesh : value.meshes)
  {
    checkDrawnOn(mesh.drawnOn);
    if (!meshes.insert(mesh.name).second)
      throwUnsound(path, "it has two meshes of one name");
  }
}

/// Numbers and words of the manifest that no program writes, and that reading it bends to what a
/// case can hold.
void checkWritten(const nlohmann::json& manifest, const fs::path& path)
{
  using nlohmann::json;
  constexpr double kFarthest = 1e6; // mm, from the origin of one image's patient space to another's
  constexpr double kRounding = 1e-6;
  const auto has = [](const json& numbers, std::size_t count)
  { return numbers.is_array() && numbers.size() == count; };
  const auto checkPose = [&](const json& pose)
  {
    const json& quaternion = pose.at("quaternion_wxyz");
    const json& translation = pose.at("translation_mm");
    const auto addSquare = [](double sum, const json& one)
    { return sum + one.get<double>() * one.get<double>(); };
    if (!has(quaternion, 4) ||
        !(std::abs(std::accumulate(quaternion.begin(), quaternion.end(), 0.0, addSquare) - 1.0) <=
          kRounding))
      throwUnsound(path, "the rotation of an MR is not a unit quaternion");
    const auto isNear = [](const json& one) { return std::abs(one.get<double>()) <= kFarthest; };
    if (!has(translation, 3) || !std::all_of(translation.begin(), translation.end(), isNear))
      throwUnsound(path, "an MR is moved by more than 1 km");
  };
  const auto checkImage = [&](const json& image)
  {
    const json& grid = image.at("grid");
    if (!has(grid.at("dims"), 3) || !has(grid.at("spacing_mm"), 3) ||
        !has(grid.at("origin_mm"), 3) || !has(grid.at("direction"), 9))
      throwUnsound(path, "an image has a grid of more than three axes");
    const std::string modality = image.value("modality", std::string());
    if (!modality.empty() && modality != "CT" && modality != "MR")
      throwUnsound(path, "an image is of an unknown modality");
  };
  checkImage(manifest.at("ct"));
  for (const json& mr : manifest.at("mr"))
  {
    checkImage(mr);
    checkPose(mr.at("mr_from_ct"));
    if (mr.contains("registration") && mr.at("registration").contains("signed_off"))
      checkPose(mr.at("registration").at("signed_off").at("mr_from_ct"));
  }
}

scene::Case caseIn(const std::string& manifest, const fs::path& path)
{
  try
  {
    return scene::fromManifest(manifest, kManifestEntry);
  }
  catch (const scene::ManifestError& error)
  {
    using Reason = scene::ManifestError::Reason;
    if (error.reason == Reason::NewerFormat)
      throw scene::ManifestError(error.reason, core::printable(path) + ": " + error.what());
    throwUnsound(path, error.what());
  }
}

/// An archive whose directory, index and manifest are sound and agree.
struct Archive
{
  explicit Archive(const fs::path& path)
    : file(path)
    , zip(path)
    , index(archiveIndex(zip.text(kIndexEntry, kLargestIndex), path))
  {
    const std::string text = zip.text(kManifestEntry, kLargestManifest);
    if (sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()) != index.manifest)
      throwUnsound(path, std::string("'") + kManifestEntry + "' is not what its hash says");
    refuseBloated(path, text, kManifestEntry);
    value = caseIn(text, path);
    try
    {
      scene::checkCaseName(index.name);
      const std::vector<std::string> names = scene::partNames(value);
      std::for_each(names.begin() + 1, names.end(), scene::checkPartName); // after the CT's own
    }
    catch (const core::InvalidParameter&)
    {
      throwUnsound(path, "it has a name that is not a valid one");
    }
    if (value.ct.name != "ct")
      throwUnsound(path, "it has a name that is not a valid one");
    checkWritten(nlohmann::json::parse(text), path);
    checkSense(value, path);
    scene::forgetGoneReferences(value); // older programs kept them

    std::set<std::string> listed{kIndexEntry, kManifestEntry};
    for (const ArchiveIndex::Object& one : index.objects)
    {
      const auto entry = zip.entries().find(one.file);
      if (entry == zip.entries().end())
        throwUnsound(path, "it lacks '" + one.file + "'");
      if (!listed.insert(one.file).second || !objects.emplace(one.object, &one).second)
        throwUnsound(path, "it lists '" + one.file + "' twice");
      // Packed voxels may be 1032 times their entry's size, and no more.
      if (one.packed ? one.bytes / 1032 > entry->second.bytes + 4096
                     : one.bytes != entry->second.bytes)
        throwUnsound(path, "'" + one.file + "' cannot have the size that is stated");
      bytes += one.bytes;
      if (bytes < one.bytes)
        throwUnsound(path, "it states impossible sizes");
    }
    for (const auto& [name, entry] : zip.entries())
      if (listed.count(name) == 0)
        throwUnsound(path, "'" + name + "' is not listed in it");
    for (const scene::Attachment& one : value.attachments)
      if (!one.link.empty()) // this program writes none
        throwUnsound(path, "an attachment is a link to a file of another computer");
    for (const ObjectUse& use : objectsOf(value))
    {
      if (!fits(use.object, use))
        throwUnsound(path, use.what + " has no valid name of an object");
      if (objects.count(use.object) == 0 && (!index.planOnly || isOfPlan(use)))
        throwUnsound(path, "it lacks " + use.what);
      needed.insert(use.object);
    }
    for (const auto& [object, one] : objects)
      if (needed.count(object) == 0)
        throwUnsound(path, "'" + one->file + "' belongs to nothing in the case");
  }

  fs::path file;
  ZipReader zip;
  ArchiveIndex index;
  scene::Case value; ///< without voxels
  std::map<std::string, const ArchiveIndex::Object*> objects;
  std::set<std::string> needed;
  std::uint64_t bytes = 0; ///< of all objects, unpacked
};

/// Gets the bytes of an object, piece by piece.
using Take = std::function<void(const char* bytes, std::size_t count)>;

/// Gives an entry as it is to `take`, at most `bytes` bytes: what is stated may be less than what
/// it unpacks to, and its checksum is known only at its end. Returns their SHA-256.
std::string readEntry(ZipReader::Stream& in, const Take& take, std::uint64_t bytes,
                      const fs::path& file, const std::string& entry,
                      const core::Progress& progress)
{
  std::vector<char> block(kBlock);
  Sha256 hash;
  std::uint64_t done = 0;
  for (std::size_t got = block.size(); got == block.size(); done += got)
  {
    progress.check("restoring");
    got = in.read(block.data(), block.size());
    if (got > bytes - done)
      throwUnsound(file, "'" + entry + "' is larger than stated");
    hash.add(block.data(), got);
    take(block.data(), got);
  }
  return hash.hexadecimal();
}

/// The same of the NRRD that was packed (PackedImage in ArchiveWriter.cpp). `take` may be called in
/// another thread.
std::string unpackImage(ZipReader::Stream& in, const Take& take, std::uint64_t bytes,
                        const fs::path& file, const std::string& entry,
                        const core::Progress& progress)
{
  const std::string damaged = "'" + entry + "' is damaged";
  std::string head;
  std::size_t end = head.npos;
  while (end == head.npos && head.size() < kLongestHeader)
  {
    char block[4096];
    const std::size_t got = in.read(block, sizeof block);
    head.append(block, got);
    end = head.find("\n\n");
    if (got < sizeof block)
      break;
  }
  constexpr std::string_view kGzip = "\nencoding: gzip\n";
  const std::size_t encoding = head.find(kGzip);
  if (end == head.npos || encoding == head.npos || encoding > end)
    throwUnsound(file, damaged);
  std::string packed = head.substr(end + 2);
  head.resize(end + 2);
  head.replace(encoding, kGzip.size(), "\nencoding: raw\n");
  Sha256 hash;
  std::uint64_t written = 0;
  const auto write = [&take, &hash](const char* from, std::size_t count)
  {
    take(from, count);
    hash.add(from, count);
  };
  write(head.data(), head.size());
  written += head.size();

  std::array<std::vector<char>, 2> buffers; // one is filled while the other is written
  std::future<void> writing;                // after them: it uses one
  std::size_t turn = 0;
  for (bool more = true; more; turn = 1 - turn)
  {
    progress.report(static_cast<double>(written) /
                        static_cast<double>(std::max<std::uint64_t>(bytes, 1)),
                    "restoring");
    std::vector<std::size_t> ends; // of whole members in `packed`
    for (std::size_t at = 0; ends.size() < kBatch;)
    {
      const auto need = [&](std::size_t count)
      {
        if (packed.size() - at >= count)
          return true;
        const std::size_t had = packed.size();
        packed.resize(at + count);
        const std::size_t got = in.read(packed.data() + had, packed.size() - had);
        packed.resize(had + got);
        return packed.size() - at >= count;
      };
      if (!need(kMemberHead))
      {
        more = false;
        if (packed.size() != at)
          throwUnsound(file, damaged);
        break;
      }
      const std::size_t length = memberLength(packed.data() + at);
      if (length == 0 || !need(length))
        throwUnsound(file, damaged);
      at += length;
      ends.push_back(at);
    }
    std::vector<std::string_view> members;
    std::size_t from = 0;
    for (const std::size_t to : ends)
    {
      members.push_back(std::string_view(packed).substr(from, to - from));
      from = to;
    }
    std::vector<char>& raw = buffers[turn];
    if (!unpackMembers(members, raw))
      throwUnsound(file, damaged);
    written += raw.size();
    if (written > bytes)
      throwUnsound(file, "'" + entry + "' is larger than stated");
    packed.erase(0, from);
    if (writing.valid())
      writing.get();
    writing = std::async(std::launch::async, [&write, &raw] { write(raw.data(), raw.size()); });
  }
  writing.get();
  return hash.hexadecimal();
}

/// Adds the objects that the store lacks; returns their number. Each is read and hashed, those that
/// the store has too: a damaged archive is told of where it was made, and not first where it is
/// the only copy.
std::size_t addObjects(const Archive& archive, ObjectStore& store, const core::Progress& progress)
{
  std::size_t added = 0;
  std::uint64_t done = 0;
  for (const auto& [object, one] : archive.objects)
  {
    const double from =
        static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(archive.bytes, 1));
    done += one->bytes;
    const core::Progress part =
        progress.part(from, static_cast<double>(done) /
                                static_cast<double>(std::max<std::uint64_t>(archive.bytes, 1)));
    part.report(0.0, "restoring");
    bool isSound = false; // here; else replaced by the archive's
    if (store.contains(object))
      try
      {
        checkObject(store.path(object), {"an object"}, part);
        isSound = true;
      }
      catch (const LibraryError&)
      {
      }
    const auto read = [&, one = one](const Take& take)
    {
      ZipReader::Stream in = archive.zip.open(one->file);
      return one->packed ? unpackImage(in, take, one->bytes, archive.file, one->file, part)
                         : readEntry(in, take, one->bytes, archive.file, one->file, part);
    };
    constexpr std::size_t kDigits = 64;
    const std::string ending = object.substr(kDigits); // with its dot
    const std::string name =
        isSound ? read([](const char*, std::size_t) {}) + ending
                : store.addHashed(ending.substr(1),
                                  [&read](const fs::path& path)
                                  {
                                    core::OutputFile out(path);
                                    std::string hash = read(
                                        [&out](const char* bytes, std::size_t count)
                                        {
                                          out.write(bytes, count);
                                          out.startSync();
                                        });
                                    out.commit();
                                    return hash;
                                  });
    if (name != object)
      throwUnsound(archive.file, "'" + one->file + "' is not what its hash says");
    added += isSound ? 0 : 1;
  }
  return added;
}

void refuseWithoutRoom(const fs::path& folder, const Archive& archive, const ObjectStore& present)
{
  std::uint64_t bytes = 0;
  for (const auto& [object, one] : archive.objects)
    bytes += present.contains(object) ? 0 : one->bytes;
  fs::path place = folder;
  std::error_code error;
  while (!fs::exists(place, error) && place.has_parent_path() && place != place.parent_path())
    place = place.parent_path();
  const fs::space_info space = fs::space(place, error);
  constexpr std::uint64_t kReserve = 16U << 20;
  if (!error && (space.available < kReserve || space.available - kReserve < bytes))
    throw LibraryError(Reason::DiskFull, core::printable(folder) + ": the case needs " +
                                             std::to_string((bytes >> 20) + 1) + " MB, " +
                                             std::to_string(space.available >> 20) +
                                             " MB are free; nothing was restored; free some space");
}

/// What the manifest says of the images is so by their voxels: everything is placed and shown by
/// it.
void checkImages(const scene::Case& value, const ObjectStore& store, const fs::path& file,
                 const core::Progress& progress)
{
  if (const auto misplaced = misplacedImages(value, store); !misplaced.empty())
    throwUnsound(file, misplaced.front().what + " does not lie where its voxels say");
  const auto checkRange = [&](const scene::ImagePart& image)
  {
    progress.check("restoring");
    try
    {
      const volume::ValueRange range = imaging::mapRawNrrd(store.path(image.object))->range();
      if (range.min != image.range.min || range.max != image.range.max)
        throwUnsound(file, "an image has not the intensities that are stated");
    }
    catch (const imaging::FileError&)
    {
      throwUnsound(file, "an image cannot be read");
    }
  };
  checkRange(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), checkRange);
}

/// The sizes that are stated of structures are replaced by those of their voxels where they differ;
/// `corrected` then gets their names.
void checkLabels(scene::LabelPart& part, const fs::path& object, const fs::path& file,
                 std::vector<std::string>& corrected, const core::Progress& progress)
{
  const volume::LabelMap map = imaging::readLabelFile(object, progress);
  const auto voxels = static_cast<std::uint64_t>(map.voxels->size());
  constexpr double kRounding = 1e-6;
  const double largest =
      map.voxels->geometry().voxelVolume() * static_cast<double>(voxels) * (1.0 + kRounding);
  for (scene::StructurePart& structure : part.structures)
  {
    const auto segment = std::find_if(map.segments.begin(), map.segments.end(),
                                      [&structure](const volume::Segment& one)
                                      { return one.index == structure.index; });
    if (segment == map.segments.end())
      throwUnsound(file, "a structure is not in its label map");
    if (structure.voxels > voxels || !(structure.volume >= 0.0 && structure.volume <= largest))
      throwUnsound(file, "a structure is larger than its label map");
    const double volume = map.volume(*segment);
    if (structure.voxels == segment->voxels &&
        std::abs(structure.volume - volume) <= kRounding * volume)
      continue;
    structure.voxels = segment->voxels;
    structure.volume = volume;
    corrected.push_back(structure.name);
  }
}

/// The volumes that are stated of a stroke were measured at the threshold of bone of then, and are
/// kept. None can be larger than the cells around the voxels that it removed from.
void checkRemoved(const dissection::StrokeInfo& info, dissection::BrickDraft& alone,
                  const fs::path& file)
{
  std::size_t voxels = 0;
  for (const dissection::BrickDelta& delta : alone.take())
    if (delta.after)
      voxels += static_cast<std::size_t>(
          std::count_if(delta.after->begin(), delta.after->end(),
                        [](std::uint16_t left) { return left != volume::CutMask::kUntouched; }));
  constexpr double kCells = 8.0; // around a voxel
  constexpr double kRounding = 1e-6;
  const double largest =
      kCells * alone.mask().geometry().voxelVolume() * static_cast<double>(voxels) + kRounding;
  const auto isPossible = [largest](double volume)
  { return volume >= -kRounding && volume <= largest; };
  if (!isPossible(info.removed) ||
      !std::all_of(info.structures.begin(), info.structures.end(),
                   [&](const dissection::TouchedStructure& one) { return isPossible(one.volume); }))
    throwUnsound(file, "a stroke removed more than its voxels hold");
}

/// Each object is what the manifest says that it is, not only to its hash: what made the archive
/// may have been another program. Counts and volumes that are not those of the voxels and meshes
/// are replaced by these; returns a note for the user of each kind.
std::vector<std::string> checkContents(scene::Case& value, const ObjectStore& store,
                                       const fs::path& file, const core::Progress& progress)
{
  std::vector<std::string> structures, meshes; // by their names, whose numbers were replaced
  const auto check = [&](const std::string& what, const auto& read)
  {
    progress.check("restoring");
    try
    {
      read();
    }
    catch (const core::CancelledError&)
    {
      throw;
    }
    catch (const LibraryError&)
    {
      throw;
    }
    catch (const core::Error&)
    {
      throwUnsound(file, what);
    }
  };
  for (scene::LabelPart& part : value.labels)
    check("a label map cannot be read",
          [&] { checkLabels(part, store.path(part.object), file, structures, progress); });
  for (scene::MeshPart& mesh : value.meshes)
    check("a mesh cannot be read",
          [&]
          {
            const std::size_t triangles =
                imaging::readMesh(store.path(mesh.object)).triangles.size();
            if (std::exchange(mesh.triangles, triangles) != triangles)
              meshes.push_back(mesh.name);
          });
  if (value.view.instrument)
    check("an instrument cannot be read",
          [&] { imaging::readMesh(store.path(value.view.instrument->object)); });
  const volume::CutMask untouched(value.ct.geometry);
  volume::CutMask applied = untouched;
  dissection::BrickDraft draft(applied);
  const auto& strokes = value.dissection.strokes();
  const auto& history = value.dissection.history();
  const auto line = history.lineTo(history.position());
  for (std::size_t n = 0; n < strokes.size(); ++n)
    check("what a stroke removed cannot be read",
          [&]
          {
            dissection::BrickDraft alone(untouched);
            dissection::applyDeltas(store.readChecked(strokes[n]->object, {"a stroke"}),
                                    dissection::Step::Redo, alone);
            checkRemoved(strokes[n]->info, alone, file);
          });
  for (const std::size_t n : line)
    check("a stroke removes what was removed before",
          [&]
          {
            dissection::applyDeltas(store.readChecked(strokes[n]->object, {"a stroke"}),
                                    dissection::Step::Redo, draft);
          });
  for (const scene::Attachment& one : value.attachments)
  {
    const fs::path object = store.path(one.object);
    if (!isOfKind(object, one.kind) || fs::file_size(object) != one.bytes)
      throwUnsound(file, "an attachment is not of the kind or size that is stated");
  }
  std::vector<std::string> notes;
  if (!structures.empty())
    notes.push_back("the archive states another number of voxels, or another volume, of " +
                    scene::listed(structures) +
                    " than the label map has; they were computed from its voxels");
  if (!meshes.empty())
    notes.push_back("the archive states another number of triangles of " + scene::listed(meshes) +
                    " than the mesh has; they were counted");
  return notes;
}

std::vector<std::uint8_t> thumbnailFrom(const std::string& base64, const fs::path& file)
{
  std::vector<std::uint8_t> png(kLargestThumbnail);
  std::size_t bytes = 0;
  const char* end = nullptr;
  if (sodium_base642bin(png.data(), png.size(), base64.data(), base64.size(), nullptr, &bytes, &end,
                        sodium_base64_VARIANT_ORIGINAL) != 0 ||
      end != base64.data() + base64.size())
    bytes = 0;
  png.resize(bytes);
  if (!isThumbnail(png))
    throwUnsound(file, "its thumbnail is not one");
  return png;
}

constexpr const char* kLeftOut = ": left out, since a plan brings no voxels; add it to the case";

/// One of the `lost` MRs on which a map was drawn; of an older case, which does not state it, or
/// may have been, by its grid. Empty: none.
std::string lostMrOf(const scene::Case& value, const scene::LabelPart& part,
                     const std::set<std::string>& lost, const ObjectStore& store)
{
  if (part.drawnOn)
    return lost.count(*part.drawnOn) > 0 ? *part.drawnOn : std::string();
  if (lost.empty())
    return {};
  try
  {
    const volume::LabelMap map = imaging::readLabelFile(store.path(part.object));
    for (const std::string& mr : scene::mrWithGrid(value, map.voxels->geometry()))
      if (lost.count(mr) > 0)
        return mr;
  }
  catch (const core::Error&) // told where all of the library's are checked
  {
  }
  return {};
}

/// Takes from the case of a plan what the library does not have; returns a note for each part.
std::vector<std::string> leaveOutMissing(scene::Case& value, const ObjectStore& store)
{
  std::vector<std::string> notes;
  std::set<std::string> lost; // MRs
  for (const auto& mr : value.mr)
    if (!store.contains(mr.object))
    {
      lost.insert(mr.name);
      notes.push_back("MR '" + mr.name + "'" + kLeftOut);
    }
  const auto withMr = [&notes](const std::string& what, const std::string& mr)
  {
    if (!mr.empty())
      notes.push_back(what + ": left out with MR '" + mr +
                      "', on which it was drawn; add both to the case");
    return !mr.empty();
  };
  const auto missing = [&](const std::string& object, const std::string& what)
  {
    if (store.contains(object))
      return false;
    notes.push_back(what + kLeftOut);
    return true;
  };
  for (auto part = value.labels.begin(); part != value.labels.end();)
  {
    std::string names;
    for (const auto& structure : part->structures)
      names += (names.empty() ? "'" : ", '") + structure.name + "'";
    const std::string what = "structures " + names;
    part = missing(part->object, what) || withMr(what, lostMrOf(value, *part, lost, store))
               ? value.labels.erase(part)
               : part + 1;
  }
  for (auto mesh = value.meshes.begin(); mesh != value.meshes.end();)
  {
    const std::string what = "mesh '" + mesh->name + "'";
    const std::string mr = lost.count(mesh->drawnOn) > 0 ? mesh->drawnOn : std::string();
    mesh = missing(mesh->object, what) || withMr(what, mr) ? value.meshes.erase(mesh) : mesh + 1;
  }
  for (const std::string& name : lost)
    scene::removeMr(value, name);
  return notes;
}

bool statesPatient(const scene::ImagePart& image)
{
  return !image.patient.empty() || !image.patient.nameParts.empty();
}

/// Of images whose hashes have one salt. Two spellings of a name, of one ID, are one patient's.
bool isOfOtherPatient(const scene::PatientHash& a, const scene::PatientHash& b)
{
  if (a.empty() && b.empty()) // pseudonyms of cases (imaging/CasePatient.h), or nothing
    return !a.nameParts.empty() && !b.nameParts.empty() && a.nameParts != b.nameParts;
  const imaging::PatientDifferences differing = imaging::differencesOf(a, b);
  return differing.id || (differing.any() && (a.id.empty() || b.id.empty() || a.id != b.id));
}

/// A plan fits every CT of these voxels, whosever it is said to be. `plan`: its image; hashes
/// of another library cannot be compared. `only`: the case whose CT the user named; empty: all of
/// the library.
std::string patientNote(const Library& library, scene::ImagePart plan, const std::string& only)
{
  const scene::IdentitySalt salt = frameSalter(library);
  // Plain hashes, of older programs, are those of any library.
  const bool isKnown = statesPatient(plan) && scene::isComparable(plan, salt);
  if (isKnown)
    scene::saltIdentity(plan, salt);
  const fs::path cases = library.folder() / "cases";
  std::string other;
  for (const std::string& name : only.empty() ? namesIn(cases) : std::vector<std::string>{only})
    try
    {
      scene::ImagePart ct = manifestIn(cases / (name + ".json"), name).ct;
      if (ct.object != plan.object || !statesPatient(ct) || !scene::isComparable(ct, salt))
        continue;
      scene::saltIdentity(ct, salt);
      if (isKnown && !isOfOtherPatient(plan.patient, ct.patient))
        return {};
      other = name;
    }
    catch (const core::Error&) // told where it is opened
    {
    }
  if (other.empty())
    return {};
  return isKnown
             ? "the plan is of another patient than that of case '" + other +
                   "', whose image has the very same voxels, by what their files state; it fits, "
                   "but make sure whose images these are"
             : "whether the plan is of the patient of case '" + other +
                   "', whose image has the very same voxels, cannot be told, as it comes from "
                   "another library; make sure that it is";
}

} // namespace

ArchiveIndex archiveIndex(std::string_view text, const fs::path& file)
{
  ArchiveIndex index;
  try
  {
    refuseBloated(file, text, kIndexEntry);
    const nlohmann::json all = nlohmann::json::parse(text);
    const auto format = all.at("petrous_archive").get<std::int64_t>();
    if (format > kArchiveFormat)
      throw LibraryError(Reason::Damaged, core::printable(file) +
                                              ": was written by a newer version "
                                              "of this program; update it");
    if (format < 1)
      throwUnsound(file, "its format is unknown");
    index.name = all.at("case").get<std::string>();
    index.planOnly = all.at("plan_only").get<bool>();
    index.manifest = all.at("manifest_sha256").get<std::string>();
    index.library = all.at("library_sha256").get<std::string>();
    for (const nlohmann::json& one : all.at("objects"))
      index.objects.push_back({one.at("object").get<std::string>(),
                               one.at("file").get<std::string>(),
                               one.at("bytes").get<std::uint64_t>(), one.at("packed").get<bool>()});
    if (all.contains("thumbnail_png"))
      index.thumbnail = thumbnailFrom(all.at("thumbnail_png").get<std::string>(), file);
  }
  catch (const nlohmann::json::exception&)
  {
    throwUnsound(file, std::string("'") + kIndexEntry + "' cannot be read");
  }
  return index;
}

ArchiveSummary inspectArchive(const fs::path& file)
{
  const Archive archive(file);
  ArchiveSummary summary;
  summary.name = archive.index.name;
  summary.parts = archive.objects.size();
  summary.inputBytes = archive.bytes;
  summary.archiveBytes = fs::file_size(file);
  summary.planOnly = archive.index.planOnly;
  return summary;
}

RestoreSummary restoreCase(Library& library, const fs::path& file, const RestoreOptions& options,
                           const core::Progress& progress)
{
  Archive archive(file);
  scene::Case value = std::move(archive.value);
  value.name = options.name.empty() ? archive.index.name : options.name;
  value.id.clear();
  value.revision = 0;
  scene::checkCaseName(value.name);
  if (const std::string taken = caseLike(library.folder(), value.name); !taken.empty())
    throw LibraryError(Reason::NameTaken, "case '" + taken + "' is there already in " +
                                              core::printable(library.folder()) +
                                              "; give the restored one another name (--as NAME)");
  const ObjectStore present(library.folder() / "objects");
  if (archive.index.planOnly)
  {
    const std::string needed = "the plan of case '" + archive.index.name + "'";
    if (!options.ct.empty() && library.open(options.ct).ct.object != value.ct.object)
      throw LibraryError(Reason::Damaged, core::printable(file) + ": " + needed +
                                              " was made on another CT than that of case '" +
                                              options.ct +
                                              "'; import the very same series, with the same "
                                              "region and repair, and give that case");
    if (!present.contains(value.ct.object))
      throw LibraryError(Reason::NotFound,
                         core::printable(file) + ": " + needed +
                             " brings no voxels, and its CT is not in this library; import the "
                             "same series into a case first, or ask for a whole archive");
  }
  else if (!options.ct.empty())
    throw core::InvalidParameter(core::printable(file) +
                                 ": has a CT of its own; --ct is for an archive of a plan");
  refuseWithoutRoom(library.folder(), archive, present);

  std::error_code error;
  const auto isMarked = [&](const std::string& mark)
  {
    return fs::is_directory(library.folder(), error) &&
           archive.index.library == saltedFrame(library, mark);
  };
  const bool isSealed = isMarked(archiveMark(archive.index.manifest));
  const bool isFrameKnown = isSealed || isMarked(kMarkOfAll);

  RestoreSummary summary;
  summary.parts = archive.objects.size();
  summary.planOnly = archive.index.planOnly;
  library.saveWith(
      value,
      [&](scene::Case& next, ObjectStore& store)
      {
        const bool isOfSomebody = statesPatient(next.ct);
        if (isSealed)
          sealIdentity(library, next);
        else if (!isFrameKnown)
          summary.notes = forgetForeignIdentity(next);
        if (archive.index.planOnly)
        {
          if (isOfSomebody)
            if (std::string note = patientNote(library, next.ct, options.ct); !note.empty())
              summary.notes.push_back(std::move(note));
          const std::string image = next.ct.modality == scene::Modality::Mr ? "the MR" : "the CT";
          checkObject(store.path(next.ct.object, image), image, progress.part(0.0, 0.5));
          const auto notes = leaveOutMissing(next, store);
          summary.notes.insert(summary.notes.end(), notes.begin(), notes.end());
          scene::forgetGoneReferences(next);
          for (const ObjectUse& use : objectsOf(next)) // of this library, beside the CT
            if (use.object != next.ct.object && archive.objects.count(use.object) == 0)
              checkObject(store.path(use.object, use.what), use.what, progress.part(0.5, 0.5));
        }
        summary.newParts = addObjects(archive, store, progress);
        checkImages(next, store, file, progress);
        for (std::string& note : checkContents(next, store, file, progress))
          summary.notes.push_back(std::move(note));
      },
      progress);
  summary.name = value.name;
  if (!archive.index.thumbnail.empty())
    try
    {
      library.setThumbnail(value.name, archive.index.thumbnail);
    }
    catch (const core::Error&) // the case is restored
    {
      summary.notes.emplace_back("its thumbnail could not be kept; check the disk");
    }
  return summary;
}

} // namespace petrous::library
