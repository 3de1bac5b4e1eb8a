#include <cmath>
#include <limits>

#include "StressTrials.h"
#include "petrous/Core/Error.h"
#include "petrous/Registration/Register.h"

namespace petrous::registration
{

namespace
{

constexpr double kFar = 2.0;          // mm, maximum true error of a "good" verdict
constexpr double kBeyondStated = 3.0; // times the stated maximum

core::BenchmarkPoint runTrial(const StressTrial& trial, const core::Progress& progress)
{
  core::BenchmarkPoint point;
  point.scene = "stress: " + trial.kind;
  point.setting["trial"] = trial.name;
  point.error = std::numeric_limits<double>::quiet_NaN();
  point.errorUnit = "mm at the target";
  point.extra["wrong"] = 0.0;
  std::string verdict = "refused", text;
  bool known = false, wrong = false;
  try
  {
    const RegistrationPair pair = trial.make();
    known = static_cast<bool>(pair.truth);
    const Vector3d at = pair.targets.front();
    const Registration result = registerRigid(*pair.ct, *pair.mr, {}, at, progress);
    verdict = nameOf(result.verdict);
    text = result.text;
    point.seconds = result.fit.seconds + result.estimateSeconds;
    point.extra["median_mm"] = result.error.median;
    point.extra["p95_mm"] = result.error.p95;
    point.extra["max_mm"] = result.error.max;
    if (known)
      point.error = (result.fit.mrFromCt * at - pair.truth(at)).norm();
    const bool near =
        known && point.error <= kFar && point.error <= kBeyondStated * result.error.max;
    wrong = result.verdict == Verdict::Good && !near;
  }
  catch (const core::CancelledError&)
  {
    throw;
  }
  catch (const core::Error& error)
  {
    text = error.what();
  }
  point.setting["verdict"] = verdict;
  point.setting["text"] = text;
  point.setting["truth"] = known ? "known" : "none";
  point.setting["outcome"] = wrong               ? "confidently wrong"
                             : verdict == "good" ? "good and right"
                             : trial.mustBeGood  ? "a good pair not called good"
                                                 : "not trusted";
  point.extra["wrong"] = wrong ? 1.0 : 0.0;
  return point;
}

} // namespace

std::vector<core::BenchmarkPoint> runStressTrials(const std::vector<StressTrial>& trials,
                                                  const core::Progress& progress)
{
  std::vector<core::BenchmarkPoint> points;
  for (const StressTrial& trial : trials)
  {
    const double share = static_cast<double>(points.size()) / static_cast<double>(trials.size());
    progress.report(share, "stress: " + trial.kind);
    points.push_back(runTrial(trial, progress.part(share, share)));
  }
  return points;
}

} // namespace petrous::registration
