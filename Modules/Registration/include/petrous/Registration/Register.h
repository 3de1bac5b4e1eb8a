#pragma once

#include <optional>
#include <string>

#include "petrous/Core/RigidSpread.h"
#include "petrous/Registration/Fit.h"

namespace petrous::registration
{

enum class Verdict
{
  Good,     ///< the stated error is reliable
  Doubtful, ///< there is evidence against it; needs visual inspection
  Failed    ///< must not be used
};

const char* nameOf(Verdict verdict); ///< "good", "doubtful", "failed"

/// Estimated local registration error at a point of the patient, mm: percentiles of the distance
/// between the mapped and the true position, estimated from repeated fits. If the surroundings of
/// the point are significantly displaced, the distance is taken from their position.
struct LocalError
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< CT patient point, LPS mm
  double median = 0.0;
  double p95 = 0.0;
  double max = 0.0; ///< 99.9th percentile, or the largest deviation of the repeats if greater
  /// Of mrFromCt, in CT space about `point`, for the error at other points; none where the
  /// surroundings of the point are displaced, or no repeat counts.
  std::optional<core::RigidSpread> spread;
};

struct Registration
{
  Fit fit;
  LocalError error;
  double estimateSeconds = 0.0; ///< wall time of error and verdict, without fit.seconds
  Verdict verdict = Verdict::Failed;
  std::string text; ///< reason for the verdict, one or two sentences for the surgeon
};

/// Registration with local error at `at` (CT patient point, LPS mm) and verdict.
///
/// The error is the spread of fits from perturbed starts, with swapped roles and over resampled
/// subsets of the image (block bootstrap), calibrated on pairs of known motion (Documentation/adr).
/// Balls of 10, 18 and 30 mm radius about `at` are also fitted separately: an ear displaced from
/// the rest of the head gives Doubtful, with an error that includes the displacement. Images that
/// cannot be registered (empty, constant, without overlap) do not throw: the verdict is Failed,
/// with the reason; if no fit was possible, the transform is the identity.
///
/// Throws CancelledError.
Registration registerRigid(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                           const FitOptions& options, const Eigen::Vector3d& at,
                           const core::Progress& progress = {},
                           const MetricListener& listener = {});

} // namespace petrous::registration
