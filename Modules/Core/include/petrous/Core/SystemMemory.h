#pragma once

#include <cstdint>

namespace petrous::core
{

/// Bytes of the machine's memory, and of those that programs can still get without swapping: also
/// within the limit of the control group, if there is one (cgroup v2). 0: not known.
struct SystemMemory
{
  std::uint64_t total = 0;
  std::uint64_t available = 0;
};
SystemMemory systemMemory();

} // namespace petrous::core
