#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::haptics
{

/// What ticks took: of the thread's processor time, which other programs do not lengthen, and on
/// the wall.
class TickTimes
{
public:
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

  double median() const { return quantile(m_processor, 0.5); } ///< s, of processor time

  void enter(core::BenchmarkPoint& point) const
  {
    point.seconds = median();
    point.extra["ticks"] = static_cast<double>(m_processor.size());
    for (const auto& [name, times] :
         {std::make_pair("processor_us_", &m_processor), std::make_pair("wall_us_", &m_wall)})
      for (const auto& [part, share] : {std::make_pair("p50", 0.5), std::make_pair("p99", 0.99),
                                        std::make_pair("p99.9", 0.999), std::make_pair("max", 1.0)})
        point.extra[std::string(name) + part] = 1e6 * quantile(*times, share);
    const auto late = std::count_if(m_processor.begin(), m_processor.end(),
                                    [](double seconds) { return seconds > 1e-3; });
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
      times.m_processor.push_back(processorSeconds() - processor);
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall;
      times.m_wall.push_back(passed.count());
    }
  };

  static double processorSeconds()
  {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  static double quantile(std::vector<double> values, double share)
  {
    if (values.empty())
      return 0.0;
    const auto last = static_cast<double>(values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * last));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  }

  std::vector<double> m_processor; // s
  std::vector<double> m_wall;      // s
};

} // namespace petrous::haptics
