#include "QualityFeatures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ErrorModel.h"
#include "MutualInformation.h"
#include "PerturbedRepeats.h"

namespace petrous::registration
{

namespace
{

constexpr double kSurroundings = 30.0; // mm, radius of the local fits about the point
constexpr double kShareOfField = 0.35; // at most, of the narrowest side of the smaller field
constexpr int kLocalFits = 6;
constexpr double kStray = 5.0;     // voxels of the finest level; repeats further off are strays
constexpr double kDisplaced = 0.6; // mm; see displacedPart

// A pyramid mirrored left to right, about the centre of its finest grid.
Pyramid mirrored(const Pyramid& pyramid)
{
  Pyramid result;
  result.content = pyramid.content;
  const Eigen::Vector3d middle = pyramid.finest().grid().center();
  const Eigen::Vector3d flip(-1.0, 1.0, 1.0);
  for (const LevelImage& level : pyramid.levels)
  {
    const core::GridGeometry& grid = level.grid();
    Eigen::Vector3d origin = grid.origin();
    origin[0] = 2.0 * middle[0] - origin[0];
    const core::GridGeometry turned(grid.dims(), grid.spacing(), origin,
                                    flip.asDiagonal() * grid.direction());
    volume::Volume<float> voxels(turned);
    std::copy_n(level.voxels.data(), level.voxels.size(), voxels.data());
    result.levels.push_back({std::move(voxels), level.low, level.high, level.valid});
  }
  return result;
}

ImagePair coarsePart(const ImagePair& pair, std::size_t levels)
{
  const auto cut = [levels](const Pyramid& pyramid)
  {
    Pyramid result;
    for (std::size_t n = 0; n < levels; ++n)
    {
      result.levels.push_back(pyramid.levels[n]);
      result.content.push_back(pyramid.content[n]);
    }
    return result;
  };
  ImagePair part{cut(pair.fixed), cut(pair.moving), pair.fixedIsCt, pair.scales};
  part.scales.resize(levels);
  return part;
}

// Ratio of the best scores at the coarser levels, mirrored to unmirrored.
double mirrorShare(const ImagePair& pair, const core::RigidTransform& mrFromCt,
                   const FitOptions& options, const core::Progress& progress)
{
  const std::size_t levels = std::max<std::size_t>(1, pair.levels() - 1);
  ImagePair part = coarsePart(pair, levels);
  FitOptions again = options;
  again.start = Start::Given;
  again.given = mrFromCt;
  again.search = false;
  again.schedule.polish = 0; // only the scores are compared, not the poses
  const Fit straight = fitPair(part, again, progress.part(0.0, 0.3), {}).fit;
  part.moving = mirrored(part.moving);
  again.search = true;
  again.start = Start::Centres;
  const Fit turned = fitPair(part, again, progress.part(0.3, 1.0), {}).fit;
  const double reference = poseScore(straight.metric, straight.overlap);
  return reference > 0.0 ? poseScore(turned.metric, turned.overlap) / reference : 1.0;
}

double asideOf(const ImagePair& pair, const core::RigidTransform& mrFromCt,
               const Eigen::Vector3d& at, PerturbedRepeatsOptions repeat)
{
  repeat.count = kLocalFits;
  const core::GridGeometry& grid = pair.fixed.finest().grid();
  double side = 1e9;
  const core::Index3 size = pair.fixed.content.back().size();
  for (std::size_t a = 0; a < 3; ++a)
    side = std::min(side, size[a] * grid.spacing()[static_cast<Eigen::Index>(a)]);
  const std::vector<core::RigidTransform> fits =
      fitAround(pair, mrFromCt, at, std::min(kSurroundings, kShareOfField * side), repeat);
  if (fits.empty())
    return 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double square = 0.0;
  for (const core::RigidTransform& fit : fits)
  {
    const Eigen::Vector3d off = fit * at - mrFromCt * at;
    mean += off / kLocalFits;
    square += off.squaredNorm() / kLocalFits;
  }
  const double error = std::sqrt(std::max(0.0, square - mean.squaredNorm()) / (kLocalFits - 1));
  return std::max(0.0, mean.norm() - 2.0 * error);
}

} // namespace

QualityFeatures collectQualityFeatures(const ImagePair& pair, const PairFit& fit,
                                       const FitOptions& options, const Eigen::Vector3d& at,
                                       const core::Progress& progress)
{
  const core::RigidTransform& pose = fit.fit.mrFromCt;
  const double voxel = pair.scales.back();
  const double stray = std::max(3.0, kStray * voxel);
  QualityFeatures evidence;
  evidence.overlap = fit.fit.overlap;
  evidence.information =
      fit.fit.metric -
      informationBias(options.schedule.bins, static_cast<double>(options.schedule.samples));
  evidence.runnerUp = fit.score > 0.0 ? fit.runnerUp / fit.score : 0.0;
  evidence.moved = (pose * at - fit.starts.front() * at).norm();
  for (const core::RigidTransform& start : fit.starts)
    evidence.moved = std::min(evidence.moved, (pose * at - start * at).norm());

  PerturbedRepeatsOptions repeat;
  repeat.seed = options.seed;
  const std::vector<core::RigidTransform> repeats =
      repeatFit(pair, pose, repeat, progress.part(0.0, 0.6));
  evidence.strays = strayShare(pose, repeats, at, stray);
  evidence.error = localError(pose, repeats, at, voxel, stray);
  progress.report(0.6, "registration's error");
  evidence.displaced = displacedPart(
      fitSurroundings(pair, pose, at, options.seed, progress.part(0.6, 0.65)), kDisplaced);
  if (evidence.displaced)
    evidence.error = withDisplaced(evidence.error, evidence.displaced->offset.norm(),
                                   evidence.displaced->spread);
  evidence.aside = asideOf(pair, pose, at, repeat);
  progress.report(0.7, "registration's verdict");
  evidence.mirrored = mirrorShare(pair, pose, options, progress.part(0.7, 1.0));

  const Pyramid& ct = pair.fixedIsCt ? pair.fixed : pair.moving;
  const Pyramid& mr = pair.fixedIsCt ? pair.moving : pair.fixed;
  const auto inside = [](const Pyramid& image, const Eigen::Vector3d& point)
  { return image.finest().grid().hullContains(image.finest().grid().voxelFromPatient(point)); };
  evidence.pointCovered = inside(ct, at) && inside(mr, pose * at);
  return evidence;
}

} // namespace petrous::registration
