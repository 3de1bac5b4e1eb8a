#include "petrous/Rendering/StandardViews.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace petrous::rendering
{

namespace
{
constexpr std::array<std::pair<StandardView, const char*>, 9> kNames{{
    {StandardView::Lateral, "lateral"},
    {StandardView::Left, "left"},
    {StandardView::Right, "right"},
    {StandardView::Superior, "superior"},
    {StandardView::Inferior, "inferior"},
    {StandardView::Anterior, "anterior"},
    {StandardView::Posterior, "posterior"},
    {StandardView::SurgicalLeft, "surgical-left"},
    {StandardView::SurgicalRight, "surgical-right"},
}};
constexpr double kMidlineWidth = 10.0;  // mm; volumes closer to the midline have no side
constexpr double kViewAngle = 30.0;     // degrees, vertical
constexpr double kSmallestRadius = 1.0; // mm: for single-voxel volumes

// From the patient's centre towards the camera (LPS).
Eigen::Vector3d towardsEye(StandardView view, const Eigen::Vector3d& center)
{
  switch (view)
  {
  case StandardView::Lateral:
    return {center.x() > kMidlineWidth ? 1.0 : -1.0, 0.0, 0.0};
  case StandardView::Left:
  case StandardView::SurgicalLeft:
    return {1.0, 0.0, 0.0};
  case StandardView::Right:
  case StandardView::SurgicalRight:
    return {-1.0, 0.0, 0.0};
  case StandardView::Superior:
    return {0.0, 0.0, 1.0};
  case StandardView::Inferior:
    return {0.0, 0.0, -1.0};
  case StandardView::Anterior:
    return {0.0, -1.0, 0.0};
  case StandardView::Posterior:
    break;
  }
  return {0.0, 1.0, 0.0};
}
} // namespace

std::optional<StandardView> parseView(const std::string& name)
{
  for (const auto& [view, text] : kNames)
    if (name == text)
      return view;
  return std::nullopt;
}

std::string nameOf(StandardView view)
{
  for (const auto& [candidate, text] : kNames)
    if (candidate == view)
      return text;
  return {};
}

core::CameraPose standardCamera(StandardView view, const core::GridGeometry& grid)
{
  const Eigen::Vector3d extent =
      grid.patientFromVoxelLinear() *
      Eigen::Vector3d(grid.dims()[0] - 1.0, grid.dims()[1] - 1.0, grid.dims()[2] - 1.0);
  // The grid's axes are perpendicular, so all corners lie on this sphere.
  return standardCamera(view, grid, grid.center(), 0.5 * extent.norm());
}

core::CameraPose standardCamera(StandardView view, const core::GridGeometry& grid,
                                const Eigen::Vector3d& center, double radius)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const double distance = std::max(radius, kSmallestRadius) / std::sin(0.5 * kViewAngle * degree);

  core::CameraPose pose;
  pose.focalPoint = center;
  const Eigen::Vector3d eye = towardsEye(view, grid.center());
  pose.position = pose.focalPoint + distance * eye;
  const bool isAnteriorUp = std::abs(eye.z()) > 0.5 || view == StandardView::SurgicalLeft ||
                            view == StandardView::SurgicalRight;
  pose.viewUp = isAnteriorUp ? Eigen::Vector3d(0.0, -1.0, 0.0) : Eigen::Vector3d(0.0, 0.0, 1.0);
  pose.viewAngle = kViewAngle;
  return pose;
}

} // namespace petrous::rendering
