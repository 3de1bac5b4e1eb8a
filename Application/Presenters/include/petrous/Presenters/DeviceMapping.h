#pragma once

#include <optional>

#include "petrous/Core/CameraPose.h"
#include "petrous/Haptics/Device.h"
#include "petrous/Session/TouchSession.h"

namespace petrous::presenters
{

/// How a device is mapped to the tool, as set by the user.
///
/// The device's axes are those of the view: right is right on the screen, up is up, towards the
/// user is towards the camera. A device motion of 1 mm moves the tool by `scale` mm, and 1 N at the
/// tool is 1 N at the device at every scale (the servo's gain is 1 / scale). So the stiffness k of
/// the coupling is felt as k scale, which must not exceed what the device renders stably: the
/// coupling is softened if it would.
///
/// A device without force feedback cannot stop the user's hand. The coupling's drift limit is then
/// `thrust` / k, so that the tool presses with at most `thrust` and leaves the tissue at once.
struct DeviceMapping
{
  static constexpr double kMinScale = 0.05;
  static constexpr double kMaxScale = 2.0;

  double scale = 0.5;               ///< mm of the tool per mm of the device
  double thrust = 1.0;              ///< N; for devices without force feedback
  std::optional<double> forceLimit; ///< N; none: the device's maximum
};

/// 0.5 with force feedback: a workspace of 160 mm covers 80 mm of the temporal bone, and a tremor
/// of 0.1 mm is halved. 0.25 for a SpaceMouse: its 40 mm/s are 10 mm/s of the tool.
double usualScale(const haptics::DeviceDescription& device);

/// Sets coupling, force limits and passivity, overwriting what `setup` had. `endless`: the device
/// is rate-controlled, so its workspace is unbounded.
void fit(session::TouchSession::Setup& setup, const haptics::DeviceDescription& device,
         const DeviceMapping& mapping, bool endless);

/// Throws InvalidParameter for a degenerate camera.
session::ServoParameters parametersFor(const haptics::DeviceDescription& device,
                                       const DeviceMapping& mapping,
                                       const core::CameraPose& camera);

/// The centre (TouchSession::Setup) that brings the tool to `tool` (patient mm) while the device is
/// at `hand` (frame D, mm). With the device at its origin: `tool` itself.
Eigen::Vector3d centerFor(const Eigen::Vector3d& tool, const Eigen::Vector3d& hand, double scale,
                          const core::CameraPose& camera);

} // namespace petrous::presenters
