#pragma once

#include <cstddef>
#include <deque>

#include "SimulatedDevice.h"

namespace petrous::haptics
{

/// A device as it is between the program and the motors, in a hand.
struct RealDevice
{
  const char* name = "";
  double mass = 0.15;     ///< kg, handle and hand
  double damping = 0.003; ///< N s/mm, handle and hand
  double friction = 0.0;  ///< N
  int delay = 0;          ///< ticks until a wrench acts
  double quantum = 0.0;   ///< mm, of the encoders
  int dropEvery = 0;      ///< ticks: every so many the servo misses one; 0: none
  double maxForce = 10.0; ///< N
  double missed = 0.0;    ///< share of the ticks that the servo misses at random, in [0, 1)
  int burst = 1;          ///< ticks that it misses at a time, of those
};

/// What the program sees of such a device: positions on the encoders' grid, and wrenches that act
/// `delay` calls of `send` later. `pose`, `velocity` and `sent` are the truth at the handle. Missed
/// ticks are the caller's.
class TransmittedDevice : public SimulatedDevice
{
public:
  /// hand  stiffness, tremor and sub-step of it count; the others are the device's
  TransmittedDevice(const RealDevice& real, Target target, Hand hand = {});

  DeviceReading read(double now) noexcept override;
  void send(const Wrench& wrench) noexcept override;

private:
  const double m_quantum;
  std::deque<Wrench> m_underway;
};

/// How a hand presses on a wall: from 2 mm before it, in 0.2 s to 6 mm behind it (with a stiff wall
/// six times its own stiffness), where it rests, and back.
struct WallPress
{
  double stiffness = 1.0; ///< of the wall, N/mm
  bool guarded = true;    ///< with haptics::PassivityGuard, as in the servo
  double tremor = 0.0;    ///< mm, RMS
  double handStiffness = SimulatedDevice::Hand().stiffness;
  double rest = 1.0;     ///< s on the wall, >= 0.5
  double subStep = 1e-4; ///< s, of the simulated handle
  int times = 3;         ///< > 0
};

struct Touching
{
  double energyOut = 0.0; ///< N mm (mJ) that came out at the handle in the worst cycle: the motors'
                          ///< work less the friction of the joints
  double ripple = 0.0; ///< N, half of the force's range in 0.4 s of the hand's rest, 0.1 s before
                       ///< its end, in the worst cycle
  double mostForce = 0.0; ///< N

  static constexpr double kMostEnergy = 0.1;  ///< mJ
  static constexpr double kMostRipple = 0.05; ///< N
  bool stable() const noexcept { return energyOut <= kMostEnergy && ripple <= kMostRipple; }
};

/// Through coupling, guard and limits as in the servo, at 1 kHz.
Touching press(const RealDevice& real, const WallPress& how);

/// The stiffness, N/mm, up to which a passive wall may go on a device with this damping [Colgate
/// and Schenkel 1997: b > K T / 2 + |B|, here B = 0]; with a delay t_d b > K (T / 2 + t_d) [Hulin,
/// Albu-Schaeffer and Hirzinger 2014, doi 10.1109/TCST.2013.2283372].
double passiveStiffness(const RealDevice& real) noexcept;

/// Where a wall without the guard begins to ring for ever, N/mm, in [0.05, 100], by bisection;
/// `how` gives all but the wall's stiffness. The longer the hand rests, the less a decay that is
/// slow counts as ringing: for 12 s it is up to 3 % too low. The handle's sub-step makes it up to
/// 11 % too high without a delay, 4 % with one of 1 ms (the force comes half a sub-step early).
double ringingStiffness(const RealDevice& real, WallPress how);

} // namespace petrous::haptics
