#include "petrous/Registration/Register.h"

#include <chrono>

#include "petrous/Core/Error.h"

#include "QualityFeatures.h"

namespace petrous::registration
{

namespace
{

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin)
{
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

} // namespace

Registration registerRigid(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                           const FitOptions& options, const Eigen::Vector3d& at,
                           const core::Progress& progress, const MetricListener& listener)
{
  Registration result;
  result.error.point = at;
  const auto begin = Clock::now();
  try
  {
    const ImagePair pair =
        makePair(ct, mr, options.region, options.schedule.levels, progress.part(0.0, 0.15));
    const PairFit fit = fitPair(pair, options, progress.part(0.15, 0.5), listener);
    result.fit = fit.fit;
    result.fit.seconds = since(begin);

    const auto fitted = Clock::now();
    const QualityFeatures evidence =
        collectQualityFeatures(pair, fit, options, at, progress.part(0.5, 1.0));
    const QualityVerdict judgement = judge(evidence);
    result.error = evidence.error;
    result.verdict = judgement.verdict;
    result.text = judgement.text;
    result.estimateSeconds = since(fitted);
  }
  catch (const core::InvalidParameter& nothing)
  {
    result.fit.seconds = since(begin);
    result.text = nothing.what();
  }
  return result;
}

} // namespace petrous::registration
