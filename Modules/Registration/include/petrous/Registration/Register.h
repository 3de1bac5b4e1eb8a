#pragma once

#include <string>

#include "petrous/Registration/Fit.h"

namespace petrous::registration
{

enum class Verdict
{
  Good,     ///< the error stated is to be relied on
  Doubtful, ///< something speaks against it; a person must look
  Failed    ///< not to be used
};

const char* nameOf(Verdict verdict); ///< "good", "doubtful", "failed"

/// How far off a fit may be at one point of the patient, mm: percentiles of the distance between
/// where this fit and where the truth takes it, as estimated from repeated fits, and counted from
/// where the point's surroundings lie where that is certainly elsewhere.
struct LocalError
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< CT patient point, LPS mm
  double median = 0.0;
  double p95 = 0.0;
  double max = 0.0; ///< the 99.9th percentile, or the furthest of the repeats where that is more
};

struct Registration
{
  Fit fit;
  LocalError error;
  double estimateSeconds = 0.0; ///< wall time of error and verdict, beside fit.seconds
  Verdict verdict = Verdict::Failed;
  std::string text; ///< the verdict's reason, a sentence or two for the surgeon
};

/// A fit with its local error at `at` (CT patient point, LPS mm) and a verdict.
///
/// The error is the spread of fits from perturbed starts, with swapped roles and over resampled
/// subsets of the image (block bootstrap), calibrated on pairs of known motion
/// (Documentation/adr). Balls of 10, 18 and 30 mm about `at` are fitted by themselves, too: an ear
/// that lies elsewhere than the rest of the head says is doubtful, with an error that reaches
/// there. Images that cannot be registered (empty, constant, without overlap) give
/// the verdict Failed and its reason, and an identity transform; nothing is thrown for them.
///
/// Throws CancelledError.
Registration registerRigid(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                           const FitOptions& options, const Eigen::Vector3d& at,
                           const core::Progress& progress = {},
                           const MetricListener& listener = {});

} // namespace petrous::registration
