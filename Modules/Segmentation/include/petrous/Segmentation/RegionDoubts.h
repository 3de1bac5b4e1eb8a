#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "petrous/Segmentation/Mask.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::segmentation
{

/// Two classes of intensity around a seed, in its 5^3 neighbourhood.
struct SeedSurroundings
{
  static constexpr double kReach = 2.5;  ///< mm
  static constexpr int kMostVoxels = 12; ///< along an axis; kReach down to voxels of 0.2 mm

  double limit = 0.0;                    ///< below it the darker class
  double darker = 0.0, brighter = 0.0;   ///< the means of both
  bool isBrighter = false;               ///< the seed's class is the brighter one
  bool isBorder = false;                 ///< one of the 26 voxels next to the seed is of the other
  std::optional<Eigen::Vector3d> inside; ///< if a border: where the seed would lie inside of its
                                         ///< class and connected with it (isNearOwn), nearest
                                         ///< within kReach and kMostVoxels, patient, LPS mm

  double width = 0.0; ///< of a class: half of the step between the means, or three times the
                      ///< deviation within them where that is more

  bool isOwn(double value) const noexcept { return (value >= limit) == isBrighter; }
  /// And no farther beyond the class's mean than its width: not a third tissue.
  bool isNearOwn(double value) const noexcept
  {
    return isOwn(value) && (isBrighter ? value <= brighter + width : value >= darker - width);
  }
};

/// 1st to 99th percentile of the image.
volume::ValueRange usualRange(const volume::IntensityVolume& image);

/// None where all is one tissue. Two: thresholds by Otsu make classes of a twentieth of the
/// neighbourhood or more, whose means differ by a tenth of the image's range (1st to 99th
/// percentile) or more, and by more than three times the deviation within them; it is 2.7 times in
/// the noise of one tissue, and 3.5 times on a ramp. `seed`: patient, LPS mm; `usual`: the image's
/// usualRange if it is known, as it takes a pass over all voxels. Throws InvalidParameter if the
/// seed lies outside the image.
std::optional<SeedSurroundings>
surroundingsOf(const volume::IntensityVolume& image, const Eigen::Vector3d& seed,
               const std::optional<volume::ValueRange>& usual = std::nullopt);

/// The voxels of a box (all of `box`, x fastest) that are of the seed's class (isNearOwn) and
/// connected by faces with the seed's voxel, which is one of them; 1: it is.
std::vector<std::uint8_t> ownVoxels(const volume::IntensityVolume& image, const core::Index3& seed,
                                    const core::IndexBox& box,
                                    const SeedSurroundings& surroundings);

/// What speaks against a region that was grown from seeds. It may be right all the same.
struct RegionDoubts
{
  static constexpr double kMostVolume = 50e3; ///< mm^3; hardly a structure of the skull base
  static constexpr int kMostFaces = 2;        ///< of the image; a vessel leaves it through two

  std::optional<double> volume; ///< mm^3, where it is more
  std::optional<int> faces;     ///< that it reaches, where there are more
};

RegionDoubts doubtsOf(const Mask& region);

} // namespace petrous::segmentation
