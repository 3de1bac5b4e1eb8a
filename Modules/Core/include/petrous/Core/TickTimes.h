#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::core
{

/// Durations of ticks: CPU time of the thread, which is unaffected by other programs, and wall
/// time. All times in s. Not thread-safe.
class TickTimes
{
public:
  /// Calls the tick and returns its result.
  template <typename Call>
  decltype(auto) take(Call call)
  {
    const Stop stop{*this, std::chrono::steady_clock::now(), processorSeconds()};
    return call();
  }

  void add(const TickTimes& other)
  {
    m_processor.insert(m_processor.end(), other.m_processor.begin(), other.m_processor.end());
    m_wall.insert(m_wall.end(), other.m_wall.begin(), other.m_wall.end());
  }

  /// The `share` quantile (0 to 1) of the tick times; 0 without ticks.
  double processor(double share) const { return quantile(m_processor, share); }
  double wall(double share) const { return quantile(m_wall, share); }

  std::size_t count() const noexcept { return m_wall.size(); }
  double wallSum() const
  {
    double sum = 0.0;
    for (const float seconds : m_wall)
      sum += double{seconds};
    return sum;
  }

  void enter(BenchmarkPoint& point) const
  {
    point.seconds = processor(0.5);
    point.extra["ticks"] = static_cast<double>(m_processor.size());
    for (const auto& [part, share] : {std::make_pair("p50", 0.5), std::make_pair("p99", 0.99),
                                      std::make_pair("p99.9", 0.999), std::make_pair("max", 1.0)})
    {
      point.extra[std::string("processor_us_") + part] = 1e6 * processor(share);
      point.extra[std::string("wall_us_") + part] = 1e6 * wall(share);
    }
    const auto late = std::count_if(m_processor.begin(), m_processor.end(),
                                    [](float seconds) { return seconds > 1e-3F; });
    point.extra["ticks_over_1_ms"] = static_cast<double>(late);
  }

private:
  struct Stop
  {
    TickTimes& times;
    std::chrono::steady_clock::time_point wall;
    double processor;
    ~Stop()
    {
      times.m_processor.push_back(static_cast<float>(processorSeconds() - processor));
      const std::chrono::duration<float> passed = std::chrono::steady_clock::now() - wall;
      times.m_wall.push_back(passed.count());
    }
  };

  static double processorSeconds()
  {
    std::timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  static double quantile(std::vector<float> values, double share)
  {
    if (values.empty())
      return 0.0;
    const auto last = static_cast<double>(values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * last));
    std::nth_element(values.begin(), place, values.end());
    return double{*place};
  }

  std::vector<float> m_processor; // a session has millions of them
  std::vector<float> m_wall;
};

} // namespace petrous::core
