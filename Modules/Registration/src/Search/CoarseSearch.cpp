#include "CoarseSearch.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "BfgsOptimizer.h"
#include "MutualInformation.h"
#include "RigidParametrization.h"

namespace petrous::registration
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr int kSearchBins = 16; // few samples fill only few bins
constexpr double kReach = 26.0; // mm, step of the translation grid
constexpr double kMinOverlap = 0.2;

// Identity and rotations of 22 and 42 degrees about 13 axes, in both directions: no rotation within
// 45 degrees is further than about 15 degrees from one of them.
std::vector<Eigen::Quaterniond> turns()
{
  std::vector<Eigen::Quaterniond> list{Eigen::Quaterniond::Identity()};
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          for (const double degrees : {22.0, 42.0})
            list.emplace_back(
                Eigen::AngleAxisd(degrees * kPi / 180.0, Eigen::Vector3d(x, y, z).normalized()));
  return list;
}

double scored(double information, double overlap, std::size_t samples)
{
  if (overlap < kMinOverlap)
    return 0.0;
  const double bias = informationBias(kSearchBins, overlap * static_cast<double>(samples));
  return poseScore(information - bias, overlap);
}

Eigen::Vector3d contentCentre(const LevelImage& level, const core::IndexBox& box)
{
  Eigen::Vector3d middle;
  for (std::size_t a = 0; a < 3; ++a)
    middle[static_cast<Eigen::Index>(a)] = 0.5 * (box.lower[a] + box.upper[a] - 1);
  return level.grid().patientFromVoxel(middle);
}

Eigen::Vector3d massCentre(const LevelImage& level, const core::IndexBox& box)
{
  double mass = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        const float v = level.voxels.at(i, j, k);
        if (std::isnan(v))
          continue;
        const double m = std::clamp(v, level.low, level.high) - level.low;
        mass += m;
        sum += m * Eigen::Vector3d(i, j, k);
      }
  return mass > 0.0 ? level.grid().patientFromVoxel(sum / mass) : contentCentre(level, box);
}

} // namespace

std::vector<core::RigidTransform> centredStarts(const ImagePair& pair)
{
  const LevelImage& fixed = pair.fixed.levels.front();
  const LevelImage& moving = pair.moving.levels.front();
  const core::IndexBox& fixedBox = pair.fixed.content.front();
  const core::IndexBox& movingBox = pair.moving.content.front();
  const auto shift = [](const Eigen::Vector3d& by)
  { return core::RigidTransform(Eigen::Quaterniond::Identity(), by); };
  return {shift(contentCentre(moving, movingBox) - contentCentre(fixed, fixedBox)),
          shift(massCentre(moving, movingBox) - massCentre(fixed, fixedBox))};
}

std::vector<Candidate> searchCandidates(const ImagePair& pair,
                                        const std::vector<core::RigidTransform>& starts,
                                        const SearchOptions& options,
                                        const core::Progress& progress)
{
  const LevelImage& moving = pair.moving.levels.front();
  const FixedSamples samples = drawSamples(pair.fixed.levels.front(), pair.fixed.content.front(),
                                           options.samples, options.seed, kSearchBins);
  const MutualInformation metric(samples, moving, kSearchBins);

  std::vector<core::RigidTransform> poses;
  const double reach = std::min(kReach, 0.5 * samples.radius);
  for (std::size_t s = 0; s < starts.size(); ++s)
    for (const Eigen::Quaterniond& turn : turns())
      for (int n = 0; n < (s == 0 ? 27 : 7); ++n)
      {
        Eigen::Vector3d by = Eigen::Vector3d::Zero();
        if (s == 0)
          by = reach * Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        else if (n > 0)
          by[(n - 1) / 2] = n % 2 ? reach : -reach;
        const Eigen::Quaterniond rotation = turn * starts[s].rotation();
        const Eigen::Vector3d mapped = starts[s] * samples.centre + by;
        poses.emplace_back(rotation, mapped - rotation * samples.centre);
      }

  std::vector<Candidate> grid(poses.size());
  tbb::parallel_for(std::size_t{0}, poses.size(),
                    [&](std::size_t n)
                    {
                      double overlap = 0.0;
                      const double information = metric.value(poses[n], &overlap);
                      grid[n] = {poses[n], scored(information, overlap, samples.size())};
                    });
  progress.report(0.4, "coarse search");

  const auto better = [](const Candidate& a, const Candidate& b) { return a.score > b.score; };
  std::stable_sort(grid.begin(), grid.end(), better);
  std::vector<Candidate> candidates(grid.begin(),
                                    grid.begin() + std::min(options.climbs, grid.size()));
  // The starts themselves are always optimized.
  for (const core::RigidTransform& start : starts)
    candidates.push_back({start, 0.0});
  BfgsOptions climb;
  climb.evaluations = 25;
  climb.change = 1e-4;
  climb.firstStep = 0.5 * pair.scales.front();
  tbb::parallel_for(
      std::size_t{0}, candidates.size(),
      [&](std::size_t n)
      {
        const Optimum top = maximize(metric, candidates[n].pose, climb);
        candidates[n] = {top.pose, scored(top.information, top.overlap, samples.size())};
      });
  progress.report(1.0, "coarse search");

  std::stable_sort(candidates.begin(), candidates.end(), better);
  std::vector<Candidate> kept;
  const double apart = 1.5 * pair.scales.front();
  for (const Candidate& candidate : candidates)
    if (kept.size() < options.keep && std::none_of(kept.begin(), kept.end(),
                                                   [&](const Candidate& other) {
                                                     return poseDistance(candidate.pose, other.pose,
                                                                         samples.centre,
                                                                         samples.radius) < apart;
                                                   }))
      kept.push_back(candidate);
  return kept;
}

} // namespace petrous::registration
