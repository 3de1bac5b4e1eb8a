#pragma once

#include <vector>

#include "petrous/Registration/Fit.h"

#include "ImagePair.h"

namespace petrous::registration
{

struct PerturbedRepeatsOptions
{
  int count = 24;               ///< total number of fits, every second one with swapped roles
  std::size_t samples = 16'000; ///< of each
  int bins = 32;
  int blocks = 5;       ///< along each axis, for the bootstrap
  double shift = 2.0;   ///< mm, perturbation of the starts
  double degrees = 2.0; ///< perturbation of the starts
  std::uint32_t seed = 1;
};

/// Repeats the fit of the pair, each time from a perturbed start over a resampled subset: X_MC of
/// each, in an order independent of threads.
std::vector<core::RigidTransform> repeatFit(const ImagePair& pair,
                                            const core::RigidTransform& mrFromCt,
                                            const PerturbedRepeatsOptions& options,
                                            const core::Progress& progress);

/// Fits only what lies within `radius` mm of a CT point, from perturbed starts: X_MC of each. Empty
/// if the fixed image does not extend there.
std::vector<core::RigidTransform> fitAround(const ImagePair& pair,
                                            const core::RigidTransform& mrFromCt,
                                            const Eigen::Vector3d& ctPoint, double radius,
                                            const PerturbedRepeatsOptions& options);

} // namespace petrous::registration
