#pragma once

#include <cstdint>
#include <string>

#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// What a device is and may be asked for. Fixed while it is connected.
struct DeviceDescription
{
  std::string name;           ///< for people: "3Dconnexion SpaceMouse Pro"
  bool sensesRotation = true; ///< false: the tool keeps its heading
  bool givesForce = false;
  bool givesTorque = false;
  double maxForce = 0.0;            ///< N
  double maxTorque = 0.0;           ///< N mm
  double maxStiffness = 0.0;        ///< N/mm that it renders stably; 0 where it gives no force
  double maxAngularStiffness = 0.0; ///< N mm/rad
};

/// Why a device gives nothing now.
enum class DeviceHealth : std::uint8_t
{
  Good,
  NotReady,     ///< connected, no reading yet
  Stale,        ///< the last reading is older than it may be
  Disconnected, ///< unplugged, or its server has gone
  Faulty        ///< it reports an error, or sends what no such device can
};

/// What the hand does at one moment, in the device's frame D (right, up, towards the user).
struct DeviceReading
{
  double time = 0.0;         ///< s on the servo's clock, when the hand was there
  Pose pose;                 ///< X_DT, mm: handle's grip, +z towards the user's wrist
  std::uint32_t buttons = 0; ///< bit n: button n is held
  double pedal = 0.0;        ///< pressure 0 to 1; a switch gives 0 or 1
  DeviceHealth health = DeviceHealth::NotReady;
};

/// A device that a hand holds. Both calls come from the servo's thread, 1000 times a second: they
/// neither wait, lock, allocate nor throw. Whatever waits (USB, a socket) has a thread of its own.
class Device
{
public:
  virtual ~Device() = default;
  virtual const DeviceDescription& description() const noexcept = 0;

  /// The latest reading; `now` in seconds on the servo's clock.
  virtual DeviceReading read(double now) noexcept = 0;

  /// Force and torque on the hand about the grip, in frame D, already within the limits of
  /// `description()`. A device without motors ignores it.
  virtual void send(const Wrench& wrench) noexcept = 0;
};

} // namespace petrous::haptics
