#include "petrous/Interaction/OrbitCamera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace petrous::interaction
{

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kNearest = 1.0;      // mm
constexpr double kFarthest = 10000.0; // mm

struct Frame
{
  Eigen::Vector3d right, up;
};

Frame frameOf(const core::CameraPose& camera)
{
  const Eigen::Vector3d forward = (camera.focalPoint - camera.position).normalized();
  const Eigen::Vector3d right = forward.cross(camera.viewUp).normalized();
  return {right, right.cross(forward)};
}
} // namespace

core::CameraPose turned(const core::CameraPose& camera, double right, double down)
{
  const Frame frame = frameOf(camera);
  // The camera rotates opposite to the apparent rotation of the patient.
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-right * kDegree, frame.up) *
                                Eigen::AngleAxisd(-down * kDegree, frame.right));
  core::CameraPose next = camera;
  next.position = camera.focalPoint + turn * (camera.position - camera.focalPoint);
  next.viewUp = (turn * frame.up).normalized();
  return next;
}

core::CameraPose rolled(const core::CameraPose& camera, double degrees)
{
  const Frame frame = frameOf(camera);
  // The camera turns counterclockwise for what it sees to turn clockwise.
  const double angle = degrees * kDegree;
  core::CameraPose next = camera;
  next.viewUp = (std::cos(angle) * frame.up - std::sin(angle) * frame.right).normalized();
  return next;
}

core::CameraPose shifted(const core::CameraPose& camera, double right, double down)
{
  const Frame frame = frameOf(camera);
  const double distance = (camera.focalPoint - camera.position).norm();
  const double height = camera.parallelScale
                            ? 2.0 * *camera.parallelScale
                            : 2.0 * distance * std::tan(0.5 * camera.viewAngle * kDegree);
  const Eigen::Vector3d offset = height * (down * frame.up - right * frame.right);
  core::CameraPose next = camera;
  next.position += offset;
  next.focalPoint += offset;
  return next;
}

std::string directionLetters(const Eigen::Vector3d& direction)
{
  constexpr double kShare = 0.4; // minimum component of the unit vector to be named
  constexpr char towards[3][2] = {{'R', 'L'}, {'A', 'P'}, {'I', 'S'}};
  const Eigen::Vector3d unit = direction.stableNormalized();
  std::array<Eigen::Index, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&unit](Eigen::Index a, Eigen::Index b)
                   { return std::abs(unit[a]) > std::abs(unit[b]); });
  std::string letters;
  for (const Eigen::Index axis : axes)
    if (std::abs(unit[axis]) >= kShare)
      letters += towards[axis][unit[axis] > 0.0 ? 1 : 0];
  return letters;
}

EdgeDirections edgeDirections(const core::CameraPose& camera)
{
  const Frame frame = frameOf(camera);
  return {directionLetters(-frame.right), directionLetters(frame.right), directionLetters(frame.up),
          directionLetters(-frame.up)};
}

core::CameraPose zoomed(const core::CameraPose& camera, double factor)
{
  core::CameraPose next = camera;
  if (!(factor > 0.0))
    return next;
  if (camera.parallelScale)
  {
    next.parallelScale = std::clamp(*camera.parallelScale / factor, kNearest, kFarthest);
    return next;
  }
  const Eigen::Vector3d arm = camera.position - camera.focalPoint;
  const double distance = std::clamp(arm.norm() / factor, kNearest, kFarthest);
  next.position = camera.focalPoint + distance * arm.normalized();
  return next;
}

} // namespace petrous::interaction
