#pragma once

#include <cstdint>
#include <string>

#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// Capabilities of a device. Constant while it is connected.
struct DeviceDescription
{
  std::string name;           ///< display name: "3Dconnexion SpaceMouse Pro"
  bool sensesRotation = true; ///< false: the tool keeps its orientation
  bool givesForce = false;
  bool givesTorque = false;
  double maxForce = 0.0;            ///< N
  double maxTorque = 0.0;           ///< N mm
  double maxStiffness = 0.0;        ///< N/mm rendered stably; 0 without force feedback
  double maxAngularStiffness = 0.0; ///< N mm/rad
};

/// Why a device delivers no usable reading.
enum class DeviceHealth : std::uint8_t
{
  Good,
  NotReady,     ///< connected, no reading yet
  Stale,        ///< the last reading is too old
  Disconnected, ///< unplugged, or its server has ended
  Faulty        ///< reports an error, or sends implausible values
};

/// State of the handle at one instant, in the device frame D (right, up, towards the user).
struct DeviceReading
{
  double time = 0.0;         ///< s on the servo's clock, when the pose was measured
  Pose pose;                 ///< X_DT, mm: handle's grip, +z towards the user's wrist
  std::uint32_t buttons = 0; ///< bit n: button n is held
  double pedal = 0.0;        ///< pressure 0 to 1; a switch yields 0 or 1
  DeviceHealth health = DeviceHealth::NotReady;
};

/// A hand-held device. Both calls come from the servo thread at 1 kHz and must not wait, lock,
/// allocate or throw. Blocking I/O (USB, sockets) runs in a thread of its own.
class Device
{
public:
  virtual ~Device() = default;
  virtual const DeviceDescription& description() const noexcept = 0;

  /// The latest reading; `now` in seconds on the servo's clock.
  virtual DeviceReading read(double now) noexcept = 0;

  /// Force and torque on the hand about the grip, in frame D, already within the limits of
  /// `description()`. Ignored by a device without motors.
  virtual void send(const Wrench& wrench) noexcept = 0;
};

} // namespace petrous::haptics
