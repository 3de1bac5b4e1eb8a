#include "TouchBenchmark.h"

#include "TouchPlates.h"
#include "TouchSurfaces.h"
#include "TouchTicks.h"

namespace petrous::haptics
{

core::BenchmarkReport runTouchBenchmark(bool quick, const core::Progress& progress,
                                        const TouchScene* real)
{
  core::BenchmarkReport report{"touch", "Proxy of the hand: error and time of a tick", {}};
  const auto take = [&report](const std::vector<core::BenchmarkPoint>& points)
  { report.points.insert(report.points.end(), points.begin(), points.end()); };
  take(touchSurfaces(quick, progress.part(0.0, 0.2)));
  take(touchParameters(quick, progress.part(0.2, 0.3)));
  take(touchTicks(bumpyBone(), quick, progress.part(0.3, 0.4)));
  if (real)
    take(touchTicks(*real, quick, progress.part(0.4, 0.5)));
  else
    report.machine["real_data"] = "none given: analytic bone alone";
  take(touchPlates(quick, progress.part(0.5, 1.0)));
  return report;
}

} // namespace petrous::haptics
