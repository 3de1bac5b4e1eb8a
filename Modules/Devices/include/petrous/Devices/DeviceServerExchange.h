#pragma once

/* How a pose or wrench gets in and out of the block of DeviceServerProtocol.h. Plain C, GCC or
 * clang; nothing here waits, locks or allocates. */

#include <math.h>
#include <string.h>

#include "petrous/Devices/DeviceServerProtocol.h"

#ifdef __cplusplus
extern "C"
{
#endif

  /* Puts a pose or wrench (PETROUS_DEVICE_WORDS words) in the block. One writer; never waits. */
  static inline void petrous_device_put(uint64_t* sequence, uint64_t* words, const void* value)
  {
    uint64_t copy[PETROUS_DEVICE_WORDS];
    /* `| 1`: a writer that died in the middle left it odd. */
    const uint64_t writing = __atomic_load_n(sequence, __ATOMIC_RELAXED) | 1u;
    unsigned i;
    memcpy(copy, value, sizeof copy);
    __atomic_store_n(sequence, writing, __ATOMIC_RELAXED);
    for (i = 0; i < PETROUS_DEVICE_WORDS; ++i)
      __atomic_store_n(&words[i], copy[i], __ATOMIC_RELEASE);
    __atomic_store_n(sequence, writing + 1, __ATOMIC_RELEASE);
  }

  /* Copies out the latest value and returns its sequence. 0, and `value` as it was, when nothing
   * has been written yet or the writer was in the middle of it each time; never waits. */
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

  /* Server: what it remembers of the wrenches; begins as all zero. */
  struct petrous_device_guard
  {
    int started;
    uint64_t sequence;
    int64_t fresh_ns;
    struct petrous_device_wrench wrench;
  };

  /* Server: the wrench for the motors now, already checked: zero, with tick 0, when Petrous has
   * sent none for PETROUS_DEVICE_SILENCE_NS or sent what is no number. Call it each time before the
   * motors are set; `now_ns` is CLOCK_MONOTONIC. */
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
      /* What lies there at the first look may be old: only a change shows that Petrous is sending.
       */
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

  /* Server: name or error text; too long a text is cut. */
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
