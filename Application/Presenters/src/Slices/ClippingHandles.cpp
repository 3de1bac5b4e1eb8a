#include "petrous/Presenters/ClippingHandles.h"

#include <algorithm>

namespace petrous::presenters
{

using Clipping = scene::ViewState::Clipping;

std::string clippingChange(const Clipping& before, const Clipping& after)
{
  if (before.crop == after.crop)
    return "clipping plane";
  Clipping otherBox = before;
  otherBox.crop = after.crop;
  return otherBox == after ? "crop box" : "what is cut away";
}

Clipping::Plane movedPlane(const Clipping::Plane& plane, double step,
                           const core::GridGeometry& grid)
{
  const core::Index3& dims = grid.dims();
  Eigen::AlignedBox1d heights; // of the image's corners over the plane
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d voxel(corner & 1 ? dims[0] - 1 : 0, corner & 2 ? dims[1] - 1 : 0,
                                corner & 4 ? dims[2] - 1 : 0);
    heights.extend(
        Eigen::Matrix<double, 1, 1>(plane.normal.dot(grid.patientFromVoxel(voxel) - plane.point)));
  }
  return {plane.point + std::clamp(step, heights.min()[0], heights.max()[0]) * plane.normal,
          plane.normal};
}

Eigen::Vector3d planeCenter(const Clipping::Plane& plane, const core::GridGeometry& grid)
{
  if (grid.hullContains(grid.voxelFromPatient(plane.point)))
    return plane.point;
  const Eigen::Vector3d middle = grid.center();
  return middle - plane.normal.dot(middle - plane.point) * plane.normal;
}

} // namespace petrous::presenters
