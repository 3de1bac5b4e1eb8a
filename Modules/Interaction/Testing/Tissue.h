#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "petrous/Interaction/SightLine.h"
#include "petrous/Volume/TissueField.h"

/// Tissue and records for the tests of this module.
namespace petrous::interaction::testing
{

/// Solid below z = height.
inline TissueQuery plane(double height)
{
  return [height](const SightLine& line) -> std::optional<double>
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
  return [](const SightLine&) { return std::optional<double>(); };
}

/// A block of bone that fills its grid (20 x 20 x 20 mm about the origin) below z = 0.
inline std::shared_ptr<const volume::TissueField> block()
{
  const core::GridGeometry grid({41, 41, 41}, {0.5, 0.5, 0.5}, {-10.0, -10.0, -10.0});
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < 41; ++k)
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 41; ++i)
      {
        const double depth = -grid.patientFromVoxel(Eigen::Vector3d(i, j, k)).z();
        voxels->at(i, j, k) = static_cast<std::int16_t>(
            std::lround(std::clamp(300.0 + 400.0 * depth, -1000.0, 1500.0)));
      }
  return std::make_shared<volume::TissueField>(
      std::make_shared<volume::IntensityVolume>(std::move(voxels)),
      std::vector<volume::TissueField::SolidUnion>(), nullptr, volume::TissueField::Parameters());
}

} // namespace petrous::interaction::testing
