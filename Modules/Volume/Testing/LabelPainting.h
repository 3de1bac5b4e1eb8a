#pragma once

#include <cmath>
#include <functional>
#include <memory>

#include <Eigen/Geometry>

#include "petrous/Volume/LabelField.h"
#include "petrous/Volume/Sampling.h"

/// Label maps for tests, and queries of their label field at a patient point.
namespace petrous::testing
{

using Labels = std::shared_ptr<const volume::LabelMap>;

inline core::GridGeometry cube(int n, double spacing,
                               const Eigen::Vector3d& center = Eigen::Vector3d::Zero(),
                               const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity())
{
  return {{n, n, n},
          Eigen::Vector3d::Constant(spacing),
          center - direction * Eigen::Vector3d::Constant(0.5 * (n - 1) * spacing),
          direction};
}

inline Eigen::Matrix3d turned()
{
  return Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

// labelAt: patient position -> label.
inline Labels paint(const core::GridGeometry& grid,
                    const std::function<std::uint16_t(const Eigen::Vector3d&)>& labelAt)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        voxels->at(i, j, k) = labelAt(grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}));
  return std::make_shared<volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {}));
}

inline Labels paintBox(const core::GridGeometry& grid, const core::IndexBox& box,
                       std::uint16_t label = 1)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        voxels->at(i, j, k) = label;
  return std::make_shared<volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {}));
}

inline double occupancyAt(const volume::LabelField& field, const Eigen::Vector3d& patient)
{
  const core::GridGeometry& grid = field.occupancy->geometry();
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  return grid.hullContains(voxel) ? volume::sampleTrilinear(*field.occupancy, voxel) : 0.0;
}

inline int indexAt(const volume::LabelField& field, const Eigen::Vector3d& patient)
{
  const core::GridGeometry& grid = field.index->geometry();
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  if (!grid.hullContains(voxel))
    return 0;
  return field.index->at(static_cast<int>(std::lround(voxel[0])),
                         static_cast<int>(std::lround(voxel[1])),
                         static_cast<int>(std::lround(voxel[2])));
}

} // namespace petrous::testing
