#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/Progress.h"

#include "ImagePair.h"

namespace petrous::registration
{

/// A local maximum of the coarse metric.
struct Candidate
{
  core::RigidTransform pose; ///< movingFromFixed
  double score = 0.0;        ///< sqrt(overlap) times bias-corrected information, nats
};

/// Extent of the coarse search.
struct SearchOptions
{
  std::size_t samples = 4000;
  std::uint32_t seed = 1;
  std::size_t climbs = 48; ///< number of best grid poses that are optimized
  std::size_t keep = 6;    ///< number of candidates returned
};

/// The distinct local maxima near any of the starts, best first: a grid of poses about each start,
/// of which the best are optimized, at the coarsest level.
///
/// The score is sqrt(overlap) times information corrected for finite-sampling bias, so that a pose
/// that pushes most of the fixed image out of the other does not win on the small remainder.
std::vector<Candidate> searchCandidates(const ImagePair& pair,
                                        const std::vector<core::RigidTransform>& starts,
                                        const SearchOptions& options,
                                        const core::Progress& progress);

/// Poses that align the centres, axes parallel: of the image content, and of mass.
std::vector<core::RigidTransform> centredStarts(const ImagePair& pair);

} // namespace petrous::registration
