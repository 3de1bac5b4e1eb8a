#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Scene/Case.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::presenters::testing
{

using Inside = std::function<bool(const Eigen::Vector3d& patient)>;

/// Share of each voxel that lies inside, from 5^3 places in it: what a perfect drawing would be.
inline std::shared_ptr<const volume::Volume<float>> occupancyOf(const core::GridGeometry& grid,
                                                                const Inside& isInside)
{
  constexpr int kSub = 5;
  auto occupancy = std::make_shared<volume::Volume<float>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        // Most voxels lie wholly inside or outside.
        int corners = 0;
        for (int n = 0; n < 8; ++n)
          corners += isInside(grid.patientFromVoxel(Eigen::Vector3d(
                         i + (n & 1) - 0.5, j + (n >> 1 & 1) - 0.5, k + (n >> 2) - 0.5)))
                         ? 1
                         : 0;
        const bool isMiddle = isInside(grid.patientFromVoxel(Eigen::Vector3d(i, j, k)));
        if (corners == (isMiddle ? 8 : 0))
        {
          occupancy->at(i, j, k) = isMiddle ? 1.0F : 0.0F;
          continue;
        }
        int count = 0;
        for (int n = 0; n < kSub * kSub * kSub; ++n)
        {
          const Eigen::Vector3d off(n % kSub, n / kSub % kSub, n / (kSub * kSub));
          const Eigen::Vector3d at = Eigen::Vector3d(i, j, k) +
                                     (off + Eigen::Vector3d::Constant(0.5)) / kSub -
                                     Eigen::Vector3d::Constant(0.5);
          count += isInside(grid.patientFromVoxel(at)) ? 1 : 0;
        }
        occupancy->at(i, j, k) = static_cast<float>(count) / (kSub * kSub * kSub);
      }
  return occupancy;
}

struct Shape
{
  std::string name;
  Inside isInside;
};

/// A case whose CT is all bone of 1000 HU and whose structures are these, drawn on its grid; where
/// they overlap, the later one.
inline scene::Case shapeCase(
    const core::GridGeometry& grid, const std::vector<Shape>& shapes,
    const Inside& isBone = [](const Eigen::Vector3d&) { return true; })
{
  scene::Case value;
  value.name = "shapes";
  value.ct.geometry = grid;
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid);
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const Eigen::Vector3d at = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        labels->at(i, j, k) = 0;
        for (std::size_t n = 0; n < shapes.size(); ++n)
          if (shapes[n].isInside(at))
            labels->at(i, j, k) = static_cast<std::uint16_t>(n + 1);
        ct->at(i, j, k) = static_cast<std::int16_t>(isBone(at) ? 1000 : -1000);
      }
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  scene::LabelPart part;
  part.drawnOn = "";
  for (std::size_t n = 0; n < shapes.size(); ++n)
  {
    scene::StructurePart structure;
    structure.name = shapes[n].name;
    structure.index = static_cast<std::uint16_t>(n + 1);
    for (std::size_t v = 0; v < labels->size(); ++v)
      structure.voxels += labels->data()[v] == n + 1 ? 1 : 0;
    structure.volume = static_cast<double>(structure.voxels) * grid.voxelVolume();
    part.structures.push_back(structure);
  }
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, {}));
  if (!shapes.empty())
    value.labels.push_back(part);
  value.dissection = dissection::Dissection(grid);
  return value;
}

inline Inside ball(const Eigen::Vector3d& center, double radius)
{
  return [=](const Eigen::Vector3d& at) { return (at - center).norm() < radius; };
}

/// Flat at its ends.
inline Inside cylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius)
{
  return [=](const Eigen::Vector3d& at)
  {
    const Eigen::Vector3d axis = (to - from).normalized();
    const double along = axis.dot(at - from);
    return along > 0.0 && along < (to - from).norm() && (at - from - along * axis).norm() < radius;
  };
}

} // namespace petrous::presenters::testing
