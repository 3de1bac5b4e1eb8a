#pragma once

#include "petrous/Devices/SpaceMouseReport.h"
#include "petrous/Haptics/Pose.h"

namespace petrous::devices
{

/// Rate control: turns a deflection into a velocity, integrated to a pose at the servo rate.
///
///   r(u) = s ((|u| - d) / (1 - d))^e  along u / |u|,  0 for |u| <= d
///
/// u     deflection, -1 to 1 per axis; translation and rotation separately, |u| limited to 1
/// s     `speed` or `turnRate`
/// d, e  dead zone, exponent (finer control at small deflections); our choice
///
/// Reports arrive every 8 to 16 ms. On each, the velocity ramps linearly from its present to the
/// new value over the interval between reports, so it is continuous and the motion lags by that
/// interval. Without a report for `timeout` while deflected the velocity ramps to 0.
///
/// Only the constructor allocates or throws.
class RateControl
{
public:
  struct Parameters
  {
    double speed = 40.0;    ///< mm/s at full deflection, in [0, 1000]
    double turnRate = 1.5;  ///< rad/s at full deflection, in [0, 20]
    double deadZone = 0.05; ///< fraction of full deflection, in [0, 0.9]
    double exponent = 1.5;  ///< in [1, 4]
    double timeout = 0.1;   ///< s, in [0.02, 10]
    double reach = 150.0;   ///< mm, the position stays within +-reach on each axis, in [1, 1e6]
  };

  /// Throws InvalidParameter naming the first value out of range.
  explicit RateControl(const Parameters& parameters);

  /// Call for each report; `now` in s, non-decreasing.
  void setDeflection(const SpaceMouseState& state, double now) noexcept;

  /// Stops at once and keeps the pose: the device is gone.
  void stop() noexcept;

  /// Integrates up to `now`, s; a step is limited to 0 to 0.1 s.
  const haptics::Pose& advance(double now) noexcept;

  /// Deflected, but without a report for longer than the timeout.
  bool silent(double now) const noexcept;

  /// mm/s and rad/s in frame D, at the last `advance`.
  const haptics::Motion& rate() const noexcept { return m_rate; }

private:
  haptics::Motion rateOf(const SpaceMouseState& state) const noexcept;
  haptics::Motion rateAt(double now) const noexcept;
  void rampTo(const haptics::Motion& rate, double now, double duration) noexcept;

  Parameters m_parameters;
  haptics::Pose m_pose;
  haptics::Motion m_rate;
  haptics::Motion m_from; // of the ramp
  haptics::Motion m_to;
  double m_rampStart = 0.0;
  double m_rampTime = 0.0;
  double m_reportTime = -1e9;
  double m_interval = 0.0; // s between the last two reports, clamped to the ramp's limits
  double m_now = -1e9;
  bool m_deflected = false;
};

} // namespace petrous::devices
