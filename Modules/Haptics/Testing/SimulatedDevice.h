#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>

#include "petrous/Haptics/Device.h"

namespace petrous::haptics
{

/// A device without hardware: its handle is a rigid body held by a hand that follows target(t).
///
///   m dv/dt     = F + k (x_t - x) + b (v_t - v) - f v/|v|
///   I domega/dt = tau + k_a log(q_t q*) + b_a (omega_t - omega)
///
/// F, tau          the last wrench sent, constant between two calls (zero-order hold)
/// x_t, q_t        target, with hand tremor on x_t; v_t, omega_t its change over a sub-step
/// f               Coulomb friction of the joints
/// m, I            kg, kg mm^2 (the same about every axis); 1 N = 1 kg 1000 mm/s^2
///
/// `read(now)` integrates up to `now` in equal sub-steps: the spring acts on the old position, the
/// damper on the resulting velocity (implicit), and then the body moves with that velocity. First
/// order in the sub-step; stable for sub-steps below 2 sqrt(m / (1000 k)), for any b. Starts at
/// rest at the target at the time of its first reading. Nothing moves if time stands still or runs
/// backward; a step of more than 1 s counts as 1 s.
///
/// Not thread-safe. `target` is called within read: it must not throw, nor allocate where that
/// matters.
class SimulatedDevice : public Device
{
public:
  using Target = std::function<Pose(double)>; ///< X_DT over time in seconds

  struct Hand
  {
    double mass = 0.15;              ///< kg, handle and hand, > 0
    double inertia = 100.0;          ///< kg mm^2, > 0
    double stiffness = 0.3;          ///< N/mm, >= 0
    double damping = 0.003;          ///< N s/mm, >= 0
    double friction = 0.0;           ///< N, >= 0
    double angularStiffness = 500.0; ///< N mm/rad, >= 0
    double angularDamping = 5.0;     ///< N mm s/rad, >= 0
    double tremor = 0.0;             ///< mm, RMS along each axis, 8 to 12 Hz; >= 0
    std::uint32_t seed = 1;          ///< of the tremor's frequencies and phases
    double subStep = 1e-4;           ///< s, maximum, in [1e-6, 1e-2]
  };

  /// When the device misbehaves, s on the servo's clock; infinity: never.
  struct Faults
  {
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    double nanFrom = kNever;              ///< positions are NaN from then on
    double jumpFrom = kNever;             ///< positions are off by `jump` from then on
    Eigen::Vector3d jump{50.0, 0.0, 0.0}; ///< mm
    double repeatFrom = kNever;           ///< the time stands still from then on; the pose
                                          ///< continues
    double backwardFrom = kNever;         ///< the time runs backward from then on
    double stallFrom = kNever;            ///< repeats the same reading for `stallFor`, then resumes
    double stallFor = 0.2;                ///< s
    double unplugAt = kNever;             ///< disconnected from then on; wrenches have no effect
  };

  /// A device with force feedback: 1 N/mm, 10 N, 500 N mm.
  static DeviceDescription usualDescription();

  /// Throws InvalidParameter naming the first invalid value.
  SimulatedDevice(Target target, const Hand& hand, const Faults& faults,
                  DeviceDescription description = usualDescription());
  explicit SimulatedDevice(Target target);

  const DeviceDescription& description() const noexcept override { return m_description; }
  DeviceReading read(double now) noexcept override;

  /// Not limited to the description's maxima: limits are tested externally. Zero if not finite.
  void send(const Wrench& wrench) noexcept override;

  /// Set for all subsequent readings.
  void press(std::uint32_t buttons, double pedal) noexcept;

  // Ground truth, independent of the readings.
  const Pose& pose() const noexcept { return m_pose; }
  const Motion& velocity() const noexcept { return m_velocity; } ///< mm/s, rad/s
  const Wrench& sent() const noexcept { return m_wrench; }

private:
  struct Wave
  {
    double rate = 0.0; ///< rad/s
    double phase = 0.0;
  };
  static constexpr std::size_t kWaves = 8; ///< along each axis

  Pose wantedAt(double time) const noexcept;
  void advance(double from, double to) noexcept;

  Target m_target;
  Hand m_hand;
  Faults m_faults;
  DeviceDescription m_description;
  std::array<std::array<Wave, kWaves>, 3> m_tremor;
  Pose m_pose;
  Pose m_wanted;
  Motion m_velocity;
  Wrench m_wrench;
  double m_time = 0.0;
  bool m_started = false;
  std::uint32_t m_buttons = 0;
  double m_pedal = 0.0;
  DeviceReading m_last; ///< repeated during a stall
};

} // namespace petrous::haptics
