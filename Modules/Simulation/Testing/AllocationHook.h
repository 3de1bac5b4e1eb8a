#pragma once

#include <atomic>
#include <cstdint>

namespace petrous::simulation::testing
{

/// Calls of malloc, free and their kin so far, from all threads and libraries of the program.
std::uint64_t allocationCount() noexcept;

/// From now on the calling thread gets no memory by its n-th call, once; 0: it gets all.
void failAllocation(std::uint64_t n) noexcept;

} // namespace petrous::simulation::testing
