#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "petrous/Interaction/PickRay.h"
#include "petrous/Volume/TissueField.h"

/// Tissue and records for this module's tests.
namespace petrous::interaction::testing
{

/// Solid below z = height.
inline TissueQuery plane(double height)
{
  return [height](const PickRay& line) -> std::optional<double>
  {
    if (line.origin.z() <= height)
      return 0.0;
    if (line.direction.z() >= 0.0)
      return std::nullopt;
    return (height - line.origin.z()) / line.direction.z();
  };
}

inline TissueQuery nothing()
{
  return [](const PickRay&) { return std::optional<double>(); };
}

/// Bone where `depth` > 0, mm, in a grid of 20 x 20 x 20 mm around the origin.
template <typename Depth>
std::shared_ptr<const volume::TissueField> boneOf(const Depth& depthAt)
{
  const core::GridGeometry grid({41, 41, 41}, {0.5, 0.5, 0.5}, {-10.0, -10.0, -10.0});
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < 41; ++k)
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 41; ++i)
      {
        const double depth = depthAt(grid.patientFromVoxel(Eigen::Vector3d(i, j, k)));
        voxels->at(i, j, k) = static_cast<std::int16_t>(
            std::lround(std::clamp(300.0 + 400.0 * depth, -1000.0, 1500.0)));
      }
  return std::make_shared<volume::TissueField>(
      std::make_shared<volume::IntensityVolume>(std::move(voxels)),
      std::vector<volume::TissueField::SolidUnion>(), nullptr, volume::TissueField::Parameters());
}

/// A block of bone that fills its grid below z = 0.
inline std::shared_ptr<const volume::TissueField> block()
{
  return boneOf([](const Eigen::Vector3d& p) { return -p.z(); });
}

/// The same block with a round hole from (x, y, 0) along -z, ending in a ball of the same radius
/// about `depth` below.
inline std::shared_ptr<const volume::TissueField> blockWithHole(double x, double y, double radius,
                                                                double depth)
{
  return boneOf(
      [=](const Eigen::Vector3d& p)
      {
        const Eigen::Vector3d axis(x, y, std::clamp(p.z(), -depth, 100.0));
        return std::min(-p.z(), (p - axis).norm() - radius);
      });
}

} // namespace petrous::interaction::testing
