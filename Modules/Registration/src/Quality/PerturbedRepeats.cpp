#include "PerturbedRepeats.h"

#include <cmath>
#include <random>

#include <tbb/parallel_for.h>

#include "BfgsOptimizer.h"
#include "MutualInformation.h"

namespace petrous::registration
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

// The part of a level's content covered by the other image at a pose.
core::IndexBox sharedBox(const Pyramid& here, const Pyramid& other,
                         const core::RigidTransform& hereFromOther)
{
  const core::GridGeometry& grid = other.finest().grid();
  const core::IndexBox& box = other.content.back();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9);
  Eigen::Vector3d high = -low;
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d voxel;
    for (std::size_t a = 0; a < 3; ++a)
      voxel[static_cast<Eigen::Index>(a)] = corner >> a & 1 ? box.upper[a] - 1 : box.lower[a];
    const Eigen::Vector3d p = hereFromOther * grid.patientFromVoxel(voxel);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const core::IndexBox covered = here.finest().grid().boxCovering(low, high);
  const core::IndexBox both = covered.intersected(here.content.back());
  return both.empty() ? here.content.back() : both;
}

core::RigidTransform perturbed(const core::RigidTransform& pose, const Eigen::Vector3d& centre,
                               const PerturbedRepeatsOptions& options, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const auto vector = [&]
  { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  const Eigen::Vector3d axis = vector().normalized();
  const Eigen::Vector3d by = options.shift * vector().normalized();
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(options.degrees * kPi / 180.0, axis)) * pose.rotation();
  return {rotation, pose * centre + by - rotation * centre};
}

// One repeat: new samples in a box of the fixed image, a perturbed start. Returns the pose from
// fixed to moving points.
core::RigidTransform fitAgain(const LevelImage& fixed, const core::IndexBox& box,
                              const LevelImage& moving, const core::RigidTransform& pose,
                              double scale, std::uint32_t seed, int blocks,
                              const PerturbedRepeatsOptions& options)
{
  std::mt19937 random(seed);
  FixedSamples samples = drawSamples(fixed, box, options.samples, seed, options.bins);
  if (blocks > 0)
    samples = bootstrap(samples, blocks, seed + 1);
  const MutualInformation metric(samples, moving, options.bins);
  BfgsOptions climb;
  climb.evaluations = 30;
  climb.change = 1e-5;
  climb.firstStep = 0.5 * scale;
  climb.maxStep = 4.0 * scale;
  return maximize(metric, perturbed(pose, samples.centre, options, random), climb).pose;
}

} // namespace

std::vector<core::RigidTransform> repeatFit(const ImagePair& pair,
                                            const core::RigidTransform& mrFromCt,
                                            const PerturbedRepeatsOptions& options,
                                            const core::Progress& progress)
{
  const core::RigidTransform forward = pair.movingFromFixed(mrFromCt);
  const core::RigidTransform backward = forward.inverse();
  const core::IndexBox swappedBox = sharedBox(pair.moving, pair.fixed, forward);
  std::vector<core::RigidTransform> fits(static_cast<std::size_t>(options.count));
  tbb::parallel_for(std::size_t{0}, fits.size(),
                    [&](std::size_t n)
                    {
                      progress.check("registration's error");
                      const bool swapped = n % 2 == 1;
                      const Pyramid& fixed = swapped ? pair.moving : pair.fixed;
                      const Pyramid& moving = swapped ? pair.fixed : pair.moving;
                      const auto seed = options.seed + 7919 * static_cast<std::uint32_t>(n + 1);
                      const core::RigidTransform top =
                          fitAgain(fixed.finest(), swapped ? swappedBox : fixed.content.back(),
                                   moving.finest(), swapped ? backward : forward,
                                   pair.scales.back(), seed, options.blocks, options);
                      fits[n] = pair.mrFromCt(swapped ? top.inverse() : top);
                    });
  return fits;
}

std::vector<core::RigidTransform> fitAround(const ImagePair& pair,
                                            const core::RigidTransform& mrFromCt,
                                            const Eigen::Vector3d& ctPoint, double radius,
                                            const PerturbedRepeatsOptions& options)
{
  const core::RigidTransform forward = pair.movingFromFixed(mrFromCt);
  const Eigen::Vector3d centre = pair.fixedIsCt ? ctPoint : mrFromCt * ctPoint;
  const core::GridGeometry& grid = pair.fixed.finest().grid();
  const core::IndexBox box = grid.boxCovering(centre - Eigen::Vector3d::Constant(radius),
                                              centre + Eigen::Vector3d::Constant(radius))
                                 .intersected(pair.fixed.content.back());
  if (box.empty())
    return {};
  std::vector<core::RigidTransform> fits(static_cast<std::size_t>(options.count));
  tbb::parallel_for(std::size_t{0}, fits.size(),
                    [&](std::size_t n)
                    {
                      const auto seed = options.seed + 104729 * static_cast<std::uint32_t>(n + 1);
                      fits[n] =
                          pair.mrFromCt(fitAgain(pair.fixed.finest(), box, pair.moving.finest(),
                                                 forward, pair.scales.back(), seed, 0, options));
                    });
  return fits;
}

} // namespace petrous::registration
