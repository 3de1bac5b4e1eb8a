#pragma once

#include <cstdint>
#include <type_traits>

#include "petrous/Core/CameraPose.h"

namespace petrous::simulation
{

/// What may change from tick to tick by the user's will; copied as bytes.
struct ServoParameters
{
  /// R_PD as w, x, y, z: the device's axes (right, up, towards the user) are the camera's.
  double camera[4] = {1.0, 0.0, 0.0, 0.0};
  double scale = 1.0;          ///< mm of the tool for a mm of the hand, in [0.01, 10]
  double forceGain = 1.0;      ///< of force and torque on the hand, in [0, 100]: see PoseMapping
  double thrust = 1.0;         ///< N, constant-thrust mode, in [0, 20]
  double approachSpeed = 50.0; ///< mm/s before contact, in (0, 1000]
  /// Way from the given place to the nearest surface, patient mm: where a tool that touches nothing
  /// is sent, and how far beyond its place at most; zero: it waits there. For a pointer's tool its
  /// line of sight: not pressed of any length, nor where a wheel leads it (maxLead) as it is taken
  /// up; pressed as long as the way is.
  double approach[3] = {0.0, 0.0, 0.0};
  std::uint32_t clutchButtons = 0; ///< device buttons that hold the tool still
  std::uint32_t drillButtons = 0;  ///< device buttons that drill, as the pedal does
  std::uint8_t clutch = 0;         ///< 1: held by other means, e.g. a key
  std::uint8_t drill = 0;          ///< 1: on by other means
  std::uint8_t constantThrust = 0; ///< of kPressed and kPointer
  std::uint8_t pause = 0;          ///< 1: no force, no drilling
  /// mm that the place of a hand without force goes beyond a tool that tissue holds, in [0, 50];
  /// 0: no bound. What is more is forgotten, so that the hand comes back at once; a turn is held
  /// to `kMaxTurn`.
  float maxLead = 0.0F;

  static constexpr double kMaxTurn = 0.35; ///< rad

  /// The hand gives place and heading only; the tool is pressed there with `thrust`.
  static constexpr std::uint8_t kPressed = 1;
  /// A pointer's tool: not pressed it goes to its place without pressing (Traverse), and one that
  /// is too far from there is placed anew (Servo).
  static constexpr std::uint8_t kPointer = 2;

  /// In all the ranges above.
  bool valid() const noexcept;
};

static_assert(std::is_trivially_copyable_v<ServoParameters> && sizeof(ServoParameters) == 104);

/// Throws InvalidParameter naming the first value out of its range.
void check(const ServoParameters& parameters);

/// Sets `camera` from where the picture is taken.
/// Throws InvalidParameter when the camera looks nowhere or along its own up.
void setCamera(ServoParameters& parameters, const core::CameraPose& camera);

} // namespace petrous::simulation
