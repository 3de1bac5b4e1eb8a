#include "Surroundings.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "BfgsOptimizer.h"
#include "MutualInformation.h"

namespace petrous::registration
{

namespace
{

constexpr double kRadii[] = {10.0, 18.0, 30.0}; // mm
constexpr double kReach = 9.0;                  // mm, maximum of the shifts tried
constexpr double kStep = 2.0;                   // mm between the shifts
constexpr std::size_t kClimbs = 6;              // optimizations from the best shifts
constexpr double kMinOverlap = 0.7;             // of a ball with the MR
constexpr int kLocalBins = 16;                  // a ball of 10 mm has 2,000 voxels
constexpr std::size_t kDrawn = 9000;            // samples in the bounding box of a ball
constexpr std::size_t kFewest = 500;            // required number of samples with a value
constexpr int kBlocks = 4;                      // along each axis, for the bootstrap
constexpr int kDraws = 16;                      // of the bootstrap
// Minimum relative information gain: calibrated (Documentation/adr).
constexpr double kGain = 0.13;

using Shift = Eigen::Vector3d; // MR patient mm, added to the translation of a pose

core::IndexBox boxAbout(const core::GridGeometry& grid, const Eigen::Vector3d& centre,
                        double radius)
{
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  return grid.boxCovering(centre - half, centre + half).intersected(grid.fullBox());
}

// A ball of the CT and the part of the MR to which it may be displaced, each with its own intensity
// range: that of the whole image would leave a bin or two for the dark of bone and air.
class Ball
{
public:
  Ball(const LevelImage& ct, const LevelImage& mr, const core::RigidTransform& pose,
       const Eigen::Vector3d& centre, double radius, double voxel, std::uint32_t seed)
    : m_pose(pose)
    , m_centre(centre)
    , m_voxel(voxel)
    , m_seed(seed)
  {
    const core::IndexBox here = boxAbout(ct.grid(), centre, radius);
    const core::IndexBox there = boxAbout(mr.grid(), pose * centre, radius + kReach + voxel);
    if (here.empty() || there.empty())
      return;
    const LevelImage part = croppedLevel(ct, here);
    m_mr = croppedLevel(mr, there);
    if (!(part.high > part.low) || !(m_mr->high > m_mr->low))
      return;
    m_samples =
        within(drawSamples(part, part.grid().fullBox(), kDrawn, seed, kLocalBins), centre, radius);
  }

  std::optional<LocalFit> fit() const
  {
    if (m_samples.size() < kFewest)
      return std::nullopt;
    const MutualInformation metric(m_samples, *m_mr, kLocalBins);
    double overlap = 0.0;
    const double whole = metric.value(m_pose, &overlap);
    if (overlap < kMinOverlap)
      return std::nullopt;
    const std::vector<Optimum> tops = climbs(metric, startsOf(metric));
    if (tops.empty())
      return std::nullopt;
    const auto best = std::max_element(tops.begin(), tops.end(), lower);
    LocalFit result;
    result.offset = shiftOf(*best);
    result.gain = best->information > 0.0 ? 1.0 - whole / best->information : 0.0;
    measureError({tops.front().pose, best->pose}, result);
    return result;
  }

private:
  static bool lower(const Optimum& a, const Optimum& b) { return a.information < b.information; }

  core::RigidTransform shifted(const Shift& by) const
  {
    return {m_pose.rotation(), m_pose.translation() + by};
  }

  Shift shiftOf(const Optimum& top) const { return top.pose * m_centre - m_pose * m_centre; }

  Optimum climb(const MutualInformation& metric, const core::RigidTransform& start) const
  {
    BfgsOptions options;
    options.turns = false;
    options.evaluations = 25;
    options.change = 1e-5;
    options.firstStep = 0.5 * m_voxel;
    options.maxStep = 2.0 * m_voxel;
    return maximize(metric, start, options);
  }

  // The pose of the global fit, and the best shifts of a grid that are not neighbours.
  std::vector<core::RigidTransform> startsOf(const MutualInformation& metric) const
  {
    std::vector<Shift> grid;
    constexpr int steps = static_cast<int>(kReach / kStep);
    for (int z = -steps; z <= steps; ++z)
      for (int y = -steps; y <= steps; ++y)
        for (int x = -steps; x <= steps; ++x)
          if (const Shift by = kStep * Shift(x, y, z); by.norm() <= kReach)
            grid.push_back(by);
    std::vector<std::pair<double, std::size_t>> scores(grid.size());
    tbb::parallel_for(std::size_t{0}, grid.size(),
                      [&](std::size_t n)
                      {
                        double overlap = 0.0;
                        const double information = metric.value(shifted(grid[n]), &overlap);
                        scores[n] = {overlap < kMinOverlap ? 0.0 : -information, n};
                      });
    std::sort(scores.begin(), scores.end());
    std::vector<Shift> kept{Shift::Zero()};
    for (const auto& [score, n] : scores)
      if (kept.size() < kClimbs && std::none_of(kept.begin(), kept.end(),
                                                [&, n = n](const Shift& other)
                                                { return (other - grid[n]).norm() < 2.0 * kStep; }))
        kept.push_back(grid[n]);
    std::vector<core::RigidTransform> starts;
    for (const Shift& by : kept)
      starts.push_back(shifted(by));
    return starts;
  }

  // The optima within reach; the information of a small remaining overlap may grow without bound.
  std::vector<Optimum> climbs(const MutualInformation& metric,
                              const std::vector<core::RigidTransform>& starts) const
  {
    std::vector<Optimum> tops(starts.size());
    tbb::parallel_for(std::size_t{0}, starts.size(),
                      [&](std::size_t n) { tops[n] = climb(metric, starts[n]); });
    tops.erase(std::remove_if(tops.begin(), tops.end(),
                              [&](const Optimum& top) {
                                return top.overlap < kMinOverlap || shiftOf(top).norm() > kReach;
                              }),
               tops.end());
    return tops;
  }

  // Each bootstrap ends at the better of the competing maxima, so that two equal ones show as
  // spread.
  void measureError(const std::vector<core::RigidTransform>& rivals, LocalFit& result) const
  {
    std::vector<Shift> ends(kDraws);
    tbb::parallel_for(std::size_t{0}, ends.size(),
                      [&](std::size_t n)
                      {
                        const FixedSamples drawn = bootstrap(
                            m_samples, kBlocks, m_seed + 31 * static_cast<std::uint32_t>(n + 1));
                        const MutualInformation metric(drawn, *m_mr, kLocalBins);
                        std::vector<Optimum> tops;
                        for (const core::RigidTransform& rival : rivals)
                          tops.push_back(climb(metric, rival));
                        ends[n] = shiftOf(*std::max_element(tops.begin(), tops.end(), lower));
                      });
    const double length = result.offset.norm();
    double along = 0.0, all = 0.0;
    for (const Shift& end : ends)
    {
      const Shift off = end - result.offset;
      const double part = length > 0.0 ? off.dot(result.offset) / length : 0.0;
      along += part * part / kDraws;
      all += off.squaredNorm() / kDraws;
    }
    result.error = std::sqrt(along);
    result.spread = std::sqrt(all);
  }

  core::RigidTransform m_pose;
  Eigen::Vector3d m_centre;
  double m_voxel;
  std::uint32_t m_seed;
  FixedSamples m_samples;
  std::optional<LevelImage> m_mr;
};

} // namespace

std::vector<LocalFit> fitSurroundings(const ImagePair& pair, const core::RigidTransform& mrFromCt,
                                      const Eigen::Vector3d& ctPoint, std::uint32_t seed,
                                      const core::Progress& progress)
{
  const Pyramid& ct = pair.fixedIsCt ? pair.fixed : pair.moving;
  const Pyramid& mr = pair.fixedIsCt ? pair.moving : pair.fixed;
  std::vector<LocalFit> fits;
  for (const double radius : kRadii)
  {
    progress.check("registration's surroundings");
    const Ball ball(ct.finest(), mr.finest(), mrFromCt, ctPoint, radius, pair.scales.back(), seed);
    if (auto fit = ball.fit())
    {
      fit->radius = radius;
      fits.push_back(*fit);
    }
  }
  return fits;
}

std::optional<LocalFit> displacedPart(const std::vector<LocalFit>& fits, double least)
{
  const auto found =
      std::find_if(fits.begin(), fits.end(),
                   [least](const LocalFit& fit)
                   { return fit.gain > kGain && fit.offset.norm() - 2.0 * fit.error > least; });
  return found == fits.end() ? std::nullopt : std::optional<LocalFit>(*found);
}

} // namespace petrous::registration
