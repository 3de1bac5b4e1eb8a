#include "CutBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::dissection
{

namespace
{

constexpr double kRadius = 2.0;
constexpr double kPi = 3.14159265358979323846;

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

struct Outcome
{
  std::vector<double> seconds;
  double worst = 0.0; ///< largest relative volume error
  double mean = 0.0;  ///< mean signed relative volume error

  void add(double volume, double time, int count)
  {
    const double error = volume / (4.0 / 3.0 * kPi * std::pow(kRadius, 3)) - 1.0;
    seconds.push_back(time);
    worst = std::max(worst, std::abs(error));
    mean += error / count;
  }
};

// Deletes whole voxels whose centre is inside the sphere, as voxel-deleting simulators do.
double deleteVoxels(volume::Volume<std::uint8_t>& bone, const Eigen::Vector3d& center)
{
  const auto& grid = bone.geometry();
  const Eigen::Vector3d r = Eigen::Vector3d::Constant(kRadius);
  const core::IndexBox box = grid.boxCovering(center - r, center + r);
  std::size_t removed = 0;
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        const Eigen::Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        auto& voxel = bone.at(i, j, k);
        if (voxel && (p - center).squaredNorm() <= kRadius * kRadius)
        {
          voxel = 0;
          ++removed;
        }
      }
  return static_cast<double>(removed) * grid.voxelVolume();
}

core::BenchmarkPoint pointOf(const Outcome& outcome, double h, const std::string& peer)
{
  core::BenchmarkPoint point;
  point.setting["voxel_mm"] = core::fixedText(h, 2);
  point.scene = "sphere of 4 mm in solid bone";
  point.isDefault = h == 0.3 && peer.empty();
  point.seconds = median(outcome.seconds);
  point.error = 100.0 * outcome.worst;
  point.errorUnit = "% of the volume, worst of all places";
  point.peer = peer;
  point.extra["mean_error_percent"] = 100.0 * outcome.mean;
  return point;
}

} // namespace

core::BenchmarkReport runCutBenchmark(const std::filesystem::path&, bool quick,
                                      const core::Progress& progress)
{
  core::BenchmarkReport report{"cut", "Volume of a 4 mm sphere cut from bone", {}};
  const int places = quick ? 8 : 40;
  std::vector<double> spacings{0.1, 0.15, 0.2, 0.3, 0.4, 0.6};
  if (quick)
    spacings = {0.2, 0.3, 0.4};
  for (std::size_t s = 0; s < spacings.size(); ++s)
  {
    const double h = spacings[s];
    const int n = static_cast<int>(std::ceil((2.0 * kRadius + 8.0 * h) / h)) + 2;
    const core::GridGeometry grid({n, n, n}, Eigen::Vector3d::Constant(h),
                                  Eigen::Vector3d::Constant(-0.5 * h * (n - 1)));
    const auto bone = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{1500}));
    const volume::TissueField tissue(bone, {}, nullptr, {});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.5 * h, 0.5 * h);
    Outcome ours, deleting;
    for (int place = 0; place < places; ++place)
    {
      progress.report((static_cast<double>(s) + place / static_cast<double>(places)) /
                          static_cast<double>(spacings.size()),
                      "cutting spheres");
      const Eigen::Vector3d center(shift(random), shift(random), shift(random));
      const volume::CutMask before(grid);
      volume::CutMask mask = before;
      const auto start = Clock::now();
      const auto bricks = cut(mask, {center, center, kRadius});
      const std::chrono::duration<double> time = Clock::now() - start;
      ours.add(measureRemoved(tissue, before, mask, bricks, {}).total, time.count(), places);

      volume::Volume<std::uint8_t> voxels(grid, std::uint8_t{1});
      const auto peerStart = Clock::now();
      const double deleted = deleteVoxels(voxels, center);
      const std::chrono::duration<double> peerTime = Clock::now() - peerStart;
      deleting.add(deleted, peerTime.count(), places);
    }
    report.points.push_back(pointOf(ours, h, ""));
    report.points.push_back(pointOf(deleting, h, "whole voxels deleted"));
  }
  return report;
}

} // namespace petrous::dissection
