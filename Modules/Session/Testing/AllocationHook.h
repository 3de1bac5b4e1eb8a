#pragma once

#include <atomic>
#include <cstdint>

namespace petrous::session::testing
{

/// Number of calls of malloc, free and related functions, from all threads and libraries of the
/// program.
std::uint64_t allocationCount() noexcept;

/// Makes the calling thread's n-th allocation from now on fail, once; 0: none.
void failAllocation(std::uint64_t n) noexcept;

} // namespace petrous::session::testing
