#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "SimulatedPairs.h"
#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::registration
{

/// A pair of which little or nothing may be said with confidence.
struct StressTrial
{
  std::string kind; ///< e.g. "voxels mirrored against the header"
  std::string name; ///< which one of its kind
  /// May throw Error, as the reader of a file does: then it was refused.
  std::function<RegistrationPair()> make;
  bool mustBeGood = false; ///< a pair as it should be, among the others: to say "doubtful" of it is
                           ///< no lie, but counted
};

/// More than 200 of them, from the bodies and from pairs of other people's images (any number of
/// each, one body at least); with quick one of each kind.
std::vector<StressTrial> stressTrials(const std::vector<SimulationBody>& bodies,
                                      const std::vector<RegistrationPair>& others, bool quick);

/// Registers each and counts. A point a trial, scene "stress: KIND": the error is the true one at
/// the target, mm, NaN where there is none or no answer; setting: trial, verdict (good, doubtful,
/// failed, refused), outcome, text; extra: median_mm, p95_mm, max_mm as stated, wrong 0 or 1.
///
/// "wrong" is the verdict good with a true error over 2 mm, or over 3 times the stated maximum, or
/// where no truth exists.
std::vector<core::BenchmarkPoint> runStressTrials(const std::vector<StressTrial>& trials,
                                                  const core::Progress& progress);

} // namespace petrous::registration
