#pragma once

#include <chrono>
#include <thread>

namespace petrous::devices::testing
{

/// Whether `condition` becomes true within `seconds`; polls once per millisecond. The limit only
/// ends a failing test, and is far above what a busy machine needs.
template <typename Condition>
bool eventually(Condition condition, double seconds = 20.0)
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

/// s since the clock's epoch, as on the servo's clock.
inline double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace petrous::devices::testing
