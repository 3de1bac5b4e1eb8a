#include "ImportBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include <gdcmDirectory.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gdcmScanner.h>
#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageSeriesReader.h>

#include "ProcessMemory.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Library/DerivedCache.h"

namespace petrous::imaging
{

namespace
{

namespace fs = std::filesystem;
using Voxels = volume::Volume<std::int16_t>;
using PeerImage = itk::Image<short, 3>;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Smooth shapes and noise over the full CT range, so that readers cannot take shortcuts.
std::shared_ptr<const Voxels> makeImage(int size, int slices)
{
  const core::GridGeometry grid({size, size, slices}, {0.3, 0.3, 0.4}, {-70.0, -60.0, 1200.0});
  auto voxels = std::make_shared<Voxels>(grid);
  std::int16_t* out = voxels->data();
  std::uint32_t noise = 1;
  for (int k = 0; k < slices; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i)
      {
        noise = noise * 1664525U + 1013904223U;
        *out++ = static_cast<std::int16_t>(-1024 + (i * 7 + j * 5 + k * 3 + (noise >> 24)) % 4096);
      }
  return voxels;
}

/// A temporary folder.
class SeriesFolder
{
public:
  explicit SeriesFolder(const fs::path& parent, const char* name = "import-benchmark")
    : m_path(parent / name)
  {
  }
  ~SeriesFolder()
  {
    std::error_code error;
    fs::remove_all(m_path, error);
  }
  SeriesFolder(const SeriesFolder&) = delete;
  SeriesFolder& operator=(const SeriesFolder&) = delete;
  const fs::path& path() const { return m_path; }

private:
  fs::path m_path;
};

void writeSeries(const fs::path& folder, const std::shared_ptr<const Voxels>& image,
                 const core::Progress& progress)
{
  SeriesDescription description;
  description.description = "import benchmark";
  description.studyUid = deterministicUid(1, "import.study");
  description.seriesUid = deterministicUid(1, "import.series");
  description.frameOfReferenceUid = deterministicUid(1, "import.frame");
  description.rescaleIntercept = -1024.0;
  writeDicomSeries(folder, volume::IntensityVolume(image), description, std::nullopt, progress);
}

PeerImage::Pointer importByPeer(const fs::path& folder)
{
  auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(false);
  names->SetDirectory(folder.string());
  auto reader = itk::ImageSeriesReader<PeerImage>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names->GetInputFileNames());
  reader->Update();
  return reader->GetOutput();
}

double largestDifference(const short* a, const short* b, std::size_t count)
{
  int largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double cornerDifference(const core::GridGeometry& truth,
                        const std::function<Eigen::Vector3d(const core::Index3&)>& patientOf)
{
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const core::Index3& dims = truth.dims();
    const core::Index3 index{(corner & 1) ? dims[0] - 1 : 0, (corner & 2) ? dims[1] - 1 : 0,
                             (corner & 4) ? dims[2] - 1 : 0};
    const Eigen::Vector3d expected =
        truth.patientFromVoxel(Eigen::Vector3d(index[0], index[1], index[2]));
    largest = std::max(largest, (patientOf(index) - expected).norm());
  }
  return largest;
}

/// Cost of one import method, and deviation of its result from the written data.
struct Trial
{
  std::vector<double> seconds;
  double difference = 0.0; ///< HU
  double corner = 0.0;     ///< mm
};

struct OwnTrial : Trial
{
  std::vector<double> scanSeconds;
  double peakMb = 0.0;   ///< beyond the volume
  double fromPeer = 0.0; ///< HU
};

void runOwn(const fs::path& folder, const Voxels& truth, OwnTrial& trial, const short* peer)
{
  resetPeakMemory();
  const double before = residentMb();
  const Clock::time_point start = Clock::now();
  const ScanResult scan = scanDicom(folder, {});
  trial.scanSeconds.push_back(secondsSince(start));
  const volume::IntensityVolume image = readSeries(chooseSeries(scan, folder), {}, {});
  trial.seconds.push_back(secondsSince(start));
  const double volumeMb = static_cast<double>(image.bytes()) / 1e6;
  trial.peakMb = std::max(trial.peakMb, peakMb() - before - volumeMb);

  const auto& voxels = std::get<std::shared_ptr<const Voxels>>(image.voxels());
  trial.difference = largestDifference(voxels->data(), truth.data(), truth.size());
  if (peer)
    trial.fromPeer = largestDifference(voxels->data(), peer, truth.size());
  trial.corner = cornerDifference(
      truth.geometry(), [&](const core::Index3& i)
      { return image.geometry().patientFromVoxel(Eigen::Vector3d(i[0], i[1], i[2])); });
}

PeerImage::Pointer runPeer(const fs::path& folder, const Voxels& truth, Trial& trial)
{
  const Clock::time_point start = Clock::now();
  const PeerImage::Pointer image = importByPeer(folder);
  trial.seconds.push_back(secondsSince(start));
  trial.difference = largestDifference(image->GetBufferPointer(), truth.data(), truth.size());
  trial.corner =
      cornerDifference(truth.geometry(),
                       [&](const core::Index3& i)
                       {
                         PeerImage::PointType point;
                         image->TransformIndexToPhysicalPoint({{i[0], i[1], i[2]}}, point);
                         return Eigen::Vector3d(point[0], point[1], point[2]);
                       });
  return image;
}

core::BenchmarkPoint makePoint(const std::string& scene, const Trial& trial)
{
  core::BenchmarkPoint point;
  point.scene = scene;
  point.seconds = median(trial.seconds);
  point.error = trial.difference;
  point.errorUnit = "HU";
  point.extra["geometry_difference_mm"] = trial.corner;
  point.extra["slowest_seconds"] = *std::max_element(trial.seconds.begin(), trial.seconds.end());
  return point;
}

constexpr int kSeriesSlices = 500;

/// Series of small slices in folders of their own, an hour old. Returns their grid.
core::GridGeometry writeTree(const fs::path& folder, int series)
{
  const std::shared_ptr<const Voxels> image = makeImage(64, kSeriesSlices);
  for (int n = 0; n < series; ++n)
  {
    const auto uid = static_cast<std::uint64_t>(n);
    SeriesDescription description;
    description.description = "scan benchmark";
    description.studyUid = deterministicUid(uid, "scan.study");
    description.seriesUid = deterministicUid(uid, "scan.series");
    description.frameOfReferenceUid = deterministicUid(uid, "scan.frame");
    writeDicomSeries(folder / ("study" + std::to_string(n / 4)) / ("series" + std::to_string(n)),
                     volume::IntensityVolume(image), description);
  }
  const auto then = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      fs::last_write_time(entry.path(), then);
  return image->geometry();
}

struct ScanTrial
{
  std::vector<double> seconds;
  double worst = 0.0; ///< mm
};

void runScan(const fs::path& folder, const core::GridGeometry& truth, int series,
             core::DerivedStore* cache, ScanTrial& trial)
{
  const Clock::time_point start = Clock::now();
  const ScanResult scan = scanDicom(folder, {}, cache);
  trial.seconds.push_back(secondsSince(start));
  if (static_cast<int>(scan.series.size()) != series)
    trial.worst = std::numeric_limits<double>::infinity();
  for (const DicomSeries& one : scan.series)
    trial.worst =
        std::max(trial.worst, one.geometry.grid
                                  ? cornerDifference(truth,
                                                     [&](const core::Index3& i) {
                                                       return one.geometry.grid->patientFromVoxel(
                                                           Eigen::Vector3d(i[0], i[1], i[2]));
                                                     })
                                  : std::numeric_limits<double>::infinity());
}

/// The values that a series needs, read by gdcm::Scanner, which works on one thread.
void runScanner(const fs::path& folder, const core::GridGeometry& truth, ScanTrial& trial)
{
  const Clock::time_point start = Clock::now();
  gdcm::Directory directory;
  directory.Load(folder.string(), true);
  gdcm::Scanner scanner;
  const gdcm::Tag place(0x0020, 0x0032);
  for (const gdcm::Tag& tag :
       {place, gdcm::Tag(0x0020, 0x000e), gdcm::Tag(0x0020, 0x0013), gdcm::Tag(0x0020, 0x0037),
        gdcm::Tag(0x0020, 0x0052), gdcm::Tag(0x0028, 0x0010), gdcm::Tag(0x0028, 0x0011),
        gdcm::Tag(0x0028, 0x0030), gdcm::Tag(0x0028, 0x1052), gdcm::Tag(0x0028, 0x1053)})
    scanner.AddTag(tag);
  scanner.Scan(directory.GetFilenames());
  trial.seconds.push_back(secondsSince(start));
  for (const std::string& file : directory.GetFilenames())
  {
    const std::string name = fs::path(file).stem().string(); // "slice-0001"
    const auto k = core::parseDouble(name.substr(name.find('-') + 1));
    const char* position = scanner.GetValue(file.c_str(), place);
    std::string text(position ? position : "");
    text = text.substr(text.rfind('\\') + 1);
    text.erase(text.find_last_not_of(' ') + 1);
    const auto z = core::parseDouble(text);
    trial.worst = std::max(trial.worst,
                           k && z ? std::abs(truth.patientFromVoxel({0.0, 0.0, *k - 1.0})[2] - *z)
                                  : std::numeric_limits<double>::infinity());
  }
}

void addScanPoints(const fs::path& workFolder, bool quick, int rounds,
                   core::BenchmarkReport& report)
{
  const SeriesFolder folder(workFolder, "scan-benchmark");
  const int series = quick ? 1 : 10;
  const core::GridGeometry truth = writeTree(folder.path() / "files", series);
  fs::create_directories(folder.path() / "cache");
  library::DerivedCache cache(folder.path() / "cache" / "scans");
  ScanTrial first;
  ScanTrial second;
  ScanTrial peer;
  runScan(folder.path() / "files", truth, series, &cache, second); // fills the cache
  for (int round = -1; round < rounds; ++round)                    // the first fills the page cache
  {
    if (round == 0)
      first = second = peer = {};
    runScanner(folder.path() / "files", truth, peer);
    runScan(folder.path() / "files", truth, series, nullptr, first);
    runScan(folder.path() / "files", truth, series, &cache, second);
  }
  const std::string scene =
      std::to_string(series * kSeriesSlices) + " files, " + std::to_string(series) + " series";
  const auto add = [&](const ScanTrial& trial, const char* scanner, const char* name)
  {
    core::BenchmarkPoint point;
    point.scene = scene;
    point.setting["scanner"] = scanner;
    point.seconds = median(trial.seconds);
    point.error = trial.worst;
    point.errorUnit = "mm";
    point.peer = name;
    point.isDefault = *name == '\0' && &trial == &second;
    point.extra["slowest_seconds"] = *std::max_element(trial.seconds.begin(), trial.seconds.end());
    report.points.push_back(point);
  };
  add(first, "petrous, first scan", "");
  add(second, "petrous, second scan", "");
  add(peer, "gdcm, one thread", "gdcm::Scanner");
}

struct Syntax
{
  const char* name;
  gdcm::TransferSyntax::TSType type;
};

constexpr Syntax kSyntaxes[] = {{"RLE", gdcm::TransferSyntax::RLELossless},
                                {"JPEG lossless", gdcm::TransferSyntax::JPEGLosslessProcess14_1},
                                {"JPEG-LS lossless", gdcm::TransferSyntax::JPEGLSLossless},
                                {"JPEG 2000 lossless", gdcm::TransferSyntax::JPEG2000Lossless}};

/// False if GDCM cannot write it.
bool compress(const fs::path& from, const fs::path& to, gdcm::TransferSyntax::TSType type)
{
  gdcm::ImageReader reader;
  reader.SetFileName(from.c_str());
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(type);
  if (!reader.Read())
    return false;
  change.SetInput(reader.GetImage());
  if (!change.Change())
    return false;
  gdcm::ImageWriter writer;
  writer.SetFileName(to.c_str());
  writer.SetFile(reader.GetFile());
  writer.SetImage(change.GetOutput());
  return writer.Write();
}

/// The same slices in each lossless transfer syntax.
void addSyntaxPoints(const fs::path& workFolder, bool quick, int rounds,
                     core::BenchmarkReport& report)
{
  const int size = quick ? 128 : 512;
  const int slices = quick ? 8 : 64;
  const std::shared_ptr<const Voxels> truth = makeImage(size, slices);
  const SeriesFolder raw(workFolder, "syntax-benchmark");
  writeSeries(raw.path(), truth, {});
  for (const Syntax& syntax : kSyntaxes)
  {
    const SeriesFolder folder(workFolder, "packed-benchmark");
    fs::create_directories(folder.path());
    for (const auto& entry : fs::directory_iterator(raw.path()))
      if (!compress(entry.path(), folder.path() / entry.path().filename(), syntax.type))
        throw core::Error(core::Fault::Internal, std::string("GDCM does not write ") + syntax.name);
    OwnTrial own;
    Trial peer;
    for (int round = -1; round < rounds; ++round)
    {
      if (round == 0)
      {
        own = {};
        peer = {};
      }
      runPeer(folder.path(), *truth, peer);
      runOwn(folder.path(), *truth, own, nullptr);
    }
    const std::string scene = "CT " + std::to_string(size) + " x " + std::to_string(size) + " x " +
                              std::to_string(slices) + ", " + syntax.name;
    for (const bool isOurs : {true, false})
    {
      core::BenchmarkPoint point = makePoint(scene, isOurs ? own : peer);
      point.isDefault = isOurs;
      point.setting["reader"] = isOurs ? "petrous" : "itk";
      if (!isOurs)
        point.peer = "ITK series reader";
      point.extra["mb_per_second"] = static_cast<double>(truth->size()) * 2.0 / 1e6 / point.seconds;
      report.points.push_back(point);
    }
  }
}

} // namespace

core::BenchmarkReport runImportBenchmark(const fs::path& workFolder, bool quick,
                                         const core::Progress& progress)
{
  const int size = quick ? 256 : 512;
  const int slices = quick ? 64 : 512;
  const int rounds = quick ? 3 : 5;
  const SeriesFolder folder(workFolder);
  const std::shared_ptr<const Voxels> truth = makeImage(size, slices);
  writeSeries(folder.path(), truth, progress.part(0.0, 0.2));

  OwnTrial own;
  Trial peer;
  for (int round = -1; round < rounds; ++round) // the first fills the page cache
  {
    progress.report(0.2 + 0.8 * (round + 1.0) / (rounds + 1.0), "importing");
    if (round == 0)
    {
      own = {};
      peer = {};
    }
    // The last round keeps the peer's image beside ours for comparison.
    PeerImage::Pointer image = runPeer(folder.path(), *truth, peer);
    const bool last = round == rounds - 1;
    if (!last)
      image = nullptr;
    runOwn(folder.path(), *truth, own, last ? image->GetBufferPointer() : nullptr);
  }

  core::BenchmarkReport report;
  report.name = "import";
  report.title = "DICOM import: headers, geometry verdict and voxels";
  const std::string scene = "CT " + std::to_string(size) + " x " + std::to_string(size) + " x " +
                            std::to_string(slices) + ", uncompressed";
  core::BenchmarkPoint ours = makePoint(scene, own);
  ours.isDefault = true;
  ours.setting["reader"] = "petrous";
  ours.extra["scan_seconds"] = median(own.scanSeconds);
  ours.extra["peak_mb_above_volume"] = own.peakMb;
  ours.extra["difference_from_peer_hu"] = own.fromPeer;
  core::BenchmarkPoint theirs = makePoint(scene, peer);
  theirs.setting["reader"] = "itk";
  theirs.peer = "ITK series reader";
  report.points = {ours, theirs};
  addSyntaxPoints(workFolder, quick, rounds, report);
  addScanPoints(workFolder, quick, rounds, report);
  return report;
}

} // namespace petrous::imaging
