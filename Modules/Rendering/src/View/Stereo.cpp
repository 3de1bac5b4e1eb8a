#include "petrous/Rendering/Stereo.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;

double separationOf(double angle, double convergence)
{
  return 2.0 * convergence * std::tan(0.5 * angle * kDegree);
}

double focalDistance(const core::CameraPose& camera)
{
  return (camera.focalPoint - camera.position).norm();
}

[[noreturn]] void refuse(const std::string& what, double value, double lower, double upper,
                         const std::string& why = {})
{
  throw core::InvalidParameter("stereo: " + what + " of " + core::plainText(value) + " mm; " +
                               core::plainText(lower) + " to " + core::plainText(upper) +
                               " mm are possible" + why);
}

bool within(double value, double lower, double upper)
{
  return value >= lower && value <= upper; // false for NaN
}
} // namespace

std::optional<StereoMode> parseStereoMode(const std::string& name)
{
  if (name == "none")
    return StereoMode::None;
  if (name == "side-by-side")
    return StereoMode::SideBySide;
  if (name == "interleaved")
    return StereoMode::Interleaved;
  if (name == "anaglyph")
    return StereoMode::Anaglyph;
  return std::nullopt;
}

StereoGeometry stereoGeometry(const core::CameraPose& camera, const StereoRig& rig)
{
  StereoGeometry geometry;
  geometry.convergence = rig.convergence.value_or(focalDistance(camera));
  if (!within(geometry.convergence, StereoRig::kNearestConvergence,
              StereoRig::kFarthestConvergence))
    refuse(rig.convergence ? "a convergence"
                           : "a focal distance, which is where the eyes converge,",
           geometry.convergence, StereoRig::kNearestConvergence, StereoRig::kFarthestConvergence);
  geometry.eyeSeparation =
      rig.eyeSeparation.value_or(separationOf(StereoRig::kUsualAngle, geometry.convergence));
  if (!within(geometry.eyeSeparation, 0.0, StereoRig::kLargestSeparation) && rig.eyeSeparation)
    refuse("an eye separation", geometry.eyeSeparation, 0.0, StereoRig::kLargestSeparation);
  const double widest = separationOf(StereoRig::kWidestAngle, geometry.convergence);
  if (geometry.eyeSeparation > widest)
    refuse("an eye separation", geometry.eyeSeparation, 0.0, widest,
           " where the eyes converge at " + core::plainText(geometry.convergence) + " mm");
  return geometry;
}

StereoGeometry fittedStereoGeometry(const core::CameraPose& camera, const StereoRig& rig)
{
  StereoGeometry geometry;
  geometry.convergence =
      std::clamp(rig.convergence.value_or(focalDistance(camera)), StereoRig::kNearestConvergence,
                 StereoRig::kFarthestConvergence);
  const double widest = separationOf(StereoRig::kWidestAngle, geometry.convergence);
  geometry.eyeSeparation =
      rig.eyeSeparation
          ? std::clamp(*rig.eyeSeparation, 0.0, std::min(StereoRig::kLargestSeparation, widest))
          : separationOf(StereoRig::kUsualAngle, geometry.convergence);
  return geometry;
}

EyePair eyesOf(const core::CameraPose& camera, const StereoGeometry& geometry)
{
  const Eigen::Vector3d forward = (camera.focalPoint - camera.position).normalized();
  const Eigen::Vector3d right = forward.cross(camera.viewUp).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  const double half = 0.5 * geometry.eyeSeparation;
  const auto eye = [&](double side)
  {
    core::CameraPose pose = camera;
    pose.head = {camera.position, camera.focalPoint};
    if (camera.parallelScale)
    {
      const Eigen::Vector3d pivot = camera.position + geometry.convergence * forward;
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(side * std::asin(std::min(half / geometry.convergence, 1.0)), up)
              .toRotationMatrix();
      pose.position = pivot + turn * (camera.position - pivot);
      pose.focalPoint = pivot + turn * (camera.focalPoint - pivot);
      pose.viewUp = up; // unchanged by the rotation
      return pose;
    }
    pose.position += side * half * right;
    pose.focalPoint += side * half * right;
    pose.lensShift -=
        side * half / (geometry.convergence * std::tan(0.5 * camera.viewAngle * kDegree));
    return pose;
  };
  return {eye(-1.0), eye(1.0)};
}

std::pair<int, int> eyeSize(StereoMode mode, int width, int height)
{
  if (mode != StereoMode::SideBySide)
    return {width, height};
  if (width % 2 != 0)
    throw RenderingError(RenderingError::Reason::BadSize,
                         "a side-by-side picture of " + std::to_string(width) +
                             " columns; their number must be even");
  return {width / 2, height};
}

Picture composeStereo(const Picture& left, const Picture& right, StereoMode mode)
{
  if (left.width != right.width || left.height != right.height)
    throw RenderingError(RenderingError::Reason::BadSize,
                         "the eyes' pictures differ in size: " + std::to_string(left.width) +
                             " x " + std::to_string(left.height) + " and " +
                             std::to_string(right.width) + " x " + std::to_string(right.height));
  Picture both = left;
  const std::size_t row = 3 * static_cast<std::size_t>(left.width);
  if (mode == StereoMode::SideBySide)
  {
    both.width = 2 * left.width;
    both.rgb.resize(2 * left.rgb.size());
    for (int y = 0; y < left.height; ++y)
    {
      std::uint8_t* out = both.rgb.data() + 2 * row * static_cast<std::size_t>(y);
      std::memcpy(out, left.pixel(0, y), row);
      std::memcpy(out + row, right.pixel(0, y), row);
    }
  }
  else if (mode == StereoMode::Interleaved)
  {
    for (int y = 1; y < left.height; y += 2)
      std::memcpy(both.rgb.data() + row * static_cast<std::size_t>(y), right.pixel(0, y), row);
  }
  else if (mode == StereoMode::Anaglyph)
  {
    for (std::size_t i = 0; i + 2 < both.rgb.size(); i += 3)
    {
      const double luma = 0.299 * left.rgb[i] + 0.587 * left.rgb[i + 1] + 0.114 * left.rgb[i + 2];
      both.rgb[i] = static_cast<std::uint8_t>(std::lround(luma));
      both.rgb[i + 1] = right.rgb[i + 1];
      both.rgb[i + 2] = right.rgb[i + 2];
    }
  }
  return both;
}

} // namespace petrous::rendering
