#pragma once

#include <optional>

#include "petrous/Core/CameraPose.h"
#include "petrous/Haptics/Device.h"
#include "petrous/Presenters/TouchSession.h"

namespace petrous::presenters
{

/// How a device leads the tool, as the user sets it.
///
/// The device's axes are the view's: right is right on the screen, up is up, towards the user is
/// towards the eye. A millimetre of the hand is `scale` mm of the tool, and a newton at the tool is
/// a newton in the hand at every scale (the servo's gain is 1 / scale). So the hand feels the
/// coupling's stiffness k as k scale, which must not be more than the device renders stably: the
/// coupling is softer where it would be.
///
/// A hand without motors meets nothing that stops it. It is kept on a leash of `thrust` / k, so it
/// presses with `thrust` at most and comes back from the tissue at once.
struct DeviceMapping
{
  static constexpr double kMinScale = 0.05;
  static constexpr double kMaxScale = 2.0;

  double scale = 0.5;               ///< mm of the tool for a mm of the hand
  double thrust = 1.0;              ///< N; of hands without motors
  std::optional<double> forceLimit; ///< N; nothing: what the device can
};

/// 0.5 for motors: a hand's working space of 160 mm is 80 mm of the temporal bone, and a tremor of
/// 0.1 mm half of it. 0.25 for a SpaceMouse: its 40 mm/s are 10 mm/s of the tool.
double usualScale(const haptics::DeviceDescription& device);

/// Sets coupling, limits of force and passivity, whatever they were. `endless`: a speed leads it,
/// so that there is no end to its way.
void fit(TouchSession::Setup& setup, const haptics::DeviceDescription& device,
         const DeviceMapping& lead, bool endless);

/// What is held now.
struct DeviceSwitches
{
  bool clutch = false;
  bool drill = false;
};

/// Throws InvalidParameter for a camera that looks nowhere.
simulation::ServoParameters parametersFor(const haptics::DeviceDescription& device,
                                          const DeviceMapping& lead, const core::CameraPose& camera,
                                          const DeviceSwitches& switches);

/// The centre (TouchSession::Setup) that brings the tool to `tool` (patient mm) while the hand is
/// at `hand` (frame D, mm). With the hand at its origin: `tool` itself.
Eigen::Vector3d centerFor(const Eigen::Vector3d& tool, const Eigen::Vector3d& hand, double scale,
                          const core::CameraPose& camera);

} // namespace petrous::presenters
