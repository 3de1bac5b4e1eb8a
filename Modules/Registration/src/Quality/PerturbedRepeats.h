#pragma once

#include <vector>

#include "petrous/Registration/Fit.h"

#include "ImagePair.h"

namespace petrous::registration
{

struct PerturbedRepeatsOptions
{
  int count = 24;               ///< fits in all, every second one with swapped roles
  std::size_t samples = 16'000; ///< of each
  int bins = 32;
  int blocks = 5;       ///< along each axis, of which the bootstrap draws
  double shift = 2.0;   ///< mm, of the perturbed starts
  double degrees = 2.0; ///< of the perturbed starts
  std::uint32_t seed = 1;
};

/// Fits of the same pair again, each from a perturbed start over a resampled subset: X_MC of each,
/// in an order that does not depend on threads.
std::vector<core::RigidTransform> repeatFit(const ImagePair& pair,
                                            const core::RigidTransform& mrFromCt,
                                            const PerturbedRepeatsOptions& options,
                                            const core::Progress& progress);

/// Fits of what lies within `radius` mm of a point of the CT alone, from perturbed starts: X_MC of
/// each. Empty where the fixed image does not reach there.
std::vector<core::RigidTransform> fitAround(const ImagePair& pair,
                                            const core::RigidTransform& mrFromCt,
                                            const Eigen::Vector3d& ctPoint, double radius,
                                            const PerturbedRepeatsOptions& options);

} // namespace petrous::registration
