#include "TiltBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageSeriesReader.h>

#include "ChildProcess.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/ImageFile.h"

namespace petrous::imaging
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;

constexpr double kRadius = 2.5; // mm, of a ball

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A scan: slice k lies at k times the table's step, which is along z, from the first.
struct Scan
{
  core::GridGeometry grid; ///< its slices' axes; its third spacing is the table's step
  Vector3d step;
  std::vector<Vector3d> balls;

  Vector3d positionOf(double i, double j, double k) const
  {
    return grid.patientFromVoxel(Vector3d(i, j, 0.0)) + k * step;
  }
};

Scan scanAt(double degrees, bool quick)
{
  const int edge = quick ? 96 : 144;
  const int slices = quick ? 72 : 108;
  constexpr double kStep = 0.6;
  const double angle = degrees * 3.14159265358979323846 / 180.0;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); // turned about x
  axes(1, 1) = axes(2, 2) = std::cos(angle);
  axes(2, 1) = std::sin(angle);
  axes(1, 2) = -std::sin(angle);
  Scan scan{{{edge, edge, slices}, {0.5, 0.5, kStep}, {-30.2, -41.3, 512.7}, axes},
            Vector3d(0.0, 0.0, kStep),
            {}};
  for (const double i : {0.25, 0.5, 0.75})
    for (const double j : {0.25, 0.5, 0.75})
      for (const double k : {0.25, 0.5, 0.75}) // between the voxels, each elsewhere
        scan.balls.push_back(
            scan.positionOf(i * edge + 3.1 * k, j * edge + 2.3 * i, k * slices + 1.7 * j));
  return scan;
}

volume::IntensityVolume imageOf(const Scan& scan)
{
  auto image = std::make_shared<volume::Volume<std::int16_t>>(scan.grid);
  const core::Index3& dims = scan.grid.dims();
  constexpr double kBlur = 0.4; // mm
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
      {
        const Vector3d p = scan.positionOf(i, j, k);
        double nearest = std::numeric_limits<double>::max();
        for (const Vector3d& ball : scan.balls)
          nearest = std::min(nearest, (p - ball).norm() - kRadius);
        image->at(i, j, k) = static_cast<std::int16_t>(
            std::lround(1500.0 * 0.5 * std::erfc(nearest / (std::sqrt(2.0) * kBlur))));
      }
  return volume::IntensityVolume(image);
}

struct Errors
{
  double mean = 0.0; ///< voxels
  double largest = 0.0;
};

/// Centres of density near the balls' true places, sought within half their distance.
Errors errorsOf(const volume::IntensityVolume& image, const std::vector<Vector3d>& balls)
{
  const core::GridGeometry& grid = image.geometry();
  constexpr double kReach = 4.5; // mm
  Errors errors;
  for (const Vector3d& ball : balls)
  {
    const Vector3d center = grid.voxelFromPatient(ball);
    core::Index3 lower;
    core::Index3 upper;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const double reach = kReach / grid.spacing()[axis];
      lower[a] = std::clamp(static_cast<int>(center[axis] - reach), 0, grid.dims()[a] - 1);
      upper[a] = std::clamp(static_cast<int>(center[axis] + reach) + 1, 0, grid.dims()[a] - 1);
    }
    Vector3d sum = Vector3d::Zero();
    double weight = 0.0;
    for (int k = lower[2]; k <= upper[2]; ++k)
      for (int j = lower[1]; j <= upper[1]; ++j)
        for (int i = lower[0]; i <= upper[0]; ++i)
        {
          const Vector3d voxel(i, j, k);
          const double value = image.at(i, j, k);
          if (value == image.padding() || value <= 0.0 ||
              (grid.patientFromVoxel(voxel) - ball).norm() > kReach)
            continue;
          sum += value * voxel;
          weight += value;
        }
    const double off =
        weight > 0.0 ? (sum / weight - center).norm() : std::numeric_limits<double>::infinity();
    errors.mean += off / static_cast<double>(balls.size());
    errors.largest = std::max(errors.largest, off);
  }
  return errors;
}

/// The balls by the grid that ITK's series reader gives to the slices.
Errors errorsByItk(const fs::path& folder, const Scan& scan)
{
  using PeerImage = itk::Image<short, 3>;
  auto names = itk::GDCMSeriesFileNames::New();
  names->SetDirectory(folder.string());
  auto reader = itk::ImageSeriesReader<PeerImage>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names->GetInputFileNames());
  reader->Update();
  Errors errors;
  for (const Vector3d& ball : scan.balls)
  {
    // Position in the slices: how far up the table's way, then within the slice.
    const double k = (ball - scan.grid.origin()).dot(scan.grid.direction().col(2)) /
                     scan.step.dot(scan.grid.direction().col(2));
    const Vector3d inSlice = scan.grid.voxelFromPatient(ball - k * scan.step);
    itk::ContinuousIndex<double, 3> index;
    index[0] = inSlice[0];
    index[1] = inSlice[1];
    index[2] = k;
    PeerImage::PointType found;
    reader->GetOutput()->TransformContinuousIndexToPhysicalPoint(index, found);
    Vector3d off =
        scan.grid.direction().transpose() * (Vector3d(found[0], found[1], found[2]) - ball);
    for (unsigned a = 0; a < 3; ++a)
      off[a] /= reader->GetOutput()->GetSpacing()[a];
    errors.mean += off.norm() / static_cast<double>(scan.balls.size());
    errors.largest = std::max(errors.largest, off.norm());
  }
  return errors;
}

} // namespace

core::BenchmarkReport runTiltBenchmark(const fs::path& workFolder, bool quick,
                                       const core::Progress& progress)
{
  core::BenchmarkReport report;
  report.name = "tilt";
  report.title = "Repair of a tilted gantry: where 27 balls of a phantom are found";
  std::vector<double> angles;
  for (double angle = -30.0; angle <= 30.0; angle += quick ? 15.0 : 5.0)
    angles.push_back(angle);
  const bool hasConverter = registration::runProcess({"dcm2niix", "-h"}).status == 0;
  report.machine["dcm2niix"] = hasConverter ? "a process of its own" : "not installed";
  for (std::size_t n = 0; n < angles.size(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(angles.size()), "measure tilts");
    const Scan scan = scanAt(angles[n], quick);
    const fs::path folder = workFolder / ("tilt-" + std::to_string(n));
    SeriesDescription description;
    description.description = "tilt";
    description.studyUid = deterministicUid(n, "tilt.study");
    description.seriesUid = deterministicUid(n, "tilt.series");
    description.frameOfReferenceUid = deterministicUid(n, "tilt.frame");
    writeDicomSeries(folder, imageOf(scan), description, scan.step);

    core::BenchmarkPoint point;
    point.scene = "phantom of balls, " + std::to_string(scan.grid.dims()[2]) + " slices";
    point.setting["tilt_degrees"] = core::generalText(angles[n]);
    point.errorUnit = "voxels, largest of 27";
    const auto add = [&](const std::string& peer, double seconds, const Errors& errors)
    {
      point.peer = peer;
      point.isDefault = peer.empty();
      point.seconds = seconds;
      point.error = errors.largest;
      point.extra["mean_voxels"] = errors.mean;
      report.points.push_back(point);
    };
    Clock::time_point start = Clock::now();
    ReadOptions options;
    options.repair = true;
    const volume::IntensityVolume image =
        readSeries(chooseSeries(scanDicom(folder, {}), folder), options, {});
    const double seconds = secondsSince(start);
    add("", seconds, errorsOf(image, scan.balls));
    start = Clock::now();
    const Errors straight = errorsByItk(folder, scan);
    add("itk::ImageSeriesReader", secondsSince(start), straight);
    if (hasConverter)
    {
      const fs::path out = workFolder / ("nifti-" + std::to_string(n));
      fs::create_directories(out);
      const auto times = registration::runProcess(
          {"dcm2niix", "-z", "n", "-f", "tilt", "-o", out.string(), folder.string()});
      for (const auto& entry : fs::directory_iterator(out))
      {
        const std::string name = entry.path().filename().string();
        // Beside the slices as they are it writes them corrected.
        if (entry.path().extension() == ".nii" &&
            (angles[n] == 0.0 || name.find("Tilt") != std::string::npos))
          add("dcm2niix", times.seconds, errorsOf(*readImageFile(entry.path()).volume, scan.balls));
      }
      fs::remove_all(out);
    }
    fs::remove_all(folder);
  }
  return report;
}

} // namespace petrous::imaging
