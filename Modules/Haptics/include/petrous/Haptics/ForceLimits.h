#pragma once

#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// Limits between the computed wrench and the motors. Applied in this order:
///
///   finite?     NaN or infinity yields zero at once and restarts the fade
///   saturation  |F| <= maxForce and |tau| <= maxTorque, directions kept
///   fade        factor rising from 0 to 1 over `fadeIn` after resume()
///   slew        |F - F_before| <= forceSlew dt, likewise for the torque
///
/// Initially stopped: resume() enables force. After fault() the wanted wrench is ignored and the
/// last output falls linearly to zero over `fadeOut`, regardless of the slew limit; it stays zero
/// until resume(). A wrench within all limits passes bit-identical.
///
/// Clock: dt is the time since the last call, at most `maxStep`, so that a stalled servo does not
/// catch up in one step. If the clock stands still, runs backward or is not a number (and at the
/// first call), the output may shrink with the wanted wrench but neither grows nor turns, the fade
/// waits, and the fall after fault() advances by 1 ms per call, so that no clock can sustain a
/// force.
///
/// Not thread-safe. Only the constructor throws; nothing allocates.
class ForceLimits
{
public:
  struct Limits
  {
    double maxForce = 3.3;     ///< N, >= 0; of the device
    double maxTorque = 0.0;    ///< N mm, >= 0; 0 for a device without torque feedback
    double forceSlew = 5000.0; ///< N/s, > 0
    double torqueSlew = 2e5;   ///< N mm/s, > 0
    double fadeIn = 0.1;       ///< s, > 0
    double fadeOut = 0.02;     ///< s, > 0
    double maxStep = 0.01;     ///< s, > 0
  };

  /// Which limits the last call applied.
  struct Notes
  {
    bool notFinite = false; ///< the wanted wrench was not finite
    bool saturated = false; ///< force or torque was above its maximum
    bool slewed = false;    ///< force or torque changed faster than allowed
  };

  /// Throws InvalidParameter naming the first invalid limit.
  explicit ForceLimits(const Limits& limits);

  /// now  s, the servo's clock
  Wrench apply(const Wrench& wanted, double now) noexcept;

  /// The output falls to zero from the next call on. Idempotent.
  void fault() noexcept;

  /// Enables force, fading in from 0, also if already enabled; the output stays continuous.
  void resume() noexcept;

  bool stopped() const noexcept { return m_stopped; } ///< after fault(), before resume()
  double fade() const noexcept { return m_fade; }     ///< factor in [0, 1]
  const Notes& notes() const noexcept { return m_notes; }

private:
  double elapsed(double now) noexcept;

  Limits m_limits;
  Notes m_notes;
  Wrench m_last; ///< output of the last call
  Wrench m_held; ///< output when the fault occurred
  double m_time = 0.0;
  bool m_hasTime = false;
  bool m_stopped = true;
  double m_fade = 0.0; ///< while stopped: fraction of m_held
};

} // namespace petrous::haptics
