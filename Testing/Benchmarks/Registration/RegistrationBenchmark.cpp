#include "RegistrationBenchmark.h"

#include <algorithm>
#include <cmath>

#include "PeerRegistration.h"

namespace petrous::registration
{

const std::vector<std::string>& benchmarkParts()
{
  static const std::vector<std::string> parts{"pairs",      "capture",     "schedule",
                                              "conditions", "calibration", "stress"};
  return parts;
}

double quantile(std::vector<double> values, double share)
{
  if (values.empty())
    return 0.0;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto lower = static_cast<std::size_t>(std::floor(place));
  const std::size_t upper = std::min(lower + 1, values.size() - 1);
  return values[lower] + (place - std::floor(place)) * (values[upper] - values[lower]);
}

core::BenchmarkReport runRegistrationBenchmark(const BenchmarkInput& input,
                                               const core::Progress& progress)
{
  core::BenchmarkReport report{"registration", "CT/MR registration: time against true error", {}};
  report.machine["elastix"] = elastixVersion().value_or("not installed: no figures of it");
  report.machine["itk"] = itkVersion();
  const auto take = [&report](std::vector<core::BenchmarkPoint> points)
  {
    report.points.insert(report.points.end(), std::make_move_iterator(points.begin()),
                         std::make_move_iterator(points.end()));
  };
  if (!input.rire.empty())
  {
    take(pairPoints(input, input.rire, progress));
    return report;
  }
  using Part = std::vector<core::BenchmarkPoint> (*)(const BenchmarkInput&, const core::Progress&);
  const Part runs[] = {[](const BenchmarkInput& in, const core::Progress& p)
                       { return pairPoints(in, in.pairs, p); },
                       capturePoints,
                       schedulePoints,
                       conditionPoints,
                       calibrationPoints,
                       [](const BenchmarkInput& in, const core::Progress& p)
                       {
                         auto trials = stressTrials(in.bodies, in.others, in.quick);
                         trials.insert(trials.end(), in.fileTrials.begin(), in.fileTrials.end());
                         return runStressTrials(trials, p);
                       }};
  const auto& names = benchmarkParts();
  for (std::size_t n = 0; n < names.size(); ++n)
    if (input.parts.empty() || input.parts.count(names[n]) != 0)
    {
      const double count = static_cast<double>(names.size());
      take(runs[n](input, progress.part(static_cast<double>(n) / count,
                                        static_cast<double>(n + 1) / count)));
    }
  return report;
}

} // namespace petrous::registration
