#include "LabelFolder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "FileHelpers.h"
#include "LabelNames.h"
#include "MemoryCheck.h"
#include "VoxelSource.h"
#include "petrous/Imaging/FileFormats.h"

namespace petrous::imaging
{

namespace
{

namespace fs = std::filesystem;
using LabelVolume = volume::Volume<std::uint16_t>;

constexpr std::uint64_t kMaxVoxels = std::uint64_t{1} << 31; // of all maps

/// Voxels that follow one another in memory.
struct Run
{
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// A file that may be the mask of a structure.
struct Mask
{
  fs::path path;
  std::optional<core::GridGeometry> grid;
  std::vector<Run> runs;
  std::vector<std::string> notes;
  std::string why; ///< why it is not a mask; empty: it is one
  bool isDamaged = false;
  bool isSideOpen = false; ///< LoadedLabels
  UnitDoubt unitDoubt;     ///< likewise
  std::optional<bool> assumedRas;
};

template <class T>
bool isLabel(T value)
{
  const auto number = static_cast<double>(value);
  return number >= 1.0 && number <= 65535.0 && number == std::floor(number);
}

/// Adds the voxels of a slice that begins at voxel `first`; false at a second value, or at one that
/// is not a number, which is then in `label`.
template <class T>
bool addSlice(const T* values, std::uint64_t count, std::uint64_t first, T& label,
              std::vector<Run>& runs)
{
  constexpr std::size_t kZerosAtOnce = 64;
  static constexpr std::array<T, kZerosAtOnce> kZeros{};
  for (std::uint64_t v = 0; v < count;)
  {
    if (v + kZerosAtOnce <= count && std::memcmp(values + v, kZeros.data(), sizeof kZeros) == 0)
    {
      v += kZerosAtOnce;
      continue;
    }
    if (values[v] == T{0})
    {
      ++v;
      continue;
    }
    const std::uint64_t start = v;
    if (label == T{0})
      label = values[v];
    while (v < count && values[v] == label)
      ++v;
    if (v == start)
    {
      if (values[v] != values[v])
        label = values[v];
      return false;
    }
    if (!runs.empty() && runs.back().first + runs.back().count == first + start)
      runs.back().count += v - start;
    else
      runs.push_back({first + start, v - start});
  }
  return true;
}

void readMask(Mask& mask, const core::Progress& progress, const std::vector<ImageGrid>& images,
              const std::optional<bool>& isRas, const std::optional<double>& unit)
{
  VoxelSource source(mask.path, kCutLabels);
  source.settleUnit(unit, images);
  source.settlePlacement(images);
  mask.unitDoubt = source.unitDoubt();
  mask.isSideOpen = !source.settleSide(isRas, images);
  mask.assumedRas = source.assumedRas();
  mask.grid = source.geometry();
  mask.notes = source.notes();
  if (source.components() != 1 || source.volumes() != 1)
  {
    mask.why = "holds several volumes, layers or numbers a voxel; give it by itself";
    return;
  }
  const auto& dims = source.geometry().dims();
  const std::uint64_t slice =
      static_cast<std::uint64_t>(dims[0]) * static_cast<std::uint64_t>(dims[1]);
  visitComponent(source.component(),
                 [&](auto type)
                 {
                   using T = decltype(type);
                   T label{0};
                   bool isOne = true;
                   source.forEachSlice(
                       [&](int k, const void* values)
                       {
                         isOne = addSlice(static_cast<const T*>(values), slice,
                                          slice * static_cast<std::uint64_t>(k), label, mask.runs);
                         return isOne;
                       },
                       progress);
                   if (label != label)
                     mask.why = "holds a voxel that is not a number (NaN); a mask holds 0 and one "
                                "whole number";
                   else if (!isOne)
                     mask.why = "holds more than one value (an image, or several structures, which "
                                "are given by themselves)";
                   else if (label != T{0} && !isLabel(label))
                     mask.why = "holds a value that is not a whole number from 1 to 65535";
                 });
  if (!mask.why.empty())
    mask.runs = {};
}

/// The files that may be masks, by name; tells of the others.
std::vector<Mask> candidates(const fs::path& folder, std::vector<std::string>& leftOut)
{
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().front() != '.') // hidden: of file managers
      paths.push_back(entry->path());
  if (error)
    fail(FileError::Reason::Unreadable, folder, "is a folder that cannot be listed; allow it");
  std::sort(paths.begin(), paths.end());
  // What a link leads to elsewhere is no part of the folder: neither a mask nor its voxels.
  const auto leadsOut = [root = fs::canonical(folder, error)](const fs::path& path)
  {
    std::error_code ofLink;
    if (!fs::is_symlink(fs::symlink_status(path, ofLink)))
      return false;
    const fs::path target = fs::canonical(path, ofLink);
    return !ofLink && std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first !=
                          root.end();
  };
  std::vector<std::string> linked; // base names
  for (const fs::path& path : paths)
    if (leadsOut(path))
      linked.push_back(baseName(path));
  if (!linked.empty())
    paths.erase(std::remove_if(paths.begin(), paths.end(),
                               [&](const fs::path& path)
                               {
                                 const bool isOut = std::find(linked.begin(), linked.end(),
                                                              baseName(path)) != linked.end();
                                 if (isOut)
                                   leftOut.push_back(path.filename().string() +
                                                     (leadsOut(path) ? " is" : " belongs to") +
                                                     " a link to a file outside the folder, and "
                                                     "was left out");
                                 return isOut;
                               }),
                paths.end());
  const auto hasHeader = [&paths](const fs::path& path)
  {
    return std::any_of(paths.begin(), paths.end(),
                       [&path](const fs::path& other)
                       {
                         const std::string name = lowerName(other);
                         return other != path && baseName(other) == baseName(path) &&
                                (endsWith(name, ".hdr") || endsWith(name, ".nhdr") ||
                                 endsWith(name, ".mhd"));
                       });
  };
  std::vector<Mask> masks;
  for (const fs::path& path : paths)
  {
    const std::string name = lowerName(path);
    const bool isVoxels = endsWith(name, ".img") || endsWith(name, ".raw") ||
                          endsWith(name, ".zraw") || endsWith(name, ".gz");
    if (!fs::is_regular_file(path, error))
      leftOut.push_back(path.filename().string() + " is not a file, and was left out");
    else if (isReadAs(path, kLabels) && !(endsWith(name, ".img") && hasHeader(path)))
    {
      masks.emplace_back();
      masks.back().path = path;
    }
    else if (!isVoxels || !hasHeader(path))
      leftOut.push_back(path.filename().string() + " is no " + orText(readEndings(kLabels)) +
                        " file, and was left out");
  }
  return masks;
}

bool isFree(const LabelVolume& voxels, const std::vector<Run>& runs)
{
  return std::all_of(runs.begin(), runs.end(),
                     [&voxels](const Run& run)
                     {
                       const std::uint16_t* first = voxels.data() + run.first;
                       return std::all_of(first, first + run.count,
                                          [](std::uint16_t value) { return value == 0; });
                     });
}

struct Layer
{
  std::size_t grid = 0;
  std::shared_ptr<LabelVolume> voxels;
  std::vector<volume::Segment> names;
};

} // namespace

LoadedLabels readLabelFolder(const fs::path& folder, const core::Progress& progress,
                             const std::vector<ImageGrid>& images, const std::optional<bool>& isRas,
                             const std::optional<double>& unit)
{
  progress.report(0.0, "reading labels");
  LoadedLabels loaded;
  loaded.isNamedAfterFile = true;
  std::vector<Mask> masks = candidates(folder, loaded.leftOut);
  const core::Progress reading = progress.part(0.0, 0.8);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(
      std::size_t{0}, masks.size(),
      [&](std::size_t n)
      {
        Mask& mask = masks[n];
        try
        {
          readMask(mask, reading, images, isRas, unit);
        }
        catch (const FileError& error)
        {
          const std::string text = error.what(); // "PATH: what is wrong"
          const std::string path = mask.path.string() + ": ";
          mask.why = text.compare(0, path.size(), path) == 0 ? text.substr(path.size()) : text;
          mask.isDamaged = true;
          mask.runs = {};
        }
        reading.report(static_cast<double>(++done) / static_cast<double>(masks.size()),
                       "reading labels");
      });

  std::vector<const core::GridGeometry*> grids;
  std::vector<Layer> layers;
  std::uint64_t voxels = 0;
  std::uint16_t index = 0;
  UniqueNames names; // "incus.nrrd" and "incus.nii.gz" may lie side by side
  for (const Mask& mask : masks)
    names.reserve(baseName(mask.path));
  for (Mask& mask : masks)
  {
    const std::string file = mask.path.filename().string();
    const std::string name = baseName(mask.path);
    if (mask.isDamaged) // the rest without it would look complete
      fail(FileError::Reason::Unreadable, mask.path,
           mask.why + "; copy it again, or take it out of the folder");
    if (!mask.why.empty())
    {
      loaded.leftOut.push_back(file + " was left out: it " + mask.why);
      loaded.unread.push_back({name, 0, false, "it " + mask.why});
      continue;
    }
    if (index == 65535)
      fail(FileError::Reason::Unsupported, folder, "holds more than 65535 structures");
    progress.report(0.8, "reading labels");
    volume::Segment segment;
    std::vector<std::string> renamed; // names a file, and is not to be stored
    segment.name = names.take(name, renamed);
    const char* const kAlike = "several of its files differ in their ending only; their structures "
                               "were numbered";
    if (!renamed.empty() &&
        std::find(loaded.notes.begin(), loaded.notes.end(), kAlike) == loaded.notes.end())
      loaded.notes.emplace_back(kAlike);
    segment.index = ++index;
    loaded.isSideOpen = loaded.isSideOpen || mask.isSideOpen;
    if (loaded.unitDoubt.likely.empty())
      loaded.unitDoubt = mask.unitDoubt;
    if (!loaded.assumedRas)
      loaded.assumedRas = mask.assumedRas;
    for (const std::string& note : mask.notes)
      if (std::find(loaded.notes.begin(), loaded.notes.end(), note) == loaded.notes.end())
        loaded.notes.push_back(note);
    const auto same =
        std::find_if(grids.begin(), grids.end(),
                     [&mask](const auto* grid) { return core::sameGrid(*grid, *mask.grid); });
    const auto grid = static_cast<std::size_t>(same - grids.begin());
    if (same == grids.end())
      grids.push_back(&*mask.grid);
    std::uint64_t count = 0;
    for (const Run& run : mask.runs)
      count += run.count;
    loaded.fileVolumes[segment.name] = static_cast<double>(count) * mask.grid->voxelVolume();
    auto layer = std::find_if(layers.begin(), layers.end(),
                              [&](const Layer& one)
                              { return one.grid == grid && isFree(*one.voxels, mask.runs); });
    if (layer == layers.end())
    {
      voxels += grids[grid]->voxelCount();
      if (voxels > kMaxVoxels)
        fail(FileError::Reason::Unsupported, folder,
             "holds structures that overlap, or lie on different grids, in more voxels than are "
             "read; give fewer of them at a time");
      requireMemory(folder, grids[grid]->voxelCount() * sizeof(std::uint16_t),
                    "give fewer of its files at a time");
      layers.push_back({grid, volume::makeZeroVolume<std::uint16_t>(*grids[grid]), {}});
      layer = layers.end() - 1;
    }
    for (const Run& run : mask.runs)
      std::fill_n(layer->voxels->data() + run.first, run.count, segment.index);
    layer->names.push_back(std::move(segment));
    mask.runs = {};
  }
  if (layers.empty())
  {
    std::string first = loaded.leftOut.empty() ? std::string() : "; " + loaded.leftOut.front();
    fail(FileError::Reason::Unsupported, folder,
         "is a folder without a mask, a " + orText(readEndings(kLabels)) +
             " file with one value beside 0" + first);
  }
  if (grids.size() > 1)
    loaded.notes.push_back("its structures lie on " + std::to_string(grids.size()) +
                           " different grids, and each was kept on its own");
  if (layers.size() > grids.size())
    loaded.notes.push_back("some of its structures overlap, so they were kept in " +
                           std::to_string(layers.size()) + " layers");
  for (Layer& layer : layers)
    loaded.maps.push_back(volume::makeLabelMap(std::move(layer.voxels), std::move(layer.names)));
  progress.report(1.0, "reading labels");
  return loaded;
}

} // namespace petrous::imaging
