#pragma once

#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// Stands between the computed wrench and the motors. In this order:
///
///   finite?     a wrench with NaN or infinity gives zero at once, and the fade starts anew
///   saturation  |F| <= maxForce and |tau| <= maxTorque, directions kept
///   fade        times a share that rises from 0 to 1 over `fadeIn` after resume()
///   slew        |F - F_before| <= forceSlew dt, the torque alike
///
/// It begins stopped: resume() lets force in. After fault() what is wanted is ignored, and the last
/// output falls in a straight line to zero over `fadeOut`, slew limit or not; it stays zero until
/// resume(). A wrench within all limits passes unchanged to the last bit.
///
/// The clock. dt is the time since the last call, but at most `longestStep`, so that a servo that
/// stalled does not catch up in one leap. Where the clock stands, runs back or is no number (and at
/// the first call), the output may shrink with the wanted one but neither grows nor turns, the fade
/// waits, and the fall after fault() goes on by 1 ms a call, so that no clock can hold a force.
///
/// One thread. Nothing here but the constructor throws; nothing allocates.
class ForceLimits
{
public:
  struct Limits
  {
    double maxForce = 3.3;     ///< N, >= 0; of the device
    double maxTorque = 0.0;    ///< N mm, >= 0; 0 where the device gives none
    double forceSlew = 5000.0; ///< N/s, > 0
    double torqueSlew = 2e5;   ///< N mm/s, > 0
    double fadeIn = 0.1;       ///< s, > 0
    double fadeOut = 0.02;     ///< s, > 0
    double maxStep = 0.01; ///< s, > 0
  };

  /// What the last call did.
  struct Notes
  {
    bool notFinite = false; ///< the wanted wrench was none
    bool saturated = false; ///< force or torque was above its maximum
    bool slewed = false;    ///< force or torque wanted to change faster than it may
  };

  /// Throws InvalidParameter naming the first bad limit.
  explicit ForceLimits(const Limits& limits);

  /// now  s, the servo's clock
  Wrench apply(const Wrench& wanted, double now) noexcept;

  /// From the next call on the output falls to zero. Again and again is as once.
  void fault() noexcept;

  /// Lets force in, the fade from 0, also when it was in already; what is put out stays
  /// continuous.
  void resume() noexcept;

  bool stopped() const noexcept { return m_stopped; } ///< after fault(), before resume()
  double fade() const noexcept { return m_fade; }     ///< share in [0, 1]
  const Notes& notes() const noexcept { return m_notes; }

private:
  double elapsed(double now) noexcept;

  Limits m_limits;
  Notes m_notes;
  Wrench m_last; ///< put out by the last call
  Wrench m_held; ///< put out when the fault came
  double m_time = 0.0;
  bool m_hasTime = false;
  bool m_stopped = true;
  double m_fade = 0.0; ///< while stopped: share of m_held
};

} // namespace petrous::haptics
