#include "petrous/Presenters/ClippingHandles.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

std::optional<CutLine> lineInSlice(const Clipping::Plane& plane, const SliceGeometry& slice)
{
  constexpr double kParallel = 0.002; // sine
  // The height over the plane, mm, is linear in the pixel.
  const double origin = plane.normal.dot(slice.patientFromPixel(0.0, 0.0) - plane.point);
  const Eigen::Vector2d slope(plane.normal.dot(slice.axes().right),
                              plane.normal.dot(slice.axes().down));
  const double sine = slope.norm();
  if (!(sine > kParallel))
    return std::nullopt;
  CutLine line;
  line.kept = slope / sine;
  const Eigen::Vector2d along(-line.kept[1], line.kept[0]);
  const Eigen::Vector2d foot = -origin / (sine * slice.mmPerPixel()) * line.kept;
  double first = -std::numeric_limits<double>::max();
  double last = std::numeric_limits<double>::max();
  const Eigen::Vector2d size(slice.width(), slice.height());
  for (Eigen::Index axis = 0; axis < 2; ++axis)
    if (std::abs(along[axis]) < 1e-12)
    {
      if (foot[axis] < 0.0 || foot[axis] > size[axis])
        return std::nullopt;
    }
    else
    {
      const double a = -foot[axis] / along[axis];
      const double b = (size[axis] - foot[axis]) / along[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
  if (!(first < last))
    return std::nullopt;
  line.from = foot + first * along;
  line.to = foot + last * along;
  return line;
}

std::vector<Eigen::Vector2d> endsOf(const CutLine& line)
{
  constexpr double kInset = 24.0; // px
  const double length = (line.to - line.from).norm();
  if (!(length > 4.0 * kInset))
    return {};
  const Eigen::Vector2d inset = kInset / length * (line.to - line.from);
  return {line.from + inset, line.to - inset};
}

std::optional<CutPart> partAt(const CutLine& line, const Eigen::Vector2d& pixel, double reach)
{
  for (const Eigen::Vector2d& end : endsOf(line))
    if ((pixel - end).norm() < reach)
      return CutPart::End;
  const Eigen::Vector2d along = (line.to - line.from).normalized();
  const double on = along.dot(pixel - line.from);
  const bool isBeside = on >= 0.0 && on <= (line.to - line.from).norm();
  return isBeside && std::abs(line.kept.dot(pixel - line.from)) < reach
             ? std::optional(CutPart::Line)
             : std::nullopt;
}

Eigen::Vector3d pivotInSlice(const Clipping::Plane& plane, const core::GridGeometry& grid,
                             const SliceGeometry& slice)
{
  const CutLine line = lineInSlice(plane, slice).value();
  const Eigen::Vector2d length = line.to - line.from;
  const Eigen::Vector2d handle = slice.pixelFromPatient(planeCenter(plane, grid));
  const double share =
      std::clamp(length.dot(handle - line.from) / length.squaredNorm(), 0.25, 0.75);
  const Eigen::Vector2d pixel = line.from + share * length;
  return slice.patientFromPixel(pixel[0], pixel[1]);
}

Clipping::Plane turnedPlane(const Clipping::Plane& plane, const Eigen::Vector3d& axis,
                            const Eigen::Vector3d& through, double radians,
                            const core::GridGeometry& grid)
{
  const Eigen::AngleAxisd turn(radians, axis);
  return movedPlane({through + turn * (plane.point - through), (turn * plane.normal).normalized()},
                    0.0, grid);
}

double draggedAngle(const Eigen::Vector3d& axis, const Eigen::Vector3d& through,
                    const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  const auto across = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d
  { return point - through - axis.dot(point - through) * axis; };
  return std::atan2(axis.dot(across(from).cross(across(to))), across(from).dot(across(to)));
}

std::optional<double> depthOf(const Clipping::Plane& plane, const core::GridGeometry& grid,
                              const interaction::TissueQuery& tissue)
{
  const Eigen::Vector3d at = planeCenter(plane, grid);
  const double reach = (at - grid.center()).norm() + grid.patientBounds().diagonal().norm();
  const auto hit = tissue({at - reach * plane.normal, plane.normal});
  return hit ? std::optional(reach - *hit) : std::nullopt;
}

} // namespace petrous::presenters
