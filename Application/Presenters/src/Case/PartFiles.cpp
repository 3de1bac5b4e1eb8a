#include "petrous/Presenters/PartFiles.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <tbb/parallel_for.h>

#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImagePreview.h"
#include "petrous/Imaging/LabelFile.h"

namespace petrous::presenters
{

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kLooked = 16;      // slices of a file
constexpr std::size_t kSampledMasks = 4; // masks of a folder that are looked into
constexpr std::size_t kFew = 64;         // entries of a folder; more are of several patients
constexpr std::size_t kMany = 1024;      // files of a folder beside
constexpr std::size_t kListedMeshes = 8; // of a folder, one by one

struct PartFile
{
  enum class Kind
  {
    None,
    Mask, ///< of one structure
    Map,
    Mesh
  };
  fs::path path;
  bool isBelow = true;
  Kind kind = Kind::None;
  std::size_t structures = 0; ///< of a .seg.nrrd
  std::optional<core::GridGeometry> grid = {};
  bool isSideOpen = false; ///< or the unit of length
};

bool isPartName(const fs::path& path)
{
  return path.filename().string().front() != '.' && // hidden: of file managers
         imaging::isReadAs(path, imaging::kLabels | imaging::kMesh);
}

// Entries of a folder; empty if it cannot be listed.
std::vector<fs::path> entriesOf(const fs::path& folder)
{
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    entries.push_back(entry->path());
  return entries;
}

// Files in the folder above a path and in the folders there.
std::vector<fs::path> filesBeside(const fs::path& path)
{
  std::error_code error;
  const bool isFolder = fs::is_directory(path, error);
  const fs::path root = fs::weakly_canonical(isFolder ? path : path.parent_path(), error);
  std::vector<fs::path> files;
  const auto take = [&](const fs::path& file)
  {
    std::error_code ofFile;
    if (isPartName(file) && fs::is_regular_file(file, ofFile))
      files.push_back(file);
  };
  if (!isFolder)
    for (const fs::path& file : entriesOf(root))
      take(file);
  if (error || !root.has_relative_path())
    return files;
  const std::vector<fs::path> above = entriesOf(root.parent_path());
  if (above.size() > kFew)
    return files;
  for (const fs::path& entry : above)
    if (!fs::is_directory(entry, error))
      take(entry);
    else if (const auto inside = entriesOf(entry); entry != root && inside.size() <= kMany)
      std::for_each(inside.begin(), inside.end(), take);
  return files;
}

// A header stands for a pair of files.
void dropVoxelsOfPairs(std::vector<PartFile>& files)
{
  std::set<fs::path> headers;
  for (const PartFile& file : files)
    if (const auto* format = imaging::formatOf(file.path); format && format->ending == ".hdr")
      headers.insert(file.path.parent_path() / imaging::baseName(file.path));
  const auto isOfPair = [&headers](const PartFile& file)
  {
    return imaging::formatOf(file.path)->ending == ".img" &&
           headers.count(file.path.parent_path() / imaging::baseName(file.path)) > 0;
  };
  files.erase(std::remove_if(files.begin(), files.end(), isOfPair), files.end());
}

// How many values beside 0 an image has, at most 2.
std::size_t valuesOf(const volume::IntensityVolume& image)
{
  return image.visit(
      [](const auto& volume) -> std::size_t
      {
        const auto* data = volume.data();
        const auto* end = data + volume.size();
        const auto* first = std::find_if(data, end, [](auto value) { return value != 0; });
        if (first == end)
          return 0;
        return std::any_of(first, end,
                           [first](auto value) { return value != 0 && value != *first; })
                   ? 2
                   : 1;
      });
}

// Header and name; false: the voxels have to tell.
bool readHead(PartFile& file)
{
  using Kind = PartFile::Kind;
  const imaging::FileFormat& format = *imaging::formatOf(file.path);
  if (format.reads == imaging::kMesh)
  {
    file.kind = Kind::Mesh;
    return true;
  }
  const imaging::ImageHeader header = imaging::readImageHeader(file.path);
  file.grid = header.grid;
  file.isSideOpen = header.assumedRas.has_value() || !header.unitDoubt.likely.empty();
  if (format.reads == imaging::kLabels)
  {
    file.kind = Kind::Map;
    file.structures = header.components == 1 ? imaging::readSegments(file.path).size() : 0;
    return true;
  }
  return header.components != 1 || header.volumes != 1; // colours, vectors; series
}

void readVoxels(PartFile& file, const core::Progress& progress)
{
  using Kind = PartFile::Kind;
  const auto image = imaging::previewImageFile(file.path, kLooked, progress, std::nullopt, 0, 0,
                                               imaging::likelyUnit(imaging::unitDoubtOf(file.path)))
                         .volume;
  const std::size_t values = valuesOf(*image);
  // A small structure may lie between the slices; no scan is of zeros.
  if (values == 0 || contentOf(*image) == Content::Labels)
    file.kind = values < 2 ? Kind::Mask : Kind::Map;
}

template <class Read>
void forEach(std::vector<PartFile*> files, const core::Progress& progress, const Read& read)
{
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, files.size(),
                    [&](std::size_t n)
                    {
                      try
                      {
                        read(*files[n]);
                      }
                      catch (const imaging::FileError&)
                      {
                        files[n]->kind = PartFile::Kind::None;
                        files[n]->grid.reset();
                      }
                      progress.report(static_cast<double>(++done) /
                                          static_cast<double>(files.size()),
                                      "looking for structures");
                    });
}

// A file on the grid of several masks of its folder is one, too.
void look(std::vector<PartFile>& files, const core::Progress& progress)
{
  std::vector<PartFile*> all;
  for (PartFile& file : files)
    all.push_back(&file);
  std::vector<char> isOpen(files.size(), 0);
  forEach(all, progress.part(0.0, 0.1),
          [&](PartFile& file)
          { isOpen[static_cast<std::size_t>(&file - files.data())] = !readHead(file); });
  std::map<fs::path, std::vector<PartFile*>> folders;
  for (std::size_t n = 0; n < files.size(); ++n)
    if (isOpen[n] && files[n].grid)
      folders[files[n].path.parent_path()].push_back(&files[n]);
  const auto readEach = [&](const std::vector<PartFile*>& some, const core::Progress& part)
  { forEach(some, part, [](PartFile& file) { readVoxels(file, {}); }); };
  std::vector<PartFile*> first;
  for (const auto& [folder, inside] : folders)
    first.insert(first.end(), inside.begin(),
                 inside.begin() +
                     static_cast<std::ptrdiff_t>(std::min(kSampledMasks, inside.size())));
  readEach(first, progress.part(0.1, 0.5));
  std::vector<PartFile*> rest;
  for (const auto& [folder, inside] : folders)
  {
    const bool areMasks =
        inside.size() > kSampledMasks &&
        std::all_of(inside.begin(), inside.begin() + kSampledMasks,
                    [](const PartFile* file) { return file->kind == PartFile::Kind::Mask; });
    for (std::size_t n = kSampledMasks; n < inside.size(); ++n)
      if (areMasks && core::sameGrid(*inside[n]->grid, *inside.front()->grid))
        inside[n]->kind = PartFile::Kind::Mask;
      else
        rest.push_back(inside[n]);
  }
  readEach(rest, progress.part(0.5, 1.0));
}

std::string imageOf(const PartFile& file, const imaging::ScanResult& scan)
{
  if (!file.grid || file.isSideOpen)
    return {};
  const auto found = std::find_if(scan.series.begin(), scan.series.end(),
                                  [&file](const imaging::DicomSeries& series)
                                  {
                                    return series.kind == imaging::SeriesKind::Image &&
                                           series.geometry.grid &&
                                           core::sameGrid(*series.geometry.grid, *file.grid);
                                  });
  return found == scan.series.end() ? std::string() : imaging::selectorOf(*found);
}

PartFiles entryOf(const PartFile& file, const imaging::ScanResult& scan)
{
  PartFiles entry;
  entry.content = file.kind == PartFile::Kind::Mesh ? Content::Mesh : Content::Labels;
  entry.paths = {file.path};
  entry.text = file.kind == PartFile::Kind::Mesh   ? "mesh"
               : file.kind == PartFile::Kind::Mask ? "mask of a structure"
               : file.structures == 1              ? "1 structure"
               : file.structures > 1               ? std::to_string(file.structures) + " structures"
               : imaging::formatOf(file.path)->reads == imaging::kLabels
                   ? "segmentation of 3D Slicer"
                   : "label map";
  entry.isBelow = file.isBelow;
  entry.image = imageOf(file, scan);
  return entry;
}

// Masks that lie in one folder, and meshes if they are many.
void gather(const std::vector<const PartFile*>& files, const imaging::ScanResult& scan,
            std::vector<PartFiles>& entries)
{
  const auto isMask = [](const PartFile* file) { return file->kind == PartFile::Kind::Mask; };
  const auto isMesh = [](const PartFile* file) { return file->kind == PartFile::Kind::Mesh; };
  const auto masks = static_cast<std::size_t>(std::count_if(files.begin(), files.end(), isMask));
  const auto meshes = static_cast<std::size_t>(std::count_if(files.begin(), files.end(), isMesh));
  std::optional<PartFiles> ofMasks;
  std::optional<PartFiles> ofMeshes;
  for (const PartFile* file : files)
  {
    if (file->kind == PartFile::Kind::None)
      continue;
    PartFiles entry = entryOf(*file, scan);
    if (isMask(file) && masks > 1)
    {
      if (!ofMasks)
      {
        ofMasks = entry;
        ofMasks->paths = {file->path.parent_path()};
        ofMasks->count = masks;
        ofMasks->text = std::to_string(masks) + " masks, one structure a file";
      }
      if (ofMasks->image != entry.image)
        ofMasks->image.clear();
    }
    else if (isMesh(file) && meshes > kListedMeshes)
    {
      if (!ofMeshes)
      {
        ofMeshes = entry;
        ofMeshes->paths.clear();
        ofMeshes->count = meshes;
        ofMeshes->text = std::to_string(meshes) + " meshes";
      }
      ofMeshes->paths.push_back(file->path);
    }
    else
      entries.push_back(std::move(entry));
  }
  for (auto& entry : {ofMasks, ofMeshes})
    if (entry)
      entries.push_back(*entry);
}

} // namespace

std::vector<PartFiles> partFilesOf(const fs::path& path, const imaging::ScanResult& scan,
                                   const core::Progress& progress)
{
  std::vector<PartFile> files;
  std::set<fs::path> below;
  for (const fs::path& file : scan.notDicom)
    if (isPartName(file))
    {
      files.push_back({file});
      std::error_code error;
      below.insert(fs::weakly_canonical(file, error));
    }
  for (const fs::path& file : filesBeside(path))
    if (below.count(file) == 0)
    {
      files.push_back({file});
      files.back().isBelow = false;
    }
  if (files.empty())
    return {};
  std::sort(files.begin(), files.end(),
            [](const PartFile& a, const PartFile& b) { return a.path < b.path; });
  dropVoxelsOfPairs(files);
  look(files, progress);
  std::map<std::pair<bool, fs::path>, std::vector<const PartFile*>> folders; // below first
  for (const PartFile& file : files)
    folders[{!file.isBelow, file.path.parent_path()}].push_back(&file);
  std::vector<PartFiles> entries;
  for (const auto& [folder, inside] : folders)
    gather(inside, scan, entries);
  const auto isOfScan = [](const PartFiles& entry)
  { return !entry.isBelow && !entry.image.empty(); };
  const bool isAny = std::any_of(entries.begin(), entries.end(), isOfScan);
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const PartFiles& entry) {
                                 return !entry.isBelow && !isOfScan(entry) &&
                                        !(isAny && entry.content == Content::Mesh);
                               }),
                entries.end());
  return entries;
}

} // namespace petrous::presenters
