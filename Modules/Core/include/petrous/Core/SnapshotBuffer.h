#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace petrous::core
{

/// Lock-free single-writer, multiple-reader buffer of the latest complete value.
///
/// A ring of kSlots slots, each guarded by a sequence number: the writer fills the slot after the
/// newest one and then publishes it, so that a reader finds a complete value even during a write. A
/// reader retries only if the writer has lapped it around the whole ring, and gives up after kTries
/// attempts.
///
/// Writer and readers never block, allocate or throw.
///
/// T  trivially copyable; copied word by word, so it should be small
template <typename T>
class SnapshotBuffer
{
  static_assert(std::is_trivially_copyable_v<T>, "a snapshot is copied as bytes");

public:
  static constexpr std::size_t kSlots = 4;
  static constexpr int kTries = 8;

  explicit SnapshotBuffer(const T& initial = T{}) noexcept { write(initial); }

  SnapshotBuffer(const SnapshotBuffer&) = delete;
  SnapshotBuffer& operator=(const SnapshotBuffer&) = delete;

  /// From one thread at a time.
  void write(const T& value) noexcept
  {
    const std::uint64_t number = m_latest.load(std::memory_order_relaxed) + 1;
    Slot& slot = m_slots[number % kSlots];
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof(T));

    slot.sequence.store(2 * number - 1, std::memory_order_relaxed);
    // Each word is stored with release and loaded with acquire order: a reader that sees one word
    // of this write also sees the odd sequence number. (A fence would do the same, but
    // ThreadSanitizer does not support fences.)
    for (std::size_t i = 0; i < kWords; ++i)
      slot.words[i].store(words[i], std::memory_order_release);
    slot.sequence.store(2 * number, std::memory_order_release);
    m_latest.store(number, std::memory_order_release);
  }

  /// Copies the latest complete value. Returns false, with `value` unchanged, if the writer lapped
  /// this reader kTries times in a row, which requires a writer that never pauses.
  bool read(T& value) const noexcept
  {
    for (int i = 0; i < kTries; ++i)
      if (copy(m_latest.load(std::memory_order_acquire), value))
        return true;
    return false;
  }

  /// Number of values written, including the initial one.
  std::uint64_t count() const noexcept { return m_latest.load(std::memory_order_acquire); }

private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;

  // 64: one cache line, to avoid false sharing between neighbouring slots.
  struct alignas(64) Slot
  {
    std::atomic<std::uint64_t> sequence{0};
    std::array<std::atomic<std::uint64_t>, kWords> words{};
  };

  bool copy(std::uint64_t number, T& value) const noexcept
  {
    const Slot& slot = m_slots[number % kSlots];
    if (slot.sequence.load(std::memory_order_acquire) != 2 * number)
      return false;
    std::array<std::uint64_t, kWords> words;
    for (std::size_t i = 0; i < kWords; ++i)
      words[i] = slot.words[i].load(std::memory_order_acquire);
    if (slot.sequence.load(std::memory_order_relaxed) != 2 * number)
      return false;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return true;
  }

  std::array<Slot, kSlots> m_slots;
  alignas(64) std::atomic<std::uint64_t> m_latest{0};
};

} // namespace petrous::core
