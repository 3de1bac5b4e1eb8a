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

/// A pair about which little or nothing can be stated with confidence.
struct StressTrial
{
  std::string kind; ///< e.g. "voxels mirrored against the header"
  std::string name; ///< which one of its kind
  /// May throw Error, as a file reader does; the trial then counts as refused.
  std::function<RegistrationPair()> make;
  bool mustBeGood = false; ///< a valid pair among the others: "doubtful" is not wrong, but counted
};

/// More than 200 trials, from the bodies and from pairs of third-party images (any number of each,
/// but at least one body); with quick one of each kind.
std::vector<StressTrial> stressTrials(const std::vector<SimulationBody>& bodies,
                                      const std::vector<RegistrationPair>& others, bool quick);

/// Registers each trial. One point per trial, scene "stress: KIND": error is the true error at the
/// target, mm, NaN without truth or answer; setting: trial, verdict (good, doubtful, failed,
/// refused), outcome, text; extra: median_mm, p95_mm, max_mm as stated, wrong 0 or 1.
///
/// "wrong" means verdict good with a true error above 2 mm, or above 3 times the stated maximum, or
/// without a truth.
std::vector<core::BenchmarkPoint> runStressTrials(const std::vector<StressTrial>& trials,
                                                  const core::Progress& progress);

} // namespace petrous::registration
