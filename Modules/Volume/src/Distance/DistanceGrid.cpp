#include "DistanceGrid.h"

#include <algorithm>
#include <cmath>

namespace petrous::volume
{

namespace
{
constexpr double kFinest = 0.5; // voxels of the occupancy: minimum edge
}

core::IndexBox insideBox(const Volume<float>& occupancy)
{
  const core::Index3& dims = occupancy.geometry().dims();
  core::IndexBox box{dims, {0, 0, 0}};
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        if (occupancy.at(i, j, k) > 0.5F)
        {
          const core::Index3 at{i, j, k};
          for (std::size_t a = 0; a < 3; ++a)
          {
            box.lower[a] = std::min(box.lower[a], at[a]);
            box.upper[a] = std::max(box.upper[a], at[a] + 1);
          }
        }
  return box;
}

DistanceGrid gridFor(const core::GridGeometry& occupancy, const core::IndexBox& box, double beyond,
                     std::size_t maxVoxels)
{
  DistanceGrid grid;
  grid.edge = kFinest * occupancy.minSpacing();
  Eigen::Vector3d size;
  for (;; grid.edge *= 1.25)
  {
    // At least three nodes: the support of the spline extends over two on each side.
    const double margin = beyond + grid.edge;
    std::size_t count = 1;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const double h = occupancy.spacing()[axis];
      const double past = std::max(margin, h + grid.edge);
      grid.origin[axis] = box.lower[a] * h - past;
      size[axis] = (box.upper[a] - 1) * h + past - grid.origin[axis];
      grid.dims[a] = static_cast<int>(std::ceil(size[axis] / grid.edge)) + 1;
      count *= static_cast<std::size_t>(grid.dims[a]);
    }
    if (count <= maxVoxels || grid.edge > size.maxCoeff())
      return grid;
  }
}

core::GridGeometry geometryOf(const DistanceGrid& grid, const core::GridGeometry& occupancy)
{
  return {grid.dims, Eigen::Vector3d::Constant(grid.edge),
          occupancy.patientFromVoxel(grid.origin.cwiseQuotient(occupancy.spacing())),
          occupancy.direction()};
}

} // namespace petrous::volume
