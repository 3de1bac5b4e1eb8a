#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Session/TouchSession.h"

namespace petrous::presenters::testing
{

/// A tool pressed down (towards -z) at a point, as a window would do it.
class HeldTool
{
public:
  explicit HeldTool(
      const Eigen::Vector3d& place,
      session::TouchTool::Mode mode = session::TouchTool::Mode::ThreeDof) // made at once
    : device(place)
  {
    setup.tool.mode = mode;
    haptics::Pose pose;
    pose.position = place;
    device.want(pose);
    setup.center = place;
    setup.parameters.constantThrust = 1;
    setup.parameters.drillButtons = interaction::PointerDevice::kDrill;
    setup.parameters.approach[2] = -5.0;
    setup.tool.burr.rpm = 600000.0; // ten times as fast, to shorten the tests
  }

  void drill(bool on) { device.setButtons(on ? interaction::PointerDevice::kDrill : 0U); }

  interaction::PointerDevice device;
  session::TouchSession::Setup setup;
};

/// Calls `advance` repeatedly, as a window does, until it returns true; false after a minute.
inline bool until(const std::function<bool()>& advance)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end)
  {
    if (advance())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

} // namespace petrous::presenters::testing
