#include "AllocationHook.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>

// The C library's own entry points: these definitions replace malloc in every library of the
// program, including for operator new.
extern "C"
{
  void* __libc_malloc(std::size_t);
  void* __libc_calloc(std::size_t, std::size_t);
  void* __libc_realloc(void*, std::size_t);
  void* __libc_memalign(std::size_t, std::size_t);
  void __libc_free(void*);
}

namespace
{

std::atomic<std::uint64_t> allocations{0};
std::atomic<std::uint64_t> releases{0};
thread_local std::uint64_t failing = 0; // counts down to the failing call; 0: none

bool fails() noexcept
{
  return failing > 0 && --failing == 0;
}

} // namespace

extern "C"
{
  void* malloc(std::size_t size)
  {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (fails())
      return nullptr;
    return __libc_malloc(size);
  }
  void* calloc(std::size_t count, std::size_t size)
  {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (fails())
      return nullptr;
    return __libc_calloc(count, size);
  }
  void* realloc(void* old, std::size_t size)
  {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (fails())
      return nullptr;
    return __libc_realloc(old, size);
  }
  void* memalign(std::size_t alignment, std::size_t size)
  {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (fails())
      return nullptr;
    return __libc_memalign(alignment, size);
  }
  void* aligned_alloc(std::size_t alignment, std::size_t size)
  {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (fails())
      return nullptr;
    return __libc_memalign(alignment, size);
  }
  int posix_memalign(void** result, std::size_t alignment, std::size_t size)
  {
    allocations.fetch_add(1, std::memory_order_relaxed);
    *result = fails() ? nullptr : __libc_memalign(alignment, size);
    return *result ? 0 : ENOMEM;
  }
  void free(void* memory)
  {
    if (memory)
      releases.fetch_add(1, std::memory_order_relaxed);
    __libc_free(memory);
  }
}

namespace petrous::session::testing
{

std::uint64_t allocationCount() noexcept
{
  return allocations.load(std::memory_order_relaxed) + releases.load(std::memory_order_relaxed);
}

void failAllocation(std::uint64_t n) noexcept
{
  failing = n;
}

} // namespace petrous::session::testing
