#pragma once

#include <vector>

#include "PlaneProxy.h"
#include "petrous/Session/Servo.h"

namespace petrous::session::testing
{

/// A device, a servo and a plane at z = 0, ticked manually at 1 kHz.
struct Session
{
  PlaneProxy proxy;
  Servo servo;
  ServoParameters parameters;
  double now = 100.0;
  double deviceTime = 100.0;
  haptics::DeviceHealth health = haptics::DeviceHealth::Good;
  double pedal = 0.0;
  std::uint32_t buttons = 0;
  std::vector<TickRecord> records;

  static ServoSetup plainSetup()
  {
    ServoSetup setup;
    setup.guard.goodTicks = 20;
    setup.guard.reach = 1000.0;
    setup.limits.maxForce = 10.0;
    setup.limits.maxTorque = 500.0;
    setup.burrPoints = 1;
    return setup;
  }

  explicit Session(const ServoSetup& setup = plainSetup())
    : servo(proxy, setup)
  {
  }

  /// With another tool in place of the plane.
  Session(const ServoSetup& setup, haptics::Proxy& tool)
    : servo(tool, setup)
  {
  }

  const TickRecord& tick(const haptics::Pose& devicePose, double seconds = 0.001)
  {
    now += seconds;
    deviceTime += seconds;
    return tickAsItIs(devicePose);
  }

  /// Without advancing the clocks.
  const TickRecord& tickAsItIs(const haptics::Pose& devicePose)
  {
    haptics::DeviceReading reading;
    reading.time = deviceTime;
    reading.pose = devicePose;
    reading.buttons = buttons;
    reading.pedal = pedal;
    reading.health = health;
    records.push_back(servo.tick(TickInput::of(now, reading, parameters)));
    return records.back();
  }

  /// Moves the device in a straight line in `count` ticks.
  const TickRecord& go(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int count,
                       const Eigen::Quaterniond& heading = Eigen::Quaterniond::Identity())
  {
    for (int n = 1; n <= count; ++n)
      tick({from + (to - from) * n / count, heading});
    return records.back();
  }
};

inline Eigen::Vector3d forceOf(const WrenchValues& wrench)
{
  return wrench.wrench().linear;
}

inline ServoFault faultOf(const TickRecord& record)
{
  return static_cast<ServoFault>(record.fault);
}

} // namespace petrous::session::testing
