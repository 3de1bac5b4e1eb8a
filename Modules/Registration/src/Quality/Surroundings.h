#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "petrous/Core/Progress.h"

#include "ImagePair.h"

namespace petrous::registration
{

/// Separate fit of a ball about a point.
struct LocalFit
{
  double radius = 0.0; ///< mm
  /// MR patient mm: mapped point of the local fit minus that of the global fit.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double error = 0.0;  ///< mm, standard deviation along the offset, over bootstraps of the ball
  double spread = 0.0; ///< mm, RMS length of the same deviations
  double gain = 0.0;   ///< relative gain of information by the offset
};

/// Local fits of the balls of 10, 18 and 30 mm about a CT patient point, smallest first:
/// translations of up to 9 mm from the global fit, optimized from the best of a grid of shifts, so
/// that a maximum separate from the global one is found. Balls without content, or that leave the
/// MR, are skipped.
std::vector<LocalFit> fitSurroundings(const ImagePair& pair, const core::RigidTransform& mrFromCt,
                                      const Eigen::Vector3d& ctPoint, std::uint32_t seed,
                                      const core::Progress& progress);

/// The smallest ball that is significantly displaced from the global fit: by more than `least` mm
/// after subtracting twice its error, and with a gain not seen in any good pair
/// (Documentation/adr).
std::optional<LocalFit> displacedPart(const std::vector<LocalFit>& fits, double least);

} // namespace petrous::registration
