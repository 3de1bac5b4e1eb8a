#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/Progress.h"

#include "ImagePair.h"

namespace petrous::registration
{

/// A maximum of the coarse metric.
struct Candidate
{
  core::RigidTransform pose; ///< movingFromFixed
  double score = 0.0;        ///< root of the overlap times information without its bias, nats
};

/// What the search starts from and how far it looks.
struct SearchOptions
{
  std::size_t samples = 4000;
  std::uint32_t seed = 1;
  std::size_t climbs = 48; ///< of the best poses of the grid
  std::size_t keep = 6;    ///< candidates handed on
};

/// The distinct maxima near any of the starts, best first: a grid of poses about each, of which the
/// best are climbed from, at the coarsest level.
///
/// Scored by the root of the overlap times (information less its bias from few samples), so that a
/// pose that pushes most of the fixed image out of the other does not win by what little is left.
std::vector<Candidate> searchCandidates(const ImagePair& pair,
                                const std::vector<core::RigidTransform>& starts,
                                const SearchOptions& options, const core::Progress& progress);

/// Poses that lay centres on each other, axes parallel: of what the images show, and of its mass.
std::vector<core::RigidTransform> centredStarts(const ImagePair& pair);

} // namespace petrous::registration
