#include "PairFit.h"

#include <algorithm>

#include "BfgsOptimizer.h"
#include "MutualInformation.h"
#include "PerturbedRepeats.h"
#include "RigidParametrization.h"

namespace petrous::registration
{

namespace
{

constexpr std::size_t kFewest = 4000; // minimum number of samples per level

double scoreOf(const Optimum& top)
{
  return poseScore(top.information, top.overlap);
}

std::vector<core::RigidTransform> startsOf(const ImagePair& pair, const FitOptions& options)
{
  const std::vector<core::RigidTransform> centred = centredStarts(pair);
  std::vector<core::RigidTransform> starts;
  if (options.start == Start::Given)
    starts.push_back(pair.movingFromFixed(options.given));
  else if (options.start == Start::Header)
    starts.emplace_back();
  if (starts.empty() || options.search)
    starts.insert(starts.end(), centred.begin(), centred.end());
  if (!options.search)
    starts.resize(1);
  return starts;
}

// The metric has ripples (from interpolation: Pluim et al., CVIU 77:211, 2000) that stop an
// optimization up to some tenths of a voxel from the true maximum, at a different place for every
// start. The mean of several results is close to it.
void polish(const ImagePair& pair, const FitOptions& options, PairFit& result,
            const core::Progress& progress)
{
  if (options.schedule.polish < 2)
    return;
  const double voxel = pair.scales.back();
  PerturbedRepeatsOptions repeat;
  repeat.count = options.schedule.polish;
  repeat.samples = options.schedule.samples;
  repeat.bins = options.schedule.bins;
  repeat.blocks = 0;
  repeat.shift = voxel;
  repeat.degrees = 0.5 * voxel;
  repeat.seed = options.seed + 101;
  const FixedSamples samples =
      drawSamples(pair.fixed.finest(), pair.fixed.content.back(), options.schedule.samples,
                  options.seed, options.schedule.bins);
  const Eigen::Vector3d centre =
      pair.fixedIsCt ? samples.centre : result.fit.mrFromCt.inverse() * samples.centre;
  std::vector<core::RigidTransform> ends = repeatFit(pair, result.fit.mrFromCt, repeat, progress);
  ends.push_back(result.fit.mrFromCt);
  const core::RigidTransform mean = meanPose(ends, centre);
  ends.erase(std::remove_if(ends.begin(), ends.end(),
                            [&](const core::RigidTransform& end) {
                              return poseDistance(end, mean, centre, samples.radius) > 3.0 * voxel;
                            }),
             ends.end());
  if (ends.size() < 2)
    return;
  result.fit.mrFromCt = meanPose(ends, centre);
  const MutualInformation metric(samples, pair.moving.finest(), options.schedule.bins);
  result.fit.metric = metric.value(pair.movingFromFixed(result.fit.mrFromCt), &result.fit.overlap);
}

} // namespace

std::size_t samplesAt(const ImagePair& pair, std::size_t level, const Schedule& schedule)
{
  const std::size_t halvings = pair.levels() - 1 - level;
  return std::max(std::min(kFewest, schedule.samples),
                  schedule.samples >> std::min<std::size_t>(halvings, 31));
}

namespace
{

// Optimizes each candidate at one level; best first.
std::vector<Optimum> climbLevel(const ImagePair& pair, std::size_t level,
                                const MutualInformation& metric,
                                const std::vector<Candidate>& candidates, const FitOptions& options,
                                int& iterations, const core::Progress& progress,
                                const MetricListener& listener)
{
  BfgsOptions climb;
  climb.evaluations = options.schedule.evaluations;
  climb.firstStep = 0.5 * pair.scales[level];
  climb.maxStep = 4.0 * pair.scales[level];
  core::RigidTransform best = candidates.front().pose;
  double bestInformation = -1.0;
  const auto told = [&](const core::RigidTransform& pose, double information)
  {
    progress.check("registration");
    ++iterations;
    if (information > bestInformation)
    {
      bestInformation = information;
      best = pose;
    }
    if (listener)
      listener({iterations, static_cast<int>(level), information}, pair.mrFromCt(best));
  };
  std::vector<Optimum> tops;
  for (const Candidate& candidate : candidates)
    tops.push_back(maximize(metric, candidate.pose, climb, told));
  std::stable_sort(tops.begin(), tops.end(),
                   [](const Optimum& a, const Optimum& b) { return scoreOf(a) > scoreOf(b); });
  return tops;
}

std::vector<Candidate> candidatesOf(const ImagePair& pair, const FitOptions& options,
                                    const std::vector<core::RigidTransform>& starts,
                                    const core::Progress& progress)
{
  if (!options.search)
    return {{starts.front(), 0.0}};
  SearchOptions search;
  search.samples = options.schedule.searchSamples;
  search.seed = options.seed;
  return searchCandidates(pair, starts, search, progress);
}

} // namespace

PairFit fitPair(const ImagePair& pair, const FitOptions& options, const core::Progress& progress,
                const MetricListener& listener)
{
  PairFit result;
  const std::vector<core::RigidTransform> starts = startsOf(pair, options);
  for (const core::RigidTransform& start : starts)
    result.starts.push_back(pair.mrFromCt(start));
  std::vector<Candidate> candidates = candidatesOf(pair, options, starts, progress.part(0.0, 0.3));
  for (std::size_t level = 0; level < pair.levels(); ++level)
  {
    progress.report(0.3 + 0.6 * static_cast<double>(level) / static_cast<double>(pair.levels()),
                    "fitting");
    const FixedSamples samples =
        drawSamples(pair.fixed.levels[level], pair.fixed.content[level],
                    samplesAt(pair, level, options.schedule),
                    options.seed + 17 * static_cast<std::uint32_t>(level), options.schedule.bins);
    const MutualInformation metric(samples, pair.moving.levels[level], options.schedule.bins);
    const std::vector<Optimum> tops = climbLevel(pair, level, metric, candidates, options,
                                                 result.fit.iterations, progress, listener);
    const Optimum& first = tops.front();
    result.fit.mrFromCt = pair.mrFromCt(first.pose);
    result.fit.metric = first.information;
    result.fit.overlap = first.overlap;

    const double apart = 2.0 * pair.scales[level];
    const auto rival = std::find_if(
        tops.begin() + 1, tops.end(),
        [&](const Optimum& other)
        { return poseDistance(first.pose, other.pose, samples.centre, samples.radius) > apart; });
    if (tops.size() > 1)
    {
      result.score = scoreOf(first);
      result.runnerUp = rival == tops.end() ? 0.0 : scoreOf(*rival);
    }
    candidates = {{first.pose, scoreOf(first)}};
    if (level == 0 && rival != tops.end() && pair.levels() > 2)
      candidates.push_back({rival->pose, scoreOf(*rival)});
  }
  progress.report(0.9, "fitting");
  polish(pair, options, result, progress.part(0.9, 1.0));
  progress.report(1.0, "fitting");
  return result;
}

} // namespace petrous::registration
