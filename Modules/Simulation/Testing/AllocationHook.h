#pragma once

#include <atomic>
#include <cstdint>

namespace petrous::simulation::testing
{

/// Calls of malloc, free and their kin so far, from all threads and libraries of the program.
std::uint64_t allocationCount() noexcept;

} // namespace petrous::simulation::testing
