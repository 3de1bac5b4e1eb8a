#include "ImportBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <string>

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageSeriesReader.h>

#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomWriter.h"

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

/// A value from /proc/self/status in MB (1e6 bytes); 0 if unavailable.
double memoryMb(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name + ":", 0) == 0)
      return static_cast<double>(std::stoll(line.substr(name.size() + 1))) * 1024.0 / 1e6;
  return 0.0;
}

void resetPeakMemory()
{
  std::ofstream("/proc/self/clear_refs") << "5";
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
  explicit SeriesFolder(const fs::path& parent)
    : m_path(parent / "import-benchmark")
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
  const double before = memoryMb("VmRSS");
  const Clock::time_point start = Clock::now();
  const ScanResult scan = scanDicom(folder, {});
  trial.scanSeconds.push_back(secondsSince(start));
  const volume::IntensityVolume image = readSeries(chooseSeries(scan, folder), {}, {});
  trial.seconds.push_back(secondsSince(start));
  const double volumeMb = static_cast<double>(image.bytes()) / 1e6;
  trial.peakMb = std::max(trial.peakMb, memoryMb("VmHWM") - before - volumeMb);

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
  return report;
}

} // namespace petrous::imaging
