#include "petrous/Registration/Fit.h"

#include <algorithm>
#include <chrono>

#include "PairFit.h"

namespace petrous::registration
{

Fit fitRigid(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
             const FitOptions& options, const core::Progress& progress,
             const MetricListener& listener)
{
  const auto begin = std::chrono::steady_clock::now();
  const ImagePair pair =
      makePair(ct, mr, options.region, options.schedule.levels, progress.part(0.0, 0.2));
  Fit fit = fitPair(pair, options, progress.part(0.2, 1.0), listener).fit;
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return fit;
}

} // namespace petrous::registration
