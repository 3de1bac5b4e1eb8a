#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "petrous/Core/Progress.h"

#include "ImagePair.h"

namespace petrous::registration
{

/// Where what lies within a ball about a point goes by itself.
struct LocalFit
{
  double radius = 0.0; ///< mm
  /// MR patient mm: where it puts the point, from where the fit of the whole puts it.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double error = 0.0;  ///< mm, standard deviation along the offset, over bootstraps of the ball
  double spread = 0.0; ///< mm, root mean square length of the same
  double gain = 0.0;   ///< information that it wins by the offset, as a share of what it has there
};

/// Local fits of the balls of 10, 18 and 30 mm about a CT patient point, smallest first:
/// translations of up to 9 mm from the fit of the whole, climbed to from the best of a grid of
/// shifts, so that a maximum apart from the whole's is found. Balls that show nothing, or leave the
/// MR, are left out.
std::vector<LocalFit> fitSurroundings(const ImagePair& pair, const core::RigidTransform& mrFromCt,
                                      const Eigen::Vector3d& ctPoint, std::uint32_t seed,
                                      const core::Progress& progress);

/// The smallest ball that certainly lies elsewhere than the fit of the whole puts it: by more than
/// `least` mm beside twice its error, and with a gain that no good pair was seen to have
/// (Documentation/adr).
std::optional<LocalFit> displacedPart(const std::vector<LocalFit>& fits, double least);

} // namespace petrous::registration
