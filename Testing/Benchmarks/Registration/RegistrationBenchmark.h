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

/// Input of `petrous bench registration`. Only the bodies are mandatory.
struct BenchmarkInput
{
  std::vector<RegistrationPair> pairs;  ///< files and phantom patients with ground truth
  std::vector<RegistrationPair> tuning; ///< for judging settings; disjoint from `pairs`
  std::vector<RegistrationPair> others; ///< CT and MR of persons who are not among the bodies
  std::vector<RegistrationPair> rire;   ///< with and without truth
  std::vector<SimulationBody> bodies;   ///< source of simulated pairs; at least one
  std::vector<StressTrial> fileTrials;  ///< images that a reader should reject
  std::set<std::string> parts;          ///< of benchmarkParts(); empty: all
  bool quick = false;
  std::filesystem::path work; ///< for the files of other programs
  /// Runs our program as a separate process, from the files that elastix gets; empty: not measured.
  std::function<std::optional<PeerFit>(const RegistrationPair&)> process;
};

/// "pairs", "capture", "schedule", "conditions", "calibration", "stress".
const std::vector<std::string>& benchmarkParts();

/// Registration compared with elastix (if installed) and ITK.
///
/// Comparison and tuning use different pairs. Comparison: phantom patients 1 to 5, and the pairs of
/// files (among them ct_mr_sim: a T1 simulated from the real head). Tuning, and the bodies of
/// `schedule`: phantom patients 101 to 103, and T2 and diffusion images simulated from the real
/// head with separate motions (seeds 200 to 202); the data contain no second real head. Elastix is
/// not tuned by us: the parameter set of its manual is the baseline, and the curve over its
/// schedules shows its results with less and more time.
///
/// Times are per call for ours and ITK, and per process for elastix; where `what` is "process",
/// ours are per process too, including reading the same images, error estimate and verdict. `extra`
/// contains the CPU time of each, processor_s.
/// - pairs: time and error of the fit, of fit and estimate together, from the headers, and of
///   elastix over its schedules;
/// - capture: displaced starts, 10 to 20 and 20 to 40 mm and degrees;
/// - schedule: error over time for each setting of Schedule;
/// - conditions: error over noise, slice thickness and overlap;
/// - calibration: stated p95 against true error on simulated pairs;
/// - stress: see StressTrials.h.
/// If there are RIRE pairs, only those are run.
core::BenchmarkReport runRegistrationBenchmark(const BenchmarkInput& input,
                                               const core::Progress& progress);

// Its parts, for the source files that implement them.
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

/// Quantile of values; 0 if empty. `share` 0.5 is the median.
double quantile(std::vector<double> values, double share);

} // namespace petrous::registration
