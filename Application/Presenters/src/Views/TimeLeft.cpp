#include "petrous/Presenters/TimeLeft.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace petrous::presenters
{

namespace
{

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;

double stepOf(double seconds)
{
  return seconds < 20.0      ? 5.0
         : seconds < kMinute ? 10.0
         : seconds < kHour   ? kMinute
                             : 10.0 * kMinute;
}

double rounded(double seconds)
{
  const double step = stepOf(seconds);
  return std::max(step, step * std::round(seconds / step));
}

} // namespace

void TimeLeft::restart()
{
  *this = {};
}

void TimeLeft::report(double fraction, double now)
{
  constexpr double kKept = 400.0; // reports of the time so far
  if (!m_reports.empty() && fraction < m_reports.back().fraction - kBack)
    restart();
  if (m_reports.empty())
    m_first = {now, fraction};
  else if (fraction <= m_reports.back().fraction)
    return;
  const std::size_t count = m_reports.size();
  const double elapsed = now - m_first.time;
  if (count >= 2 && m_reports[count - 1].time - m_reports[count - 2].time < elapsed / kKept)
    m_reports.back() = {now, fraction};
  else
    m_reports.push_back({now, fraction});
  const double begin = now - std::max(kWindow, 0.5 * elapsed);
  const auto inside = std::find_if(m_reports.begin(), m_reports.end(),
                                   [begin](const Report& one) { return one.time > begin; });
  if (inside - m_reports.begin() > 1)
    m_reports.erase(m_reports.begin(), inside - 1);
}

std::optional<double> TimeLeft::estimate(double now) const
{
  if (m_reports.empty())
    return std::nullopt;
  const Report& last = m_reports.back();
  const double elapsed = last.time - m_first.time;
  if (elapsed < kMinElapsed || last.fraction - m_first.fraction < kMinFraction ||
      last.fraction >= 1.0)
    return std::nullopt;
  // What was done at the window's beginning, interpolated.
  const double begin = last.time - std::min(elapsed, std::max(kWindow, 0.5 * elapsed));
  double done = m_reports.front().fraction;
  double pause = 0.0;
  for (std::size_t n = 1; n < m_reports.size(); ++n)
  {
    const Report& before = m_reports[n - 1];
    const Report& after = m_reports[n];
    if (before.time <= begin && begin < after.time)
      done = before.fraction + (after.fraction - before.fraction) * (begin - before.time) /
                                   (after.time - before.time);
    if (after.time > begin)
      pause = std::max(pause, after.time - before.time);
  }
  const double since = std::max(0.0, now - last.time);
  const double overdue = std::max(0.0, since - pause);
  const double speed = (last.fraction - done) / (last.time - begin + overdue);
  return std::max(0.0, (1.0 - last.fraction) / speed - std::min(since, pause));
}

std::optional<double> TimeLeft::shown(double now)
{
  const std::optional<double> left = estimate(now);
  if (!left || *left > kMax)
  {
    m_end.reset();
    m_shown.reset();
    return std::nullopt;
  }
  const double foreseen = now + *left;
  m_end = m_end ? foreseen + (*m_end - foreseen) * std::exp((m_last - now) / kSmoothing) : foreseen;
  m_last = now;
  const double smooth = std::max(0.0, *m_end - now);
  const bool isSame = m_shown && smooth > *m_shown && smooth <= *m_shown + 0.75 * stepOf(smooth);
  if (!isSame)
    m_shown = rounded(smooth);
  return m_shown;
}

double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string timeLeftText(const std::optional<double>& seconds)
{
  if (!seconds)
    return {};
  if (*seconds < kMinute)
    return "about " + std::to_string(std::lround(*seconds)) + " s left";
  const long minutes = std::lround(*seconds / kMinute);
  if (minutes < 60)
    return "about " + std::to_string(minutes) + " min left";
  return "about " + std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) +
         " min left";
}

} // namespace petrous::presenters
