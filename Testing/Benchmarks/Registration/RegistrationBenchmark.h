#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "PeerRegistration.h"
#include "RegistrationPair.h"
#include "SimulatedPairs.h"
#include "StressTrials.h"
#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::registration
{

/// What `petrous bench registration` works on. Everything but the bodies may be absent.
struct BenchmarkInput
{
  std::vector<RegistrationPair> pairs;  ///< files and phantom patients, with a truth each
  std::vector<RegistrationPair> tuning; ///< what settings are judged on; none of `pairs`
  std::vector<RegistrationPair> others; ///< CT and MR of persons who are not among the bodies
  std::vector<RegistrationPair> rire;   ///< with and without truth
  std::vector<SimulationBody> bodies;   ///< what simulated pairs are drawn from; one at least
  std::vector<StressTrial> fileTrials;  ///< images that a reader should refuse
  std::set<std::string> parts;          ///< of benchmarkParts(); empty: all
  bool quick = false;
  std::filesystem::path work; ///< for the files of other programs
  /// Our program in a process of its own, from files as elastix gets them; empty: not measured.
  std::function<std::optional<PeerFit>(const RegistrationPair&)> process;
};

/// "pairs", "capture", "schedule", "conditions", "calibration", "stress".
const std::vector<std::string>& benchmarkParts();

/// Registration beside elastix (where it is installed) and ITK.
///
/// What is compared and what is tuned are different pairs. Compared: phantom patients 1 to 5, and
/// the pairs of files (among them ct_mr_sim: a T1 simulated from the real head). Tuned on, and the
/// bodies of `schedule`: phantom patients 101 to 103, and T2 and diffusion images simulated from
/// the real head with motions of their own (seeds 200 to 202); there is no second real head among
/// the data. Elastix is not tuned by us: its manual's set is the yardstick, and the curve over its
/// schedules shows what it does in less and in more time.
///
/// Times are of a call for ours and ITK, and of a whole process for elastix; where `what` is
/// "process", ours are of a process, too, which reads the same images and adds error and verdict.
/// `extra` has the processor time of each, processor_s.
/// - pairs: time and error of the fit, of fit and estimate together, from the headers, and of
///   elastix over its schedules;
/// - capture: displaced starts, 10 to 20 and 20 to 40 mm and degrees;
/// - schedule: time against error over each setting of Schedule;
/// - conditions: error against noise, slice thickness and overlap;
/// - calibration: the stated p95 against the true error on simulated pairs;
/// - stress: see StressTrials.h.
/// With RIRE's pairs only those are run.
core::BenchmarkReport runRegistrationBenchmark(const BenchmarkInput& input,
                                               const core::Progress& progress);

// Its parts, for the sources that make them.
std::vector<core::BenchmarkPoint> pairPoints(const BenchmarkInput& input,
                                             const std::vector<RegistrationPair>& pairs,
                                             const core::Progress& progress);
std::vector<core::BenchmarkPoint> capturePoints(const BenchmarkInput& input,
                                                const core::Progress& progress);
std::vector<core::BenchmarkPoint> schedulePoints(const BenchmarkInput& input,
                                                 const core::Progress& progress);
std::vector<core::BenchmarkPoint> conditionPoints(const BenchmarkInput& input,
                                                  const core::Progress& progress);
std::vector<core::BenchmarkPoint> calibrationPoints(const BenchmarkInput& input,
                                                    const core::Progress& progress);

/// Of values; 0 without any. `share` 0.5 is the median.
double quantile(std::vector<double> values, double share);

} // namespace petrous::registration
