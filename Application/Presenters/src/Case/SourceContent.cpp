#include "petrous/Presenters/SourceContent.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include "petrous/Core/AsciiCase.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImagePreview.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/PartFiles.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::presenters
{

namespace
{

namespace fs = std::filesystem;

constexpr double kPatches = 0.9;       // of the voxels above 0 have an equal neighbour
constexpr std::size_t kHardlyAny = 16; // values: no scanner yields so few
constexpr double kAir = -500.0;        // HU
constexpr std::size_t kSlices = 128;   // of a file that the memory does not hold

// Whether integers from 0 to 65535 in patches, and few distinct ones.
template <class T>
bool isLabelMap(const volume::Volume<T>& image)
{
  const std::size_t count = image.size();
  std::vector<bool> seen(65536, false);
  std::size_t values = 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    const T value = image.data()[n];
    if constexpr (std::is_floating_point_v<T>)
    {
      if (!(value >= T(0) && value <= T(65535)) || value != std::floor(value))
        return false;
    }
    else if constexpr (std::is_signed_v<T>)
    {
      if (value < 0)
        return false;
    }
    const auto index = static_cast<std::size_t>(value);
    if (!seen[index])
    {
      seen[index] = true;
      if (++values > kMaxLabels)
        return false;
    }
  }
  if (!seen[0] || values < 2)
    return false;
  if (values <= kHardlyAny)
    return true;

  const auto& dims = image.geometry().dims();
  const std::size_t steps[3] = {1, static_cast<std::size_t>(dims[0]),
                                static_cast<std::size_t>(dims[0]) *
                                    static_cast<std::size_t>(dims[1])};
  std::uint64_t drawn = 0;
  std::uint64_t joined = 0;
  std::size_t n = 0;
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i, ++n)
      {
        const T value = image.data()[n];
        if (value == T(0))
          continue;
        ++drawn;
        const int at[3] = {i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis)
          if ((at[axis] > 0 && image.data()[n - steps[axis]] == value) ||
              (at[axis] + 1 < dims[axis] && image.data()[n + steps[axis]] == value))
          {
            ++joined;
            break;
          }
      }
  return static_cast<double>(joined) >= kPatches * static_cast<double>(drawn);
}

// makeLabelMap names those without a name by their index.
std::size_t unnamedIn(const imaging::LoadedLabels& labels)
{
  std::size_t count = 0;
  for (const volume::LabelMap& map : labels.maps)
    for (const volume::Segment& segment : map.segments)
      count += segment.name == "label " + std::to_string(segment.index) ? 1 : 0;
  return count;
}

Content contentOf(const std::string& modality)
{
  return modality == "CT" ? Content::Ct : modality == "MR" ? Content::Mr : Content::Image;
}

std::string whyOf(const std::string& modality)
{
  return modality.empty() ? "says no modality" : "says modality " + modality;
}

// So that a region may do: repair reads all slices.
bool isTooLarge(const imaging::DicomSeries& series)
{
  return series.geometry.verdict == imaging::Verdict::Ok && !imaging::mayFitMemory(series);
}

SeriesContent contentOf(const imaging::DicomSeries& series)
{
  SeriesContent result;
  result.selector = imaging::selectorOf(series);
  result.content = contentOf(series.modality);
  result.modality = series.modality;
  result.description = series.description;
  result.name = sequenceName(series.description + " " + series.volume);
  if (!series.volume.empty())
    result.description += (result.description.empty() ? "" : ", ") + series.volume;
  result.slices = imaging::imageCount(series);
  if (series.geometry.grid)
    result.spacing = series.geometry.grid->spacing();
  if (!series.geometry.slices.empty())
  {
    const imaging::SliceHeader& first = series.geometry.slices.front();
    result.taken = first.taken;
    result.patientPosition = first.patientPosition;
    result.kernel = first.kernel;
    result.place = first.file.parent_path();
    result.first = first.file.filename();
  }
  result.verdict = series.geometry.grid ? series.geometry.verdict : imaging::Verdict::Refused;
  result.findings = series.geometry.findings;
  result.isTooLarge = isTooLarge(series);
  return result;
}

// The DICOM segmentations and RT structure sets of a scan, each a file.
std::vector<SeriesContent> segmentationsOf(const imaging::ScanResult& scan)
{
  std::vector<SeriesContent> found;
  for (const imaging::DicomSeries& series : scan.series)
    for (const std::filesystem::path& file : series.structures)
    {
      SeriesContent segmentation;
      segmentation.content = Content::Labels;
      segmentation.modality = series.modality;
      segmentation.description = file.filename().string();
      segmentation.place = file.parent_path();
      segmentation.files = {file};
      segmentation.what = series.kind == imaging::SeriesKind::StructureSet ? "RT structure set"
                                                                           : "DICOM segmentation";
      found.push_back(std::move(segmentation));
    }
  std::sort(found.begin(), found.end(),
            [](const SeriesContent& a, const SeriesContent& b) { return a.files < b.files; });
  found.erase(std::unique(found.begin(), found.end(),
                          [](const SeriesContent& a, const SeriesContent& b)
                          { return a.files == b.files; }), // volumes of one series
              found.end());
  return found;
}

// Structures and meshes that are not DICOM.
std::vector<SeriesContent> partsOf(const fs::path& path, const imaging::ScanResult& scan,
                                   const core::Progress& progress)
{
  std::vector<SeriesContent> found;
  for (const PartFiles& files : partFilesOf(path, scan, progress))
  {
    SeriesContent part;
    part.content = files.content;
    const fs::path& first = files.paths.front();
    if (const auto* format = imaging::formatOf(first))
      part.modality = format->name;
    const bool isFile = files.paths.size() == 1;
    part.description = (isFile ? first : first.parent_path()).filename().string();
    part.place = isFile ? first.parent_path() : first.parent_path().parent_path();
    part.files = files.paths;
    part.slices = files.count;
    part.what = files.text;
    part.image = files.image;
    part.isDicom = false;
    part.isBeside = !files.isBelow;
    found.push_back(std::move(part));
  }
  return found;
}

// The last `count` names of a path.
fs::path endOf(const fs::path& path, std::ptrdiff_t count)
{
  auto at = path.end();
  for (; count > 0 && at != path.begin(); --count)
    --at;
  fs::path result;
  for (; at != path.end(); ++at)
    result /= *at;
  return result;
}

// Where there is no working folder any more, a relative path stays one.
fs::path wholePath(const fs::path& path)
{
  std::error_code error;
  const fs::path whole = path.empty() ? fs::current_path(error) : fs::absolute(path, error);
  return error ? path : whole;
}

// Names folders so that different ones differ.
void nameFolders(std::vector<SeriesContent>& series)
{
  const auto isPlaced = [](const SeriesContent& one) // else none of its slices can be used
  { return !one.first.empty() || !one.files.empty(); };
  std::vector<fs::path> places;
  for (const SeriesContent& one : series)
    places.push_back(isPlaced(one) ? wholePath(one.place).lexically_normal() : fs::path());
  const std::set<fs::path> all(places.begin(), places.end());
  for (std::size_t n = 0; n < series.size(); ++n)
  {
    if (!isPlaced(series[n]))
      continue;
    const auto depth = std::distance(places[n].begin(), places[n].end());
    std::ptrdiff_t count = 1;
    const auto isShared = [&](const fs::path& other)
    { return other != places[n] && endOf(other, count) == endOf(places[n], count); };
    while (count < depth && std::any_of(all.begin(), all.end(), isShared))
      ++count;
    fs::path folder = endOf(places[n], count);
    const auto looksAlike = [&](const SeriesContent& other)
    {
      return &other != &series[n] && other.place == series[n].place &&
             other.modality == series[n].modality && other.description == series[n].description;
    };
    if (series[n].files.empty() && std::any_of(series.begin(), series.end(), looksAlike))
      folder /= series[n].first;
    series[n].folder = folder.string();
  }
}

// `uid`: this series alone; empty: all. `offersParts`: beside images also what is not DICOM.
SourceContent lookAtDicom(const fs::path& path, const core::Progress& progress,
                          const std::string& uid = {}, bool offersParts = false)
{
  SourceContent result;
  result.path = path;
  auto scan = imaging::scanDicom(path, progress.part(0.0, 0.5), library::scanCache().get());
  if (!uid.empty())
    scan.series.erase(std::remove_if(scan.series.begin(), scan.series.end(),
                                     [&uid](const imaging::DicomSeries& series)
                                     { return series.uid != uid; }),
                      scan.series.end());
  const auto isVerdict = [](imaging::Verdict verdict)
  {
    return [verdict](const imaging::DicomSeries& series)
    { return series.geometry.verdict == verdict && series.geometry.grid; };
  };
  const bool sound =
      std::any_of(scan.series.begin(), scan.series.end(), isVerdict(imaging::Verdict::Ok));
  const auto wanted = isVerdict(sound ? imaging::Verdict::Ok : imaging::Verdict::Repairable);
  // One slice stands for its series, which lies beside it.
  if (!sound && fs::is_regular_file(path) && scan.series.size() == 1 &&
      !scan.series.front().uid.empty() && scan.series.front().geometry.slices.size() == 1 &&
      scan.series.front().geometry.slices.front().pixels.frameCount == 1)
    return lookAtDicom(wholePath(path).parent_path(), progress.part(0.1, 1.0),
                       scan.series.front().uid);
  const auto readable = std::count_if(scan.series.begin(), scan.series.end(), wanted);
  const auto segmentations = uid.empty() ? segmentationsOf(scan) : std::vector<SeriesContent>();
  if (readable == 0 && segmentations.size() == 1)
  {
    result.path = segmentations.front().files.front();
    result.content = Content::Labels;
    result.why = "is a DICOM segmentation";
    return result;
  }
  const auto only = std::find_if(scan.series.begin(), scan.series.end(), wanted);
  // Also one that cannot be used as it is may have been meant.
  const bool hasOthers = readable == 1 && uid.empty() && !imaging::otherImages(scan, *only).empty();
  const bool isChoice = readable > 1 || hasOthers || !segmentations.empty();
  std::vector<SeriesContent> parts;
  if (offersParts && uid.empty() && readable > 0 && (isChoice || !scan.notDicom.empty()))
    parts = partsOf(path, scan, progress.part(0.5, 1.0));
  if (isChoice || std::any_of(parts.begin(), parts.end(),
                              [](const SeriesContent& one) { return !one.isBeside; }))
  {
    for (const imaging::DicomSeries& series : scan.series)
      if (imaging::imageCount(series) > 0 && series.kind == imaging::SeriesKind::Image)
        result.series.push_back(contentOf(series));
    result.series.insert(result.series.end(), segmentations.begin(), segmentations.end());
    result.series.insert(result.series.end(), parts.begin(), parts.end());
    nameFolders(result.series);
    return result;
  }
  // If none is readable, the reader reports why.
  const imaging::DicomSeries& series = readable == 1 ? *only : imaging::chooseSeries(scan, path);
  result.content = contentOf(series.modality);
  result.why = whyOf(series.modality);
  result.name = sequenceName(series.description);
  result.description = series.description;
  result.isTooLarge = isTooLarge(series);
  if (readable == 0)
    result.refused = series.geometry.findings;
  else if (series.geometry.verdict == imaging::Verdict::Repairable)
    result.repair = series.geometry.findings;
  if (!uid.empty() || !result.repair.empty() || !result.refused.empty())
    result.selector = imaging::selectorOf(series);
  return result;
}

// As the voxels of an image file say; of one that the memory does not hold, a few of them. Where
// they lie does not matter: a unit of length that is yet to be asked about is a likely one here.
Content contentOfFile(const fs::path& path, std::size_t volume, const imaging::UnitDoubt& doubt,
                      bool& isTooLarge, const core::Progress& progress)
try
{
  const imaging::LoadedImage image = imaging::readImageFile(
      path, std::nullopt, progress, std::nullopt, volume, imaging::likelyUnit(doubt));
  const Content content = presenters::contentOf(*image.volume);
  return content == Content::Image && image.isHounsfield ? Content::Ct : content;
}
catch (const imaging::FileError& error)
{
  if (error.fault() != core::Fault::Refused) // too little memory; nothing else of reading
    throw;
  isTooLarge = true;
  return presenters::contentOf(*imaging::previewImageFile(path, kSlices, progress, std::nullopt, 0,
                                                          volume, imaging::likelyUnit(doubt))
                                    .volume);
}

std::string whyOf(Content content)
{
  return content == Content::Labels ? "has a few whole numbers in patches, as labels do"
         : content == Content::Ct   ? "is in Hounsfield units"
                                    : "does not say whether it is a CT or an MR, and its numbers "
                                      "are no Hounsfield units";
}

// The volumes of a file with several, which are alike.
void listVolumes(const imaging::ImageHeader& header, SourceContent& result)
{
  constexpr std::size_t kMost = 4096; // lines of a list
  const std::string name = sequenceName(imaging::baseName(result.path));
  for (std::size_t n = 1; n <= std::min(header.volumes, kMost); ++n)
  {
    SeriesContent volume;
    const std::string number = std::to_string(n);
    volume.selector = "#" + number;
    volume.content = result.content;
    volume.description = result.path.filename().string() + ", volume " + number;
    volume.name = name.empty() ? name : name + " " + number;
    volume.slices = static_cast<std::size_t>(header.grid.dims()[2]);
    volume.spacing = header.grid.spacing();
    volume.folder = result.path.parent_path().filename().string();
    volume.place = result.path.parent_path();
    volume.isDicom = false;
    result.series.push_back(std::move(volume));
  }
}

// Nothing if the folder holds no mask.
std::optional<SourceContent> lookAtMasks(const fs::path& folder, const core::Progress& progress)
try
{
  SourceContent result;
  result.path = folder;
  result.content = Content::Labels;
  result.structures = maskNames(imaging::loadLabels(folder, progress));
  result.why = "holds masks, one structure a file";
  return result;
}
catch (const imaging::FileError& error)
{
  if (error.reason != imaging::FileError::Reason::Unsupported)
    throw;
  return std::nullopt;
}

} // namespace

Content contentOf(const volume::IntensityVolume& image)
{
  if (image.visit([](const auto& volume) { return isLabelMap(volume); }))
    return Content::Labels;
  const volume::IntensityHistogram histogram(image);
  const bool air = histogram.count() > 0 && histogram.range().min < kAir;
  return air && volume::suggestScale(histogram).calibrated ? Content::Ct : Content::Image;
}

std::string sequenceName(const std::string& description)
{
  // Sequences, weightings, contrast, planes and regions as scanners name them.
  static constexpr std::string_view kWords[] = {
      "2d",       "3d",     "adc",     "ax",        "axial",   "blade",  "bravo",    "ce",  "ciss",
      "contrast", "cor",    "coronal", "cube",      "dixon",   "drive",  "dti",      "dwi", "epi",
      "fatsat",   "fiesta", "flair",   "flash",     "fs",      "fse",    "fspgr",    "gad", "gd",
      "gre",      "haste",  "iac",     "iam",       "mpr",     "mprage", "mra",      "mrv", "pd",
      "petra",    "post",   "pre",     "propeller", "resolve", "sag",    "sagittal", "se",  "space",
      "spgr",     "stir",   "swi",     "t1",        "t1w",     "t2",     "t2w",      "tof", "tra",
      "trace",    "trufi",  "tse",     "vibe",      "vista",   "zte"};
  static constexpr std::string_view kNumbered[] = {"b", "echo", "phase"}; // "b 1000"
  const auto isIn = [](const auto& list, const std::string& text)
  { return std::find(std::begin(list), std::end(list), text) != std::end(list); };
  const auto isNumber = [](const std::string& text, std::size_t from)
  {
    return text.size() > from && text.size() <= from + 4 &&
           text.find_first_not_of("0123456789", from) == std::string::npos;
  };
  std::string name;
  std::string before;
  for (std::size_t at = 0; at < description.size();)
  {
    std::string word;
    for (;
         at < description.size() && std::isalnum(static_cast<unsigned char>(description[at])) != 0;
         ++at)
      word += description[at];
    if (word.empty())
    {
      ++at;
      continue;
    }
    std::string lower = word;
    std::transform(lower.begin(), lower.end(), lower.begin(), core::asciiLower);
    if (isIn(kNumbered, before) && isNumber(lower, 0))
      word = before + " " + word;
    else if (!isIn(kWords, lower) && !(lower[0] == 'b' && isNumber(lower, 1)))
      word.clear();
    if (!word.empty())
      name += (name.empty() ? "" : " ") + word;
    before = lower;
  }
  return name;
}

fs::path namingFolder(const std::vector<SeriesContent>& chosen,
                      const std::vector<SeriesContent>& series)
{
  const auto isImage = [](const SeriesContent& one) { return one.files.empty(); };
  const auto image = std::find_if(chosen.begin(), chosen.end(), isImage);
  if (std::count_if(chosen.begin(), chosen.end(), isImage) != 1)
    return {};
  const bool hasOthers =
      std::any_of(series.begin(), series.end(),
                  [&](const SeriesContent& one)
                  { return isImage(one) && !one.place.empty() && one.place != image->place; });
  return hasOthers ? image->place : fs::path();
}

SourceContent lookAt(const fs::path& path, const core::Progress& progress,
                     std::optional<Content> expected)
{
  SourceContent result;
  result.path = path;
  const imaging::FileFormat* format = fs::is_directory(path) ? nullptr : imaging::formatOf(path);
  if (format && format->reads == imaging::kMesh)
  {
    result.content = Content::Mesh;
    result.isNameless = !fileName(path).isWhole;
    result.why = "is a surface of triangles";
    try
    {
      result.structureCount = imaging::objectCount(path, progress);
    }
    catch (const imaging::FileError&)
    {
      // told when it is added
    }
    return result;
  }
  if ((!format || format->reads == imaging::kDicom) && imaging::isDicomSegmentation(path))
  {
    result.content = Content::Labels;
    result.why = "is a DICOM segmentation";
    return result;
  }
  if ((!format || format->reads == imaging::kDicom) && imaging::isStructureSet(path))
  {
    result.content = Content::Labels;
    result.why = "is a DICOM RT structure set";
    return result;
  }
  if (expected == Content::Labels && fs::is_directory(path))
    if (auto masks = lookAtMasks(path, progress.part(0.0, 0.5)))
      return *masks;
  if (!format || format->reads == imaging::kDicom)
    try
    {
      return lookAtDicom(path, progress.part(0.0, 0.5), {}, !expected);
    }
    catch (const imaging::DicomError& error)
    {
      if (error.reason() != imaging::DicomError::Reason::NoImages || !fs::is_directory(path))
        throw;
      if (auto masks = lookAtMasks(path, progress.part(0.5, 1.0)))
        return *masks;
      throw;
    }
  if (format->reads == imaging::kLabels)
  {
    result.content = Content::Labels;
    result.why = "is a segmentation of 3D Slicer";
    if (imaging::readImageHeader(path).components == 1) // else overlapping, in layers
      result.structureCount = imaging::readSegments(path).size();
    return result;
  }
  const imaging::ImageHeader header = imaging::readImageHeader(path);
  const bool isSeries = header.volumes > 1 && expected != Content::Labels;
  result.content = expected ? *expected
                            : contentOfFile(path, isSeries ? 1 : 0, header.unitDoubt,
                                            result.isTooLarge, progress.part(0.0, 0.8));
  result.isSideOpen = header.assumedRas.has_value();
  result.unitDoubt = header.unitDoubt;
  if (isSeries)
  {
    if (result.content == Content::Labels) // which have one volume
      result.content = Content::Image;
    result.why = whyOf(result.content);
    listVolumes(header, result);
    return result;
  }
  result.name = sequenceName(imaging::baseName(path));
  if (result.content == Content::Labels)
  {
    const bool isWhole = fileName(path).isWhole;
    try
    {
      const imaging::LoadedLabels labels = imaging::loadLabels(path, progress.part(0.8, 1.0));
      result.isNameless = !isWhole && labels.isNamedAfterFile;
      result.unnamed = unnamedIn(labels);
      for (const volume::LabelMap& map : labels.maps)
        result.structureCount += map.segments.size();
    }
    catch (const imaging::FileError&)
    {
      if (!isWhole) // else it is told when it is added
        throw;
    }
  }
  result.why = whyOf(result.content);
  return result;
}

std::string nameOf(Content content)
{
  switch (content)
  {
  case Content::Ct:
    return "CT";
  case Content::Mr:
    return "MR";
  case Content::Labels:
    return "structures";
  case Content::Mesh:
    return "mesh";
  case Content::Image:
    break;
  }
  return "image";
}

} // namespace petrous::presenters
