#pragma once

#include "petrous/Devices/SpaceMouseReport.h"
#include "petrous/Haptics/Pose.h"

namespace petrous::devices
{

/// A deflection that is a speed, turned into a pose at the servo's rate.
///
///   r(u) = s gain ((|u| - d) / (1 - d))^e  along u / |u|,  0 for |u| <= d
///
/// u     deflection, -1 to 1 an axis; translation and rotation each for itself, |u| cut to 1
/// d, e  dead zone, exponent (more feel for small deflections); our choice
///
/// Reports come every 8 to 16 ms. From each the speed goes in a straight line from what it is to
/// the new one within the time between reports, so the speed has no step and the motion is behind
/// by that time. Without a report for `timeout` while deflected the speed goes to 0.
///
/// Allocates nothing and never throws, except for the constructor.
class RateControl
{
public:
  struct Parameters
  {
    double speed = 40.0;    ///< mm/s at full deflection, >= 0
    double turnRate = 1.5;  ///< rad/s at full deflection, >= 0
    double deadZone = 0.05; ///< share of full deflection, in [0, 0.9]
    double exponent = 1.5;  ///< in [1, 4]
    double timeout = 0.1;   ///< s, in [0.02, 10]
    double reach = 150.0;   ///< mm, the position stays within +-reach on each axis, in [1, 1e6]
  };

  /// Throws InvalidParameter naming the first value out of its domain.
  explicit RateControl(const Parameters& parameters);

  /// A report came; `now` in s. Later reports must not be earlier.
  void setDeflection(const SpaceMouseState& state, double now) noexcept;

  /// No speed at once, the pose stays: the device has gone.
  void stop() noexcept;

  /// Moves on to `now`, s; a step back or beyond 0.1 s moves by nothing or 0.1 s.
  const haptics::Pose& advance(double now) noexcept;

  /// Deflected, but no report for longer than the timeout.
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
  haptics::Motion m_from; // the ramp
  haptics::Motion m_to;
  double m_rampStart = 0.0;
  double m_rampTime = 0.0;
  double m_reportTime = -1e9;
  double m_interval = 0.0; // s between the last two reports, within the ramp's limits
  double m_now = -1e9;
  bool m_deflected = false;
};

} // namespace petrous::devices
