#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "ChildProcess.h"
#include "CounterNoise.h"
#include "PeerRegistration.h"
#include "RegistrationBenchmark.h"
#include "petrous/Registration/Register.h"

namespace petrous::registration
{

namespace
{

using Points = std::vector<core::BenchmarkPoint>;

int threads()
{
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

core::BenchmarkPoint pointOf(const RegistrationPair& pair, const core::RigidTransform& found,
                             double seconds, const std::string& what, const std::string& peer)
{
  core::BenchmarkPoint point;
  point.scene = pair.name;
  point.setting["what"] = what;
  point.seconds = seconds;
  point.errorUnit = "mm at the targets";
  point.error = std::numeric_limits<double>::quiet_NaN();
  point.peer = peer;
  if (pair.truth)
  {
    const PairError error = errorOf(pair, found);
    point.error = error.target;
    point.extra["corner_mean_mm"] = error.cornerMean;
    point.extra["corner_max_mm"] = error.cornerMax;
    point.setting["truth"] = pair.exact ? "exact" : "nominal";
  }
  else
    point.setting["truth"] = "none";
  return point;
}

double cornerDistance(const RegistrationPair& pair, const core::RigidTransform& a,
                      const core::RigidTransform& b)
{
  double sum = 0.0;
  for (const Vector3d& p : cornersOf(pair.ct->geometry()))
    sum += (a * p - b * p).norm() / 8.0;
  return sum;
}

// Repeats a run: times are medians, the result is that of the last run.
template <class Run>
std::optional<PeerFit> repeated(int times, const Run& run)
{
  std::vector<double> seconds, processor;
  std::optional<PeerFit> fit;
  for (int n = 0; n < times; ++n)
  {
    fit = run();
    if (!fit)
      return std::nullopt;
    seconds.push_back(fit->seconds);
    processor.push_back(fit->processorSeconds);
  }
  fit->seconds = quantile(seconds, 0.5);
  fit->processorSeconds = quantile(processor, 0.5);
  return fit;
}

core::BenchmarkPoint peerPoint(const RegistrationPair& pair, const PeerFit& fit,
                               const std::string& what, const std::string& peer)
{
  core::BenchmarkPoint point = pointOf(pair, fit.mrFromCt, fit.seconds, what, peer);
  point.extra["processor_s"] = fit.processorSeconds;
  return point;
}

Points onePair(const BenchmarkInput& input, const RegistrationPair& pair,
               const std::optional<std::string>& elastix, const core::Progress& progress)
{
  Points points;
  const int times = input.quick ? 1 : 3;
  const bool peers = !input.quick || input.rire.empty();
  std::optional<PeerFit> reference;
  if (elastix && peers)
    reference = repeated(times, [&] { return runElastix(pair, input.work, threads()); });
  const auto add = [&](core::BenchmarkPoint point, const core::RigidTransform& found)
  {
    if (reference)
    {
      point.extra["from_elastix_mm"] = distanceAtTargets(pair, found, reference->mrFromCt);
      point.extra["from_elastix_corner_mm"] = cornerDistance(pair, found, reference->mrFromCt);
    }
    const core::GridGeometry& grid = pair.mr->geometry();
    if (pair.truth)
      point.extra["mr_voxels"] = point.error / std::cbrt(grid.voxelVolume());
    points.push_back(std::move(point));
  };

  std::vector<double> fitSeconds, allSeconds, processor;
  Registration ours;
  for (int n = 0; n < times; ++n)
  {
    const double spent = processorSeconds();
    ours = registerRigid(*pair.ct, *pair.mr, {}, pair.targets.front(), progress);
    fitSeconds.push_back(ours.fit.seconds);
    allSeconds.push_back(ours.fit.seconds + ours.estimateSeconds);
    processor.push_back(processorSeconds() - spent);
  }
  auto fit = pointOf(pair, ours.fit.mrFromCt, quantile(fitSeconds, 0.5), "fit", "");
  fit.isDefault = true;
  fit.extra["metric_nats"] = ours.fit.metric;
  fit.extra["iterations"] = ours.fit.iterations;
  add(fit, ours.fit.mrFromCt);
  auto all =
      pointOf(pair, ours.fit.mrFromCt, quantile(allSeconds, 0.5), "fit and error estimate", "");
  all.isDefault = true;
  all.setting["verdict"] = nameOf(ours.verdict);
  all.setting["text"] = ours.text;
  all.extra["stated_median_mm"] = ours.error.median;
  all.extra["stated_p95_mm"] = ours.error.p95;
  all.extra["stated_max_mm"] = ours.error.max;
  all.extra["processor_s"] = quantile(processor, 0.5);
  add(all, ours.fit.mrFromCt);
  if (input.process)
    if (const auto process = repeated(times, [&] { return input.process(pair); }))
      add(peerPoint(pair, *process, "process", ""), process->mrFromCt);
  if (reference)
    add(peerPoint(pair, *reference, "fit", *elastix), reference->mrFromCt);
  if (reference && !input.quick)
    for (const ElastixSchedule& schedule : elastixSchedules())
      if (const auto peer = runElastix(pair, input.work, threads(), schedule))
      {
        auto point = peerPoint(pair, *peer, "fit", *elastix);
        point.series = "elastix, " + pair.name;
        point.setting["schedule"] = schedule.name();
        add(point, peer->mrFromCt);
      }
  if (peers)
    if (const auto itk = runItk(pair))
      add(peerPoint(pair, *itk, "fit", itkVersion()), itk->mrFromCt);
  return points;
}

// A range of displaced starts, in both mm and degrees.
struct Range
{
  const char* name;
  double least, most;
};
constexpr Range kRanges[] = {{"start 10 to 20 mm and degrees off", 10.0, 20.0},
                             {"start 20 to 40 mm and degrees off", 20.0, 40.0}};

template <class Run>
core::BenchmarkPoint captureOf(const RegistrationPair& pair, const Range& range, int starts,
                               const core::RigidTransform& optimum, const std::string& peer,
                               const Run& run)
{
  std::vector<double> distances, seconds;
  int missing = 0;
  for (int n = 0; n < starts; ++n)
  {
    const CounterNoise draw(static_cast<std::uint64_t>(900 + n));
    const core::RigidTransform move = randomMotion(
        pair.mr->geometry().center(), draw.uniform(0, range.least, range.most),
        draw.uniform(1, range.least, range.most), static_cast<std::uint64_t>(5000 + n));
    const std::optional<PeerFit> fit = run(displaced(pair, move));
    if (!fit)
    {
      ++missing;
      continue;
    }
    distances.push_back(distanceAtTargets(pair, move.inverse() * fit->mrFromCt, optimum));
    seconds.push_back(fit->seconds);
  }
  const auto within = [&](double limit)
  {
    return static_cast<double>(
        std::count_if(distances.begin(), distances.end(), [limit](double d) { return d < limit; }));
  };
  core::BenchmarkPoint point;
  point.scene = pair.name + ", " + range.name;
  point.setting["what"] = "capture";
  point.seconds = quantile(seconds, 0.5);
  point.error = quantile(distances, 1.0);
  point.errorUnit = "mm from its own optimum at the targets, worst";
  point.peer = peer;
  point.isDefault = peer.empty();
  point.extra = {{"starts", starts},
                 {"within_1mm", within(1.0)},
                 {"within_2mm", within(2.0)},
                 {"gave_up", missing},
                 {"median_mm", quantile(distances, 0.5)}};
  return point;
}

} // namespace

Points pairPoints(const BenchmarkInput& input, const std::vector<RegistrationPair>& pairs,
                  const core::Progress& progress)
{
  const auto elastix = elastixVersion();
  Points points;
  for (std::size_t n = 0; n < pairs.size(); ++n)
  {
    const double share = static_cast<double>(n) / static_cast<double>(pairs.size());
    progress.report(share, pairs[n].name);
    Points more = onePair(input, pairs[n], elastix, progress.part(share, share));
    points.insert(points.end(), more.begin(), more.end());
  }
  return points;
}

Points capturePoints(const BenchmarkInput& input, const core::Progress& progress)
{
  const auto elastix = elastixVersion();
  const int starts = input.quick ? 2 : 50;
  const int peerStarts = input.quick ? 0 : 10;
  Points points;
  std::vector<RegistrationPair> pairs = input.pairs;
  if (input.quick && pairs.size() > 1)
    pairs.resize(1);
  for (std::size_t n = 0; n < pairs.size(); ++n)
  {
    const RegistrationPair& pair = pairs[n];
    progress.report(static_cast<double>(n) / static_cast<double>(pairs.size()),
                    "displaced starts: " + pair.name);
    const core::RigidTransform optimum = fitRigid(*pair.ct, *pair.mr).mrFromCt;
    const auto ours = [&progress](const RegistrationPair& moved) -> std::optional<PeerFit>
    {
      progress.check("displaced starts");
      const Fit fit = fitRigid(*moved.ct, *moved.mr);
      return PeerFit{fit.mrFromCt, fit.seconds, 0.0};
    };
    for (const Range& range : kRanges)
      points.push_back(captureOf(pair, range, starts, optimum, "", ours));
    if (!elastix || peerStarts == 0)
      continue;
    const auto theirs = [&](const RegistrationPair& moved)
    {
      progress.check("displaced starts");
      return runElastix(moved, input.work, threads());
    };
    if (const auto best = theirs(pair))
      for (const Range& range : kRanges)
        points.push_back(captureOf(pair, range, peerStarts, best->mrFromCt, *elastix, theirs));
  }
  return points;
}

} // namespace petrous::registration
