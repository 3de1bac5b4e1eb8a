#pragma once

#include "petrous/Registration/Register.h"

#include "ImagePair.h"
#include "PairFit.h"
#include "Surroundings.h"

namespace petrous::registration
{

/// Evidence for and against a fit.
struct QualityFeatures
{
  double overlap = 0.0;     ///< fraction of the fixed image's samples inside the other
  double information = 0.0; ///< nats, at the finest level, corrected for sampling bias
  double strays = 1.0;      ///< fraction of the repeats that ended elsewhere
  /// mm, at the point: mean deviation of fits of its surroundings alone, minus twice the standard
  /// error of that mean.
  double aside = 0.0;
  double runnerUp = 0.0;    ///< best score of a clearly different pose, relative to the fit's
  double mirrored = 0.0;    ///< best score with an image mirrored, relative to the fit's
  double moved = 0.0;       ///< mm, at the point, from the nearest start
  bool pointCovered = true; ///< the point lies inside both images
  std::optional<LocalFit> displaced; ///< a ball about the point that is displaced from the rest
  LocalError error;
};

struct QualityVerdict
{
  Verdict verdict = Verdict::Failed;
  std::string text;
};

/// Evaluates the features; thresholds and the trials that determined them are in Documentation/adr.
QualityVerdict judge(const QualityFeatures& evidence);

/// Collects the features: repeated fits, local fits about the point, a search with the moving image
/// mirrored. The error is that of the repeats, plus that of a ball about the point if displaced.
QualityFeatures collectQualityFeatures(const ImagePair& pair, const PairFit& fit,
                                       const FitOptions& options, const Eigen::Vector3d& at,
                                       const core::Progress& progress);

} // namespace petrous::registration
