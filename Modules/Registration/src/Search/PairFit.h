#pragma once

#include <vector>

#include "petrous/Registration/Fit.h"

#include "CoarseSearch.h"
#include "ImagePair.h"

namespace petrous::registration
{

/// A fit with what a verdict asks about.
struct PairFit
{
  Fit fit;               ///< without its seconds
  double score = 0.0;    ///< of the best candidate at the last level that several were climbed at
  double runnerUp = 0.0; ///< of the second best, distinct one; 0 where there was none
  std::vector<core::RigidTransform> starts; ///< X_MC, what was looked about; one at least
};

/// fitRigid on prepared images.
PairFit fitPair(const ImagePair& pair, const FitOptions& options, const core::Progress& progress,
                const MetricListener& listener);

/// Samples of a level: as many as the schedule says of the finest, half as many of each coarser.
std::size_t samplesAt(const ImagePair& pair, std::size_t level, const Schedule& schedule);

} // namespace petrous::registration
