#include "RayView.h"

#include <cmath>

#include <Eigen/LU>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

RayView rayView(const Eigen::Matrix4d& viewFromWorld, const Eigen::Matrix4d& projection,
                const Eigen::Matrix4d& worldFromPatient)
{
  const Eigen::Matrix4d patientFromView = (viewFromWorld * worldFromPatient).inverse();
  const Eigen::Matrix4d viewFromClip = projection.inverse();
  if (!patientFromView.allFinite() || !viewFromClip.allFinite())
    throw core::InvalidParameter("camera: its matrices cannot be inverted");

  const auto unproject = [&](double x, double y, double z) -> Eigen::Vector3d
  {
    const Eigen::Vector4d point = viewFromClip * Eigen::Vector4d(x, y, z, 1.0);
    return point.head<3>() / point[3];
  };
  const Eigen::Matrix3d turn = patientFromView.topLeftCorner<3, 3>();
  const Eigen::Vector3d eye = patientFromView.topRightCorner<3, 1>();

  RayView rays;
  rays.parallel = projection(3, 2) == 0.0;
  if (rays.parallel)
  {
    // Rays start on the camera plane, z = 0 in view coordinates.
    const Eigen::Vector3d along = unproject(0.0, 0.0, 1.0) - unproject(0.0, 0.0, -1.0);
    const Eigen::Vector3d forward = along / std::abs(along.z()); // z = -1, sheared or not
    const auto start = [&](double x, double y) -> Eigen::Vector3d
    {
      const Eigen::Vector3d point = unproject(x, y, 0.0);
      return point + forward * point.z();
    };
    const Eigen::Vector3d center = start(0.0, 0.0);
    rays.origin = turn * center + eye;
    rays.originX = turn * (start(1.0, 0.0) - center);
    rays.originY = turn * (start(0.0, 1.0) - center);
    rays.direction = turn * forward;
    // z = p22 z_view + p23, z_view = -depth
    rays.depth = {0.0, 0.0, projection(2, 3) / projection(2, 2), -1.0 / projection(2, 2)};
    return rays;
  }
  const auto towards = [&](double x, double y) -> Eigen::Vector3d
  {
    const Eigen::Vector3d point = unproject(x, y, 0.0);
    return point / std::abs(point.z());
  };
  const Eigen::Vector3d center = towards(0.0, 0.0);
  rays.origin = eye;
  rays.direction = turn * center;
  rays.directionX = turn * (towards(1.0, 0.0) - center);
  rays.directionY = turn * (towards(0.0, 1.0) - center);
  // z = (p22 z_view + p23) / -z_view, z_view = -depth
  rays.depth = {projection(2, 2), projection(2, 3), 0.0, 0.0};
  return rays;
}

} // namespace petrous::rendering
