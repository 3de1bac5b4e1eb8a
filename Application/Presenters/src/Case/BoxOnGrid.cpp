#include "BoxOnGrid.h"

namespace petrous::presenters
{

Eigen::AlignedBox3d boxOn(const core::GridGeometry& onto, const core::GridGeometry& grid,
                          const core::IndexBox& box)
{
  using Box = Eigen::AlignedBox3d;
  const Box centres(Eigen::Vector3d(box.lower[0], box.lower[1], box.lower[2]),
                    Eigen::Vector3d(box.upper[0] - 1, box.upper[1] - 1, box.upper[2] - 1));
  Box result;
  for (int corner = 0; corner < 8; ++corner)
    result.extend(onto.voxelFromPatient(
        grid.patientFromVoxel(centres.corner(static_cast<Box::CornerType>(corner)))));
  return result;
}

bool isWithin(const core::GridGeometry& onto, const core::GridGeometry& grid,
              const core::IndexBox& box)
{
  const Eigen::AlignedBox3d centres = boxOn(onto, grid, box);
  const core::Index3& n = onto.dims();
  return (centres.min().array() > -0.5).all() &&
         (centres.max().array() < Eigen::Array3d(n[0], n[1], n[2]) - 0.5).all();
}

} // namespace petrous::presenters
