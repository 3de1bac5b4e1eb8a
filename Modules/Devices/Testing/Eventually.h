#pragma once

#include <chrono>

#include "../../Core/Testing/Eventually.h"

namespace petrous::devices::testing
{

using core::testing::eventually;

/// s since the clock's epoch, as on the servo's clock.
inline double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace petrous::devices::testing
