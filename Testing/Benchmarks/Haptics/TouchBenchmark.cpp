#include "TouchBenchmark.h"

#include "TouchPlates.h"
#include "TouchSurfaces.h"
#include "TouchTicks.h"

namespace petrous::haptics
{

core::BenchmarkReport runTouchBenchmark(bool quick, const core::Progress& progress,
                                        const std::vector<TouchScene>& scans)
{
  core::BenchmarkReport report{"touch", "Proxy of the hand: error and time of a tick", {}};
  const auto take = [&report](const std::vector<core::BenchmarkPoint>& points)
  { report.points.insert(report.points.end(), points.begin(), points.end()); };
  take(touchSurfaces(quick, progress.part(0.0, 0.2)));
  take(touchParameters(quick, progress.part(0.2, 0.3)));
  take(touchTicks(bumpyBone(), quick, progress.part(0.3, 0.4)));
  for (std::size_t n = 0; n < scans.size(); ++n)
  {
    const double share = 0.1 / static_cast<double>(scans.size());
    const double begin = 0.4 + share * static_cast<double>(n);
    take(touchTicks(scans[n], quick, progress.part(begin, begin + share)));
  }
  take(touchPlates(quick, progress.part(0.5, 1.0)));
  return report;
}

} // namespace petrous::haptics
