#pragma once

#include <memory>

#include <Eigen/Geometry>

#include "petrous/Volume/Volume.h"

namespace petrous::volume::testing
{

/// A grid rotated against the patient's axes, centred at the origin.
inline core::GridGeometry turnedGrid(const core::Index3& dims, const Eigen::Vector3d& spacing)
{
  using Eigen::Vector3d;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, -0.4, 0.5).normalized()).toRotationMatrix();
  const Vector3d half = 0.5 * Vector3d(dims[0] - 1, dims[1] - 1, dims[2] - 1).cwiseProduct(spacing);
  return {dims, spacing, -(turn * half), turn};
}

/// Volume with value(patient point) at every voxel.
template <class T, class Value>
std::shared_ptr<Volume<T>> filled(const core::GridGeometry& grid, const Value& value)
{
  auto volume = std::make_shared<Volume<T>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        volume->at(i, j, k) =
            static_cast<T>(value(grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k})));
  return volume;
}

} // namespace petrous::volume::testing
