#pragma once

#include <cstddef>
#include <deque>
#include <random>

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

/// A handle in a light grip, 0.1 kg, 3 N s/m and 0.3 N/mm of which are the hand's.
struct KnownHandle
{
  RealDevice real;
  double described; ///< N/mm, by its server; for mass and damper alone the usual coupling
};

/// Friction and resolution of the Touch are those of its data sheet, as its mass of 45 g; forces
/// and stiffness are those of the servers. All others are assumed: vendors state a resolution at
/// most.
constexpr KnownHandle kHandles[] = {
    {{"mass and damper alone", 0.15, 0.003, 0.0, 0, 0.0, 0, 10.0}, 1.0},
    {{"Touch", 0.145, 0.003, 0.26, 0, 0.055, 0, 3.3}, 0.4},
    {{"Inverse3", 0.2, 0.004, 0.05, 0, 0.01, 0, 5.0}, 1.0},
    {{"Falcon", 0.3, 0.005, 0.3, 0, 0.06, 0, 8.0}, 3.0},
    {{"omega", 0.3, 0.006, 0.1, 0, 0.01, 0, 12.0}, 5.0},
    {{"sigma", 0.4, 0.008, 0.15, 0, 0.005, 0, 20.0}, 4.0},
    {{"lambda", 0.35, 0.006, 0.15, 0, 0.005, 0, 10.0}, 2.0}};

/// Which ticks the servo misses on such a device; at random, but the same ones each time.
class MissedTicks
{
public:
  explicit MissedTicks(const RealDevice& real);

  /// Of each tick once, in order.
  bool operator()(int tick);

private:
  int m_every;
  double m_share; ///< of the ticks at which a burst begins
  int m_burst;
  int m_left = 0;
  std::mt19937 m_random{1};
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
  double changed = 0.0;   ///< N, most that the guard changed the force by

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
