#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/PartFiles.h"

namespace petrous::cli
{

namespace
{

using nlohmann::json;

json findingsJson(const std::vector<imaging::Finding>& findings)
{
  json list = json::array();
  for (const auto& finding : findings)
    list.push_back({{"kind", imaging::kindName(finding.kind)},
                    {"text", finding.text},
                    {"error_mm", finding.errorMm}});
  return list;
}

json volumeJson(const imaging::DicomSeries& series)
{
  const auto& geometry = series.geometry;
  json entry{{"uid", series.uid},
             {"kind", imaging::kindName(series.kind)},
             {"modality", series.modality},
             {"description", series.description},
             {"slices", geometry.slices.size()},
             {"files", series.files},
             {"dims", nullptr},
             {"spacing_mm", nullptr},
             {"origin_mm", nullptr},
             {"direction", nullptr},
             {"verdict", nullptr},
             {"findings", json::array()},
             {"notes", geometry.notes}};
  if (series.kind == imaging::SeriesKind::Image) // else nothing is judged
  {
    entry["verdict"] = imaging::verdictName(geometry.verdict);
    entry["findings"] = findingsJson(geometry.findings);
  }
  if (geometry.grid)
    entry.update(gridJson(*geometry.grid));
  return entry;
}

// The volumes of one series, which adjoin. What a series of several says of itself is what its
// largest sound volume says.
json seriesJson(const std::vector<const imaging::DicomSeries*>& volumes)
{
  const auto rank = [](const imaging::DicomSeries* one)
  {
    return std::make_pair(one->geometry.verdict == imaging::Verdict::Ok,
                          one->geometry.slices.size());
  };
  json entry = volumeJson(**std::max_element(
      volumes.begin(), volumes.end(), [&rank](auto* a, auto* b) { return rank(a) < rank(b); }));
  json list = json::array();
  for (const imaging::DicomSeries* one : volumes)
  {
    json volume = volumeJson(*one);
    volume["name"] = one->volume;
    list.push_back(std::move(volume));
  }
  entry["volumes"] = std::move(list);
  return entry;
}

void printFindings(const Context& context, const std::vector<imaging::Finding>& findings)
{
  for (const auto& finding : findings)
    context.print(std::string("    ") + imaging::kindName(finding.kind) + ": " + finding.text);
}

// "labels.nii.gz: label map, on the grid of 1.2.3, which --labels reads"
std::string lineOf(const presenters::PartFiles& files)
{
  const bool isMesh = files.content == presenters::Content::Mesh;
  const auto& first = files.paths.front();
  std::string line =
      core::printable(files.paths.size() == 1 ? first : first.parent_path()) + ": " + files.text;
  if (!files.isBelow)
    line += ", beside this path";
  if (!files.image.empty())
    line += ", on the grid of " + files.image;
  else if (!isMesh)
    line += ", on another grid";
  return line + (isMesh ? ", which --mesh reads" : ", which --labels reads");
}

json partsJson(const std::vector<presenters::PartFiles>& parts)
{
  json list = json::array();
  for (const presenters::PartFiles& files : parts)
  {
    json paths = json::array();
    for (const auto& path : files.paths)
      paths.push_back(core::printable(path));
    list.push_back({{"kind", files.content == presenters::Content::Mesh ? "mesh" : "labels"},
                    {"text", files.text},
                    {"paths", std::move(paths)},
                    {"files", files.count},
                    {"below", files.isBelow},
                    {"grid_of", files.image.empty() ? json() : json(files.image)}});
  }
  return list;
}

struct ImageFile
{
  std::filesystem::path path;
  imaging::ImageHeader header;
};

// Images that are not DICOM: `path` itself, or what lies below it and holds several volumes.
std::vector<ImageFile> imageFilesOf(const std::filesystem::path& path,
                                    const imaging::ScanResult& result)
{
  std::vector<ImageFile> images;
  for (const auto& file : result.notDicom)
    if (imaging::isReadAs(file, imaging::kImage))
      try
      {
        const imaging::ImageHeader header = imaging::readImageHeader(file);
        if (header.volumes > 1 || (file == path && header.components == 1))
          images.push_back({file, header});
      }
      catch (const imaging::FileError&)
      {
        if (file == path)
          throw;
      }
  return images;
}

nlohmann::json imagesJson(const std::vector<ImageFile>& images)
{
  json list = json::array();
  for (const ImageFile& image : images)
  {
    json entry{{"path", core::printable(image.path)},
               {"volumes", image.header.volumes},
               {"unit_unclear", !image.header.unitDoubt.likely.empty()}};
    if (const imaging::UnitDoubt& doubt = image.header.unitDoubt; !doubt.likely.empty())
    {
      entry["unit_mm"] = doubt.unit; // in which the grid is given
      entry["unit_stated"] = doubt.isStated;
      entry["units_likely_mm"] = doubt.likely;
    }
    entry.update(gridJson(image.header.grid));
    list.push_back(std::move(entry));
  }
  return list;
}

void printImage(const Context& context, const ImageFile& image)
{
  const core::GridGeometry& grid = image.header.grid;
  const auto& n = grid.dims();
  const std::size_t volumes = image.header.volumes;
  context.print("image  " + std::to_string(volumes) +
                (volumes == 1 ? " volume of " : " volumes of ") + std::to_string(n[0]) + " x " +
                std::to_string(n[1]) + " x " + std::to_string(n[2]) + ", " +
                fixed(grid.spacing()[0], 3) + " x " + fixed(grid.spacing()[1], 3) + " x " +
                fixed(grid.spacing()[2], 3) + " mm  " + core::printable(image.path));
  if (const imaging::UnitDoubt& doubt = image.header.unitDoubt; !doubt.likely.empty())
    context.print("    this is in " + presenters::unitName(doubt.unit) +
                  (doubt.isStated ? ", as it states" : ", as it states no unit") + ": " +
                  presenters::lengthText(doubt.edge) +
                  " mm long, which makes no sense; say another unit with --ct-unit, --mr-unit or "
                  "--labels-unit");
  if (volumes > 1)
    context.print("    volumes '1' to '" + std::to_string(volumes) +
                  "', of which --ct FILE --volume N takes one, or --mr FILE##N");
}

struct Options
{
  std::string path;
  bool strict = false;
  bool noCache = false;
};

// Why --strict fails; empty if every series is sound.
std::string complaintOf(const imaging::ScanResult& result)
{
  std::size_t unsound = 0;
  for (const auto& series : result.series)
  {
    const auto& findings = series.geometry.findings;
    const bool isCut = std::any_of(findings.begin(), findings.end(),
                                   [](const auto& finding)
                                   {
                                     return finding.kind == imaging::FindingKind::MissingEnd ||
                                            finding.kind == imaging::FindingKind::MissingBetween;
                                   });
    const bool isSound = series.geometry.verdict == imaging::Verdict::Ok && !isCut;
    unsound += isSound || series.kind != imaging::SeriesKind::Image ? 0 : 1;
  }
  if (unsound == 0 && result.unreadable.empty() && result.lostFiles == 0)
    return {};
  return std::to_string(unsound) + " of " + std::to_string(result.series.size()) +
         " series not ok, " + std::to_string(result.unreadable.size()) +
         " findings outside of series, " + std::to_string(result.lostFiles) +
         " files of a DICOMDIR not there; --strict wants none";
}

void scan(const Context& context, const Options& options)
{
  const std::string& path = options.path;
  const auto cache = options.noCache ? nullptr : library::scanCache();
  const core::Progress progress = context.progress();
  const auto result = imaging::scanDicom(path, progress.part(0.0, 0.7), cache.get());
  const std::vector<ImageFile> images = imageFilesOf(path, result);
  if (result.series.empty() && result.unreadable.empty() && images.empty())
    imaging::chooseSeries(result, path); // throws, reporting what was found instead
  json list = json::array();
  std::vector<const imaging::DicomSeries*> volumes; // of one series
  std::set<std::string> said;                       // an unreadable folder is a finding of each
  for (const auto& series : result.series)
  {
    if (!volumes.empty() && (series.volume.empty() || volumes.front()->uid != series.uid))
    {
      list.push_back(seriesJson(volumes));
      volumes.clear();
    }
    volumes.push_back(&series);
    if (series.kind != imaging::SeriesKind::Image)
    {
      context.print(std::string(imaging::kindName(series.kind)) + "  " + series.modality + "  " +
                    std::to_string(series.files) + (series.files == 1 ? " file" : " files") + "  " +
                    series.uid);
      context.print("    structures, which --labels reads");
      continue;
    }
    std::string line = std::string(imaging::verdictName(series.geometry.verdict)) + "  " +
                       series.modality + "  " + std::to_string(series.geometry.slices.size()) +
                       " slices";
    if (const auto& grid = series.geometry.grid)
      line += " of " + std::to_string(grid->dims()[0]) + " x " + std::to_string(grid->dims()[1]) +
              ", " + fixed(grid->spacing()[0], 3) + " x " + fixed(grid->spacing()[1], 3) + " x " +
              fixed(grid->spacing()[2], 3) + " mm";
    context.print(line + "  " + series.uid +
                  (series.volume.empty() ? "" : "  volume '" + series.volume + "'"));
    printFindings(context, series.geometry.findings);
    for (const auto& finding : series.geometry.findings)
      said.insert(finding.text);
    for (const auto& note : series.geometry.notes)
      context.print("    noted: " + note);
  }
  if (!volumes.empty())
    list.push_back(seriesJson(volumes));
  for (const ImageFile& image : images)
    printImage(context, image);
  const auto parts = presenters::partFilesOf(path, result, progress.part(0.7, 1.0));
  for (const presenters::PartFiles& files : parts)
    context.print("structures  " + lineOf(files));
  std::vector<imaging::Finding> others;
  for (const auto& finding : result.unreadable)
    if (said.insert(finding.text).second)
      others.push_back(finding);
  printFindings(context, others);
  std::vector<std::string> notes = result.lossNotes;
  notes.insert(notes.end(), result.notes.begin(), result.notes.end());
  for (const auto& note : notes)
    if (said.insert(note).second)
      context.print("noted: " + note);
  context.printJson({{"series", std::move(list)},
                     {"images", imagesJson(images)},
                     {"parts", partsJson(parts)},
                     {"unreadable", findingsJson(result.unreadable)},
                     {"notes", notes},
                     {"lost_files", result.lostFiles},
                     {"foreign_files", result.foreignFiles}});
  if (const std::string complaint = complaintOf(result); options.strict && !complaint.empty())
    throw core::InvalidParameter(path + ": " + complaint);
}

} // namespace

void addScanCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command =
      context.addCommand(app, "scan", "Judge the geometry of each DICOM series below a path",
                         [options, &context] { scan(context, *options); });
  command->add_option("PATH", options->path, "Folder or file")->required();
  command->add_flag(
      "--strict", options->strict,
      "Exit 3 unless every image series is ok with no slices that may be missing, every "
      "DICOM file is readable, and all is there that a DICOMDIR lists");
  command->add_flag("--no-cache", options->noCache,
                    "Read every header, and remember none for the next scan of the same files");
}

} // namespace petrous::cli
