#include "petrous/Presenters/HandpiecePresets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "petrous/Interaction/PointerToolController.h"

namespace petrous::presenters
{

using Eigen::Vector3d;
using scene::ViewState;

namespace
{

constexpr double kDegree = 3.14159265358979323846 / 180.0;

struct Axis
{
  const char* name;
  double posterior; ///< degrees from the left-right axis
  double superior;  ///< likewise
};

const Axis& axisOf(SurgicalApproach approach)
{
  static constexpr Axis kAxes[] = {{"transmastoid", 0.0, 0.0},
                                   {"posterior-tympanotomy", 30.0, 0.0},
                                   {"translabyrinthine", 15.0, 0.0},
                                   {"retrosigmoid", 45.0, 0.0},
                                   {"middle-fossa", 0.0, 45.0}};
  return kAxes[static_cast<std::size_t>(approach)];
}

// The screen's axes in those of the patient: right, up, to the eye.
Eigen::Quaterniond screenOf(const core::CameraPose& camera)
{
  session::ServoParameters parameters;
  session::setCamera(parameters, camera);
  const double* q = parameters.camera;
  return {q[0], q[1], q[2], q[3]};
}

} // namespace

const char* nameOf(SurgicalApproach approach)
{
  return axisOf(approach).name;
}

std::optional<SurgicalApproach> parseSurgicalApproach(const std::string& name)
{
  for (const SurgicalApproach approach : kSurgicalApproaches)
    if (name == nameOf(approach))
      return approach;
  return std::nullopt;
}

ViewState::Handpiece usualHandpiece(bool isLeftHand)
{
  const interaction::AimSettings usual;
  return {std::remainder(isLeftHand ? 180.0 - usual.turn : usual.turn, 360.0), usual.tilt,
          isLeftHand};
}

Vector3d shaftOf(SurgicalApproach approach, scene::Side ear, bool isLeftHand)
{
  const double posterior = axisOf(approach).posterior * kDegree;
  const double superior = axisOf(approach).superior * kDegree;
  const double lateral = ear == scene::Side::Left ? 1.0 : -1.0; // LPS x
  core::CameraPose eye;
  eye.focalPoint = Vector3d::Zero();
  eye.position = {lateral * std::cos(posterior) * std::cos(superior),
                  std::sin(posterior) * std::cos(superior), std::sin(superior)};
  // Away from the surgeon: the face, or the feet of one who sits at the vertex.
  eye.viewUp = superior > 0.0 ? Vector3d(0.0, 0.0, -1.0) : Vector3d(0.0, -1.0, 0.0);
  const ViewState::Handpiece hand = usualHandpiece(isLeftHand);
  const double turn = hand.turn * kDegree;
  const double tilt = hand.tilt * kDegree;
  return screenOf(eye) *
         Vector3d(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
}

std::optional<ViewState::Handpiece> handpieceAlong(const Vector3d& shaft,
                                                   const core::CameraPose& camera, bool isLeftHand)
{
  const Vector3d seen = screenOf(camera).conjugate() * shaft.normalized();
  ViewState::Handpiece hand;
  hand.isLeft = isLeftHand;
  hand.turn = std::atan2(seen.y(), seen.x()) / kDegree;
  hand.tilt = std::acos(std::clamp(seen.z(), -1.0, 1.0)) / kDegree;
  if (hand.tilt > interaction::AimSettings::kMaxTilt)
    return std::nullopt;
  return hand;
}

} // namespace petrous::presenters
