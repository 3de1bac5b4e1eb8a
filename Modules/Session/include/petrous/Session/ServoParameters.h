#pragma once

#include <cstdint>
#include <type_traits>

#include "petrous/Core/CameraPose.h"

namespace petrous::session
{

/// User settings that may change from tick to tick; trivially copyable.
struct ServoParameters
{
  /// R_PD as w, x, y, z: the device's axes (right, up, towards the user) are the camera's.
  double camera[4] = {1.0, 0.0, 0.0, 0.0};
  double scale = 1.0;          ///< mm of the tool per mm of the device, in [0.01, 10]
  double forceGain = 1.0;      ///< of force and torque on the hand, in [0, 100]: see PoseMapping
  double thrust = 1.0;         ///< N, constant-thrust mode, in [0, 20]
  double approachSpeed = 50.0; ///< mm/s before contact, in (0, 1000]
  /// Vector from the given position to the nearest surface, patient mm: direction of a tool without
  /// contact, and its maximum distance beyond the position; zero: it waits there. For a pointer
  /// tool the direction of its pick ray: of any length if not pressed or when picked up with a
  /// wheel (driftLimit); if pressed, its length is the distance to the surface.
  double approach[3] = {0.0, 0.0, 0.0};
  std::uint32_t clutchButtons = 0; ///< device buttons that hold the tool in place
  std::uint32_t drillButtons = 0;  ///< device buttons that drill at full speed
  std::uint8_t clutch = 0;         ///< 1: held by other means, e.g. a key
  std::uint8_t drill = 0;          ///< bits kDrill and kPedalSpeed
  std::uint8_t constantThrust = 0; ///< bits kPressed and kPointer
  std::uint8_t pause = 0;          ///< 1: no force, no drilling
  /// mm by which the goal of a device without force feedback may lead a tool held by tissue, in [0,
  /// 50]; 0: unlimited. The excess is discarded, so that the tool responds at once when the device
  /// moves back; rotation is limited to `kMaxTurn`.
  float driftLimit = 0.0F;

  static constexpr double kMaxTurn = 0.35; ///< rad

  /// The drill is on, at full speed, by other means than the device's buttons and pedal.
  static constexpr std::uint8_t kDrill = 1;
  /// The pedal's pressure is the fraction of the spindle's speed, as with a surgical drill. The
  /// servo takes it as on from kOnPressure until it falls below kOffPressure, and else as 0.
  /// Without this bit, as in recordings of format 2, a pedal is a switch.
  static constexpr std::uint8_t kPedalSpeed = 2;
  static constexpr double kOnPressure = 0.1;
  static constexpr double kOffPressure = 0.06;

  /// The device provides a pose only; the tool is pressed there with `thrust`.
  static constexpr std::uint8_t kPressed = 1;
  /// Pointer tool: unpressed it moves to its target without pressing (Traverse), and is relocated
  /// if too far from it (Servo).
  static constexpr std::uint8_t kPointer = 2;

  /// All values are in the ranges above.
  bool valid() const noexcept;
};

static_assert(std::is_trivially_copyable_v<ServoParameters> && sizeof(ServoParameters) == 104);

/// Throws InvalidParameter naming the first value out of range.
void check(const ServoParameters& parameters);

/// Sets `camera` from the rendering camera. Throws InvalidParameter if the camera has no direction
/// or looks along its up vector.
void setCamera(ServoParameters& parameters, const core::CameraPose& camera);

} // namespace petrous::session
