#pragma once

#include <chrono>
#include <thread>

namespace petrous::core::testing
{

/// Whether `condition` becomes true within `seconds`; polls once per millisecond. The limit only
/// ends a failing test, and is far above what a busy machine needs, under a sanitizer, too.
template <typename Condition>
bool eventually(Condition condition, double seconds = 60.0)
{
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end)
  {
    if (condition())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return condition();
}

} // namespace petrous::core::testing
