#pragma once

#include <optional>
#include <string>
#include <vector>

namespace petrous::presenters
{

/// The time that a task needs from now on, from its progress.
///
/// Extrapolates the speed of the later half of the task so far, at least of kWindow. Between two
/// reports the time counts down, for as long as the longest pause before; after that it grows. The
/// end that is foreseen is smoothed over kSmoothing. Clock times are in s, from any origin, and do
/// not decrease. Not thread-safe.
class TimeLeft
{
public:
  static constexpr double kMinElapsed = 3.0;   ///< s from the first report to the last one
  static constexpr double kMinFraction = 0.03; ///< that was done in it
  static constexpr double kWindow = 10.0;      ///< s
  static constexpr double kSmoothing = 4.0;    ///< s, time constant
  static constexpr double kMax = 86400.0;      ///< s; more is not told

  void restart(); ///< another task

  /// `fraction` in [0, 1]. One that is kBack less than before begins another task; otherwise what
  /// is less or the same is ignored.
  void report(double fraction, double now);
  static constexpr double kBack = 0.02;

  /// s, a multiple of 5 s, from 20 s of 10 s, from 60 s of 60 s and from 1 h of 10 min, and greater
  /// than before only where the estimate is so by three quarters of such a step; nullopt: not known
  /// yet, more than kMax, or all is done. Call with each report, and now and then between them.
  std::optional<double> shown(double now);

private:
  struct Report
  {
    double time = 0.0;
    double fraction = 0.0;
  };
  std::optional<double> estimate(double now) const;

  std::vector<Report> m_reports; ///< at first the last one before the window
  Report m_first;
  std::optional<double> m_end; ///< smoothed
  std::optional<double> m_shown;
  double m_last = 0.0; ///< time of the last estimate
};

/// s of std::chrono::steady_clock, for `now`.
double steadySeconds();

/// "about 20 s left", "about 2 min left", "about 1 h 10 min left" for what `shown` returns; empty
/// for none.
std::string timeLeftText(const std::optional<double>& seconds);

} // namespace petrous::presenters
