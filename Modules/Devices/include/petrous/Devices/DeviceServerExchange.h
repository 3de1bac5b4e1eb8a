#pragma once

/* Writing and reading poses and wrenches in the block of DeviceServerProtocol.h. Plain C, GCC or
 * clang; nothing here waits, locks or allocates. */

#include <math.h>
#include <string.h>

#include "petrous/Devices/DeviceServerProtocol.h"

#ifdef __cplusplus
extern "C"
{
#endif

  /* Writes a pose or wrench (PETROUS_DEVICE_WORDS words). Single writer; never waits. */
  static inline void petrous_device_put(uint64_t* sequence, uint64_t* words, const void* value)
  {
    uint64_t copy[PETROUS_DEVICE_WORDS];
    /* `| 1`: odd already if a previous writer died halfway. */
    const uint64_t writing = __atomic_load_n(sequence, __ATOMIC_RELAXED) | 1u;
    unsigned i;
    memcpy(copy, value, sizeof copy);
    __atomic_store_n(sequence, writing, __ATOMIC_RELAXED);
    for (i = 0; i < PETROUS_DEVICE_WORDS; ++i)
      __atomic_store_n(&words[i], copy[i], __ATOMIC_RELEASE);
    __atomic_store_n(sequence, writing + 1, __ATOMIC_RELEASE);
  }

  /* Copies out the latest value and returns its sequence number. Returns 0 and leaves `value`
   * unchanged if nothing has been written yet or each of 8 attempts met a write; never waits. */
  static inline uint64_t petrous_device_get(const uint64_t* sequence, const uint64_t* words,
                                            void* value)
  {
    uint64_t copy[PETROUS_DEVICE_WORDS];
    int attempt;
    unsigned i;
    for (attempt = 0; attempt < 8; ++attempt)
    {
      const uint64_t before = __atomic_load_n(sequence, __ATOMIC_ACQUIRE);
      if (before % 2 != 0 || before == 0)
        continue;
      for (i = 0; i < PETROUS_DEVICE_WORDS; ++i)
        copy[i] = __atomic_load_n(&words[i], __ATOMIC_ACQUIRE);
      if (__atomic_load_n(sequence, __ATOMIC_RELAXED) != before)
        continue;
      memcpy(value, copy, sizeof copy);
      return before;
    }
    return 0;
  }

  /* Server: state of the wrench check; initialise to all zero. */
  struct petrous_device_guard
  {
    int started;
    uint64_t sequence;
    int64_t fresh_ns;
    struct petrous_device_wrench wrench;
  };

  /* Server: the checked wrench for the motors: zero, with tick 0, if Petrous has sent none for
   * PETROUS_DEVICE_SILENCE_NS or one that is not finite. Call before each update of the motors;
   * `now_ns` is CLOCK_MONOTONIC. */
  static inline struct petrous_device_wrench
  petrous_device_wrench_now(const struct petrous_device_block* block,
                            struct petrous_device_guard* guard, int64_t now_ns)
  {
    struct petrous_device_wrench zero;
    const uint64_t sequence =
        petrous_device_get(&block->wrench_sequence, block->wrench, &guard->wrench);
    int i;
    memset(&zero, 0, sizeof zero);
    if (!guard->started)
    {
      /* The first value may be old: only a change shows that Petrous is sending. */
      guard->started = 1;
      guard->sequence = sequence;
      guard->fresh_ns = now_ns - PETROUS_DEVICE_SILENCE_NS - 1;
    }
    else if (sequence != 0 && sequence != guard->sequence)
    {
      guard->sequence = sequence;
      guard->fresh_ns = now_ns;
    }
    if (now_ns - guard->fresh_ns > PETROUS_DEVICE_SILENCE_NS)
      return zero;
    for (i = 0; i < 3; ++i)
      if (!isfinite(guard->wrench.force[i]) || !isfinite(guard->wrench.torque[i]))
        return zero;
    return guard->wrench;
  }

  /* Server: sets name or error text, truncated if too long. */
  static inline void petrous_device_text(char* field, size_t size, const char* text)
  {
    const size_t length = strlen(text);
    size_t i;
    for (i = 0; i < size; ++i)
      __atomic_store_n(&field[i], i < length && i + 1 < size ? text[i] : '\0', __ATOMIC_RELAXED);
  }

#ifdef __cplusplus
}
#endif
