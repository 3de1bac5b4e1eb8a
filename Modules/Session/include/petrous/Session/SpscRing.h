#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>

#include "petrous/Core/Error.h"

namespace petrous::session
{

/// Bounded single-producer, single-consumer queue. Neither thread waits for the other: a push into
/// a full ring is counted and dropped, a pop from an empty one returns nothing. Does not allocate
/// after construction.
///
/// T  trivially copyable
template <typename T>
class SpscRing
{
  static_assert(std::is_trivially_copyable_v<T>, "an item is copied as bytes");

public:
  /// Holds at least `capacity` items (rounded up to a power of two). Throws InvalidParameter if it
  /// is 0 or above 2^24.
  explicit SpscRing(std::size_t capacity)
    : m_size(sizeFor(capacity))
    , m_items(new T[m_size])
  {
  }

  std::size_t capacity() const noexcept { return m_size; }

  /// Producer. Returns false and counts the drop if the ring is full.
  bool push(const T& item) noexcept
  {
    const std::uint64_t head = m_head.load(std::memory_order_relaxed);
    if (head - m_tailSeen == m_size)
    {
      m_tailSeen = m_tail.load(std::memory_order_acquire);
      if (head - m_tailSeen == m_size)
      {
        m_dropped.store(m_dropped.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    std::memcpy(static_cast<void*>(&m_items[head & (m_size - 1)]), &item, sizeof(T));
    m_head.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Consumer. Moves up to `count` items, oldest first, and returns their number.
  std::size_t pop(T* items, std::size_t count) noexcept
  {
    const std::uint64_t tail = m_tail.load(std::memory_order_relaxed);
    const std::uint64_t head = m_head.load(std::memory_order_acquire);
    const std::size_t n = std::min<std::size_t>(count, static_cast<std::size_t>(head - tail));
    for (std::size_t i = 0; i < n; ++i)
      std::memcpy(static_cast<void*>(items + i), &m_items[(tail + i) & (m_size - 1)], sizeof(T));
    m_tail.store(tail + n, std::memory_order_release);
    return n;
  }
  bool pop(T& item) noexcept { return pop(&item, 1) == 1; }

  /// Dropped pushes; from any thread.
  std::uint64_t dropped() const noexcept { return m_dropped.load(std::memory_order_relaxed); }

private:
  static std::size_t sizeFor(std::size_t capacity)
  {
    if (capacity == 0 || capacity > std::size_t{1} << 24)
      throw core::InvalidParameter("ring: the capacity must lie within 1 to 16777216");
    std::size_t size = 1;
    while (size < capacity)
      size *= 2;
    return size;
  }

  const std::size_t m_size;
  std::unique_ptr<T[]> m_items;
  // 64: a cache line each, to avoid false sharing.
  alignas(64) std::atomic<std::uint64_t> m_head{0}; // next to be written
  std::uint64_t m_tailSeen = 0;                     // the producer's copy of m_tail
  std::atomic<std::uint64_t> m_dropped{0};
  alignas(64) std::atomic<std::uint64_t> m_tail{0}; // next to be read
};

} // namespace petrous::session
