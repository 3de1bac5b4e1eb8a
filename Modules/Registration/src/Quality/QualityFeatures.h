#pragma once

#include "petrous/Registration/Register.h"

#include "ImagePair.h"
#include "PairFit.h"
#include "Surroundings.h"

namespace petrous::registration
{

/// What speaks for and against a fit.
struct QualityFeatures
{
  double overlap = 0.0;     ///< share of the fixed image's points that fall on the other
  double information = 0.0; ///< nats, at the finest level, less the bias of its samples
  double strays = 1.0;      ///< share of the repeats that ended elsewhere
  /// mm, at the point: how far fits of its surroundings alone lie off in the mean, less twice the
  /// standard error of that mean.
  double aside = 0.0;
  double runnerUp = 0.0;    ///< best score of a clearly different pose, as a share of the fit's
  double mirrored = 0.0;    ///< best score of the MR mirrored, as a share of the fit's
  double moved = 0.0;       ///< mm, at the point, from the nearest of the starts
  bool pointCovered = true; ///< the point lies in both images
  std::optional<LocalFit> displaced; ///< a ball about the point that lies elsewhere than the rest
  LocalError error;
};

struct QualityVerdict
{
  Verdict verdict = Verdict::Failed;
  std::string text;
};

/// Weighs the evidence; the thresholds and the trials they were set on are in Documentation/adr.
QualityVerdict judge(const QualityFeatures& evidence);

/// Collects it: repeated fits, fits about the point, a search with the MR mirrored. The error is
/// that of the repeats, and where a ball about the point is displaced that of the ball besides.
QualityFeatures collectQualityFeatures(const ImagePair& pair, const PairFit& fit, const FitOptions& options,
                         const Eigen::Vector3d& at, const core::Progress& progress);

} // namespace petrous::registration
