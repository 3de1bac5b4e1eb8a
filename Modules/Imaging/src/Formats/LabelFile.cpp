#include "petrous/Imaging/LabelFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "FileHelpers.h"
#include "LabelFolder.h"
#include "LabelNames.h"
#include "MemoryCheck.h"
#include "OutputFile.h"
#include "SegmentationReader.h"
#include "VoxelSource.h"
#include "VoxelWriter.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::imaging
{

namespace
{

constexpr double kLargestLabel = 65535.0;

[[noreturn]] void failValue(const std::filesystem::path& path, double value)
{
  std::string what;
  if (!std::isfinite(value) || value != std::floor(value))
    what = "holds a value that is not a whole number";
  else
    what = "holds the value " + exactText(value);
  fail(FileError::Reason::Unsupported, path,
       what +
           "; labels are whole numbers from 0 to 65535 (an intensity image is given as CT or MR)");
}

/// One layer of the file as labels.
using Labels = std::shared_ptr<volume::Volume<std::uint16_t>>;

template <class T>
Labels toLabels(const VoxelSource& source, const std::filesystem::path& path,
                const std::shared_ptr<void>& raw, std::size_t layer, const core::Progress& progress)
{
  const core::GridGeometry& geometry = source.geometry();
  const std::size_t stride = source.components();
  if constexpr (std::is_same_v<T, std::uint16_t>)
    if (stride == 1)
      return std::make_shared<volume::Volume<std::uint16_t>>(
          geometry, std::shared_ptr<std::uint16_t>(raw, static_cast<std::uint16_t*>(raw.get())));
  requireMemory(path, geometry.voxelCount() * sizeof(std::uint16_t),
                "export fewer of its structures at a time");
  const Labels labels = volume::makeZeroVolume<std::uint16_t>(geometry);
  const T* in = static_cast<const T*>(raw.get()) + layer;
  std::uint16_t* out = labels->data();
  const std::size_t size = labels->size();
  constexpr std::size_t kRun = 64; // numbers compared with zero at once: most of a file is empty
  static constexpr std::array<T, kRun> kZeros{};
  constexpr std::size_t kChecked = 65536; // voxels between two checks, at least
  std::size_t unchecked = 0;
  for (std::size_t v = 0; v < size; ++v)
  {
    if (v >= unchecked)
    {
      progress.check("reading labels");
      unchecked = v + kChecked;
    }
    while (stride == 1 && v + kRun <= size &&
           std::memcmp(in + v, kZeros.data(), sizeof kZeros) == 0)
      v += kRun;
    if (v == size)
      break;
    const T value = in[v * stride];
    if constexpr (std::is_floating_point_v<T>)
    {
      if (!(value >= T{0} && value <= static_cast<T>(kLargestLabel)) || value != std::floor(value))
        failValue(path, static_cast<double>(value));
    }
    else if constexpr (!std::is_same_v<T, std::uint8_t>)
    {
      bool good = true;
      if constexpr (std::is_signed_v<T>)
        good = value >= T{0};
      if constexpr (sizeof(T) > 2)
        good = good && value <= static_cast<T>(kLargestLabel);
      if (!good)
        failValue(path, static_cast<double>(value));
    }
    if (value != T{0}) // memory is committed only where something is written
      out[v] = static_cast<std::uint16_t>(value);
  }
  return labels;
}

/// Which labels other than 0 occur.
std::vector<bool> valuesIn(const volume::Volume<std::uint16_t>& labels)
{
  std::vector<char> seen(65536, 0);
  const core::Index3& dims = labels.geometry().dims();
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      volume::forEachLabel(&labels.at(0, j, k), dims[0],
                           [&seen](int, std::uint16_t label) { seen[label] = 1; });
  return {seen.begin(), seen.end()};
}

/// "label 3", "labels 3, 5 and 7 more"
std::string labelsText(const std::vector<std::uint16_t>& indices)
{
  constexpr std::size_t kMax = 6;
  std::string text = indices.size() == 1 ? "label " : "labels ";
  for (std::size_t n = 0; n < std::min(kMax, indices.size()); ++n)
    text += (n == 0 ? "" : ", ") + std::to_string(indices[n]);
  if (indices.size() > kMax)
    text += " and " + std::to_string(indices.size() - kMax) + " more";
  return text;
}

/// The entries of a table whose values occur; tells of the others.
std::vector<volume::Segment> namesFromTable(LabelTable table, const std::vector<bool>& seen,
                                            LoadedLabels& loaded)
{
  loaded.notes.insert(loaded.notes.end(), table.notes.begin(), table.notes.end());
  for (const std::string& problem : table.problems)
    loaded.notes.push_back("of the table of names beside it, " + problem +
                           "; that entry was left out");
  std::vector<volume::Segment> names;
  std::vector<bool> nameless = seen;
  for (volume::Segment& segment : table.segments)
  {
    nameless[segment.index] = false;
    if (seen[segment.index])
      names.push_back(std::move(segment));
    else
      loaded.unread.push_back({segment.name, segment.index});
  }
  std::vector<std::uint16_t> indices;
  for (std::size_t index = 1; index < nameless.size(); ++index)
    if (nameless[index])
      indices.push_back(static_cast<std::uint16_t>(index));
  if (!indices.empty())
    loaded.notes.push_back(labelsText(indices) + (indices.size() == 1 ? " has" : " have") +
                           " no name in the table of names");
  return names;
}

/// Names for a file that contains none; may renumber a single structure to 1.
std::vector<volume::Segment> namesFromOutside(const std::filesystem::path& path,
                                              const LabelNaming& naming,
                                              volume::Volume<std::uint16_t>& labels,
                                              LoadedLabels& loaded)
{
  const std::vector<bool> seen = valuesIn(labels);
  const auto count = std::count(seen.begin() + 1, seen.end(), true);
  if (count == 0)
    fail(FileError::Reason::Unsupported, path,
         "holds no structure, every voxel is 0; voxels of a structure need a value from 1 on");
  const bool isGiven = !naming.table.empty();
  LabelTable table = isGiven ? readLabelTable(naming.table) : findLabelTable(path);
  const bool isOwn = table.sameName || (isGiven && naming.namesSingle);
  const bool fits = std::any_of(table.segments.begin(), table.segments.end(),
                                [&seen](const auto& segment) { return seen[segment.index]; });
  // A table of another name matches a single structure only by chance.
  if (count > 1 || (isOwn && fits))
  {
    if (isGiven || table.sameName)
      return namesFromTable(std::move(table), seen, loaded);
    auto& list = table.segments;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&seen](const auto& segment) { return !seen[segment.index]; }),
               list.end());
    return std::move(list);
  }
  if (isGiven && naming.namesSingle)
    loaded.notes.emplace_back("its one value has no name in the table of names, so it is named by "
                              "its file");
  std::for_each(labels.data(), labels.data() + labels.size(),
                [](std::uint16_t& v)
                {
                  if (v > 1)
                    v = 1;
                });
  loaded.isNamedAfterFile = true;
  volume::Segment segment;
  segment.name = baseName(path);
  segment.index = 1;
  return {segment};
}

bool hasSegments(const VoxelSource& source)
{
  return source.nrrd() && hasSegments(*source.nrrd());
}

[[noreturn]] void failOverlap(const std::filesystem::path& path, std::size_t layers)
{
  fail(FileError::Reason::Unsupported, path,
       "holds structures that overlap, in " + std::to_string(layers) +
           " layers; one layer is needed here");
}

constexpr const char* kTableUnused =
    "names its structures itself, so the table of names was not used for it";

LoadedLabels readLayers(const std::filesystem::path& path, bool oneOnly,
                        const core::Progress& progress, const LabelNaming& naming,
                        const std::vector<ImageGrid>& images, const std::optional<bool>& isRas,
                        std::uint64_t memory, const std::optional<double>& unit)
{
  progress.report(0.0, "reading labels");
  if (isDicomSegmentation(path))
  {
    LoadedLabels loaded = readSegmentation(path, progress, images, memory);
    if (!naming.table.empty())
      loaded.notes.emplace_back(kTableUnused);
    if (oneOnly && loaded.maps.size() > 1)
      failOverlap(path, loaded.maps.size());
    return loaded;
  }
  VoxelSource source(path, kCutLabels);
  source.settleUnit(unit, images);
  source.settlePlacement(images);
  const bool isSideKnown = source.settleSide(isRas, images);
  const bool named = hasSegments(source);
  if (!named || source.components() == 1) // else the layers of a segmentation
    source.requireOneVolume(false);
  if (source.components() > 1 && !named)
    fail(FileError::Reason::Unsupported, path,
         "holds " + std::to_string(source.components()) +
             " numbers a voxel; a label file holds one whole number a voxel");
  if (source.components() > 1 && oneOnly)
    failOverlap(path, source.components());
  const auto raw = source.read(source.geometry().fullBox(), progress.part(0.0, 0.7));
  LoadedLabels loaded;
  loaded.notes = source.notes();
  loaded.isSideOpen = !isSideKnown;
  loaded.unitDoubt = source.unitDoubt();
  loaded.assumedRas = source.assumedRas();
  if (named)
    for (const std::string& name : segmentsWithoutLayer(*source.nrrd(), source.components()))
    {
      loaded.notes.push_back("'" + name +
                             "' was left out: the file puts it in a layer that it has "
                             "not; save it again in 3D Slicer");
      loaded.unread.push_back({name, 0, false});
    }
  if (named && !naming.table.empty())
    loaded.notes.emplace_back(kTableUnused);
  UniqueNames unique;
  for (std::size_t layer = 0; named && layer < source.components(); ++layer)
    for (const volume::Segment& segment : segmentsOfLayer(path, *source.nrrd(), layer))
      unique.reserve(segment.name);
  for (std::size_t layer = 0; layer < source.components(); ++layer)
  {
    progress.report(0.7, "reading labels");
    const Labels labels =
        visitComponent(source.component(), [&](auto type)
                       { return toLabels<decltype(type)>(source, path, raw, layer, progress); });
    auto names = named ? segmentsOfLayer(path, *source.nrrd(), layer)
                       : namesFromOutside(path, naming, *labels, loaded);
    const auto codes = named ? codesOfLayer(*source.nrrd(), layer)
                             : std::map<std::uint16_t, volume::SegmentCodes>();
    for (const volume::Segment& segment : names)
      unique.reserve(segment.name);
    for (volume::Segment& segment : names)
    {
      segment.name = unique.take(segment.name, loaded.notes);
      if (named)
        if (const auto found = codes.find(segment.index); found != codes.end())
          loaded.codes[segment.name] = found->second;
    }
    loaded.maps.push_back(volume::makeLabelMap(labels, std::move(names)));
  }
  progress.report(1.0, "reading labels");
  return loaded;
}

} // namespace

bool isDicomSegmentation(const std::filesystem::path& path)
{
  const FileFormat* format = recognisedFormat(path);
  return format && format->reads == kDicom && isSegmentationClass(sopClassOf(path));
}

LoadedLabels loadLabels(const std::filesystem::path& path, const core::Progress& progress,
                        const LabelNaming& naming, const std::vector<ImageGrid>& images,
                        const std::optional<bool>& isRas, std::uint64_t memory,
                        const std::optional<double>& unit)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    return readLabelFolder(path, progress, images, isRas, unit);
  return readLayers(path, false, progress, naming, images, isRas, memory, unit);
}

volume::LabelMap readLabelFile(const std::filesystem::path& path, const core::Progress& progress)
{
  return std::move(readLayers(path, true, progress, {}, {}, {}, 0, {}).maps.front());
}

std::vector<volume::Segment> readSegments(const std::filesystem::path& path)
{
  const VoxelSource source(path);
  return hasSegments(source) ? segmentsOfLayer(path, *source.nrrd(), 0)
                             : std::vector<volume::Segment>();
}

void writeLabelFile(const std::filesystem::path& path, const volume::LabelMap& labels)
{
  writeLabelLayers(path, {labels});
}

namespace
{

void writeOneLayer(const std::filesystem::path& path, const volume::LabelMap& labels,
                   const std::map<std::uint16_t, volume::SegmentCodes>& codes)
{
  if (!labels.voxels)
    throw core::InvalidParameter("label map: no voxels given to write");
  const volume::Volume<std::uint16_t>& voxels = *labels.voxels;
  const bool named = writingFormat(path, kLabels).writeVoxels == writeNrrd;
  const std::string keys = named ? segmentKeys({labels}, codes) : std::string();
  const bool small = std::all_of(voxels.data(), voxels.data() + voxels.size(),
                                 [](std::uint16_t v) { return v <= 255; });
  if (!small)
  {
    writeVoxelFile(path, kLabels, voxels.geometry(), voxelTypeOf<std::uint16_t>(), voxels.data(),
                   keys, {});
    return;
  }
  std::vector<std::uint8_t> bytes(voxels.size());
  std::transform(voxels.data(), voxels.data() + voxels.size(), bytes.begin(),
                 [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
  writeVoxelFile(path, kLabels, voxels.geometry(), voxelTypeOf<std::uint8_t>(), bytes.data(), keys,
                 {});
}

} // namespace

void writeLabelLayers(const std::filesystem::path& path,
                      const std::vector<volume::LabelMap>& layers, const core::Progress& progress,
                      const std::map<std::uint16_t, volume::SegmentCodes>& codes)
{
  if (layers.size() == 1)
    return writeOneLayer(path, layers.front(), codes);
  if (layers.empty() || std::any_of(layers.begin(), layers.end(),
                                    [&](const volume::LabelMap& map)
                                    {
                                      return !map.voxels ||
                                             !core::sameGrid(map.voxels->geometry(),
                                                             layers.front().voxels->geometry());
                                    }))
    throw core::InvalidParameter("label layers: none given to write, or on different grids");
  const FileFormat& format = writingFormat(path, kLabels);
  if (format.ending != ".seg.nrrd")
    fail(FileError::Reason::UnknownFormat, path,
         "holds one layer, and structures overlap; write .seg.nrrd");
  const std::size_t count = layers.front().voxels->size();
  std::vector<std::uint16_t> voxels(count * layers.size());
  for (std::size_t layer = 0; layer < layers.size(); ++layer)
    for (std::size_t p = 0; p < count; ++p)
      voxels[p * layers.size() + layer] = layers[layer].voxels->data()[p];
  std::vector<std::uint8_t> bytes;
  if (*std::max_element(voxels.begin(), voxels.end()) <= 255)
  {
    bytes.resize(voxels.size());
    std::transform(voxels.begin(), voxels.end(), bytes.begin(),
                   [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
  }
  const VoxelType type = bytes.empty() ? voxelTypeOf<std::uint16_t>() : voxelTypeOf<std::uint8_t>();
  const void* data = bytes.empty() ? static_cast<const void*>(voxels.data()) : bytes.data();
  OutputFile file(path);
  format.writeVoxels(file, {path, layers.front().voxels->geometry(), type, data,
                            segmentKeys(layers, codes), progress, layers.size()});
  progress.check("writing labels");
  file.commit();
}

void writeLabelTable(const std::filesystem::path& path,
                     const std::vector<volume::Segment>& segments)
{
  std::string text = "# ITK-SnAP Label Description File\n"
                     "# IDX -R- -G- -B- -A- VIS MSH LABEL\n"
                     "0 0 0 0 0 0 0 \"Clear Label\"\n";
  for (const volume::Segment& segment : segments)
  {
    text += std::to_string(segment.index);
    for (const float channel : segment.color)
      text += " " + std::to_string(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255.0F));
    std::string name = segment.name;
    for (char& c : name)
      c = c == '"' ? '\'' : static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    text += " 1 1 1 \"" + name + "\"\n";
  }
  core::writeFile(path, text);
}

} // namespace petrous::imaging
