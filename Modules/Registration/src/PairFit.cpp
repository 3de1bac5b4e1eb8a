#include "PairFit.h"

#include <algorithm>

#include "Ascent.h"
#include "MutualInformation.h"
#include "PoseChart.h"

namespace petrous::registration
{

namespace
{

constexpr std::size_t kFewest = 4000; // samples of any level

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

} // namespace

std::size_t samplesAt(const ImagePair& pair, std::size_t level, const Schedule& schedule)
{
  const std::size_t halvings = pair.levels() - 1 - level;
  return std::max(std::min(kFewest, schedule.samples),
                  schedule.samples >> std::min<std::size_t>(halvings, 31));
}

PairFit fitPair(const ImagePair& pair, const FitOptions& options, const core::Progress& progress,
                const MetricListener& listener)
{
  PairFit result;
  std::vector<core::RigidTransform> starts = startsOf(pair, options);
  std::vector<Basin> basins;
  if (options.search)
  {
    SearchOptions search;
    search.samples = options.schedule.searchSamples;
    search.seed = options.seed;
    basins = searchBasins(pair, starts, search, progress.part(0.0, 0.3));
  }
  else
    basins.push_back({starts.front(), 0.0});

  for (std::size_t level = 0; level < pair.levels(); ++level)
  {
    const FixedSamples samples =
        drawSamples(pair.fixed.levels[level], pair.fixed.content[level],
                    samplesAt(pair, level, options.schedule),
                    options.seed + 17 * static_cast<std::uint32_t>(level), options.schedule.bins);
    const MutualInformation metric(samples, pair.moving.levels[level], options.schedule.bins);
    AscentOptions climb;
    climb.evaluations = options.schedule.evaluations;
    climb.firstStep = 0.5 * pair.scales[level];
    climb.longestStep = 4.0 * pair.scales[level];
    const double at = 0.3 + 0.7 * static_cast<double>(level) / static_cast<double>(pair.levels());
    progress.report(at, "fitting");

    core::RigidTransform best = basins.front().pose;
    double bestInformation = -1.0;
    std::vector<Ascent> tops;
    for (const Basin& basin : basins)
    {
      tops.push_back(ascend(metric, basin.pose, climb,
                            [&](const core::RigidTransform& pose, double information)
                            {
                              progress.check("registration");
                              ++result.fit.iterations;
                              if (information > bestInformation)
                              {
                                bestInformation = information;
                                best = pose;
                              }
                              if (listener)
                                listener(
                                    {result.fit.iterations, static_cast<int>(level), information},
                                    pair.mrFromCt(best));
                            }));
    }
    std::stable_sort(tops.begin(), tops.end(),
                     [](const Ascent& a, const Ascent& b)
                     { return a.information * a.overlap > b.information * b.overlap; });
    const Ascent& first = tops.front();
    result.fit.mrFromCt = pair.mrFromCt(first.pose);
    result.fit.metric = first.information;
    result.fit.overlap = first.overlap;
    const auto distinct =
        std::find_if(tops.begin() + 1, tops.end(),
                     [&](const Ascent& other)
                     {
                       return poseDistance(first.pose, other.pose, samples.centre, samples.radius) >
                              2.0 * pair.scales[level];
                     });
    if (tops.size() > 1)
    {
      result.score = first.information * first.overlap;
      result.runnerUp = distinct == tops.end() ? 0.0 : distinct->information * distinct->overlap;
    }
    basins = {{first.pose, first.information * first.overlap}};
    if (level == 0 && distinct != tops.end() && pair.levels() > 2)
      basins.push_back({distinct->pose, distinct->information * distinct->overlap});
  }
  progress.report(1.0, "fitting");
  return result;
}

} // namespace petrous::registration
