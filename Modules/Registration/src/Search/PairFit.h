#pragma once

#include <vector>

#include "petrous/Registration/Fit.h"

#include "CoarseSearch.h"
#include "ImagePair.h"

namespace petrous::registration
{

/// A fit with the data needed for a verdict.
struct PairFit
{
  Fit fit;               ///< without its seconds
  double score = 0.0;    ///< best candidate, at the last level with several candidates
  double runnerUp = 0.0; ///< of the second best, distinct candidate; 0 if none
  std::vector<core::RigidTransform> starts; ///< X_MC, centres of the search; at least one
};

/// fitRigid on prepared images.
PairFit fitPair(const ImagePair& pair, const FitOptions& options, const core::Progress& progress,
                const MetricListener& listener);

/// Samples at a level: as scheduled at the finest, half as many at each coarser level.
std::size_t samplesAt(const ImagePair& pair, std::size_t level, const Schedule& schedule);

} // namespace petrous::registration
