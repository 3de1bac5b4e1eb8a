#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Core/TickHistogram.h"
#include "petrous/Haptics/Device.h"
#include "petrous/Session/Servo.h"
#include "petrous/Session/SpscRing.h"

namespace petrous::session
{

/// Runs a servo at 1 kHz from construction to stop(), at real-time priority (SCHED_FIFO) if
/// permitted. Its clock is CLOCK_MONOTONIC in seconds (std::chrono::steady_clock), for devices that
/// time-stamp their readings.
///
/// Ticks are on a grid of the period. A tick that starts after the next one was due is late; missed
/// ticks are skipped, not made up for, so that a suspended machine resumes with one tick (see
/// ServoSetup::stallAfter).
class ServoThread
{
public:
  struct State
  {
    bool running = false;
    bool realTime = false; ///< real-time priority was granted
    std::uint64_t ticks = 0;
    std::uint64_t late = 0;      ///< ticks that started after the next one was due
    double worstWall = 0.0;      ///< s, longest tick, including the device
    double worstProcessor = 0.0; ///< s of the thread's CPU time, longest tick
    std::uint64_t dropped = 0;   ///< records lost because the ring was full
    std::uint64_t postponed = 0; ///< ticks that left motion of the tool to the following ones
    double worstPostponed = 0.0; ///< mm, the most that a tick left (haptics::ProxyTick::postponed)
    long majorFaults = 0;        ///< page faults that required I/O
  };

  /// servo, device, records  must outlive this; used by the thread only, until stop()
  /// period                  s, in [1e-4, 0.1]
  /// Throws InvalidParameter, or std::system_error if the thread cannot be started.
  ServoThread(Servo& servo, haptics::Device& device, SpscRing<TickRecord>& records,
              const ServoParameters& parameters, double period = 0.001);
  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;
  ~ServoThread();

  /// For subsequent ticks; from one thread at a time. Throws InvalidParameter.
  void setParameters(const ServoParameters& parameters);

  /// The record of the last tick; false before the first.
  bool latest(TickRecord& record) const noexcept;

  State state() const noexcept;

  /// Wall times of the ticks, including the device, and how long after they were due they started.
  const core::TickHistogram& wallTimes() const noexcept { return m_wall; }
  const core::TickHistogram& lateness() const noexcept { return m_lateness; }

  /// Lets the force fall to zero, then ends the thread, within about 20 ticks. Idempotent.
  void stop();

private:
  void run() noexcept;
  void tickOnce(const ServoParameters& parameters) noexcept;

  Servo& m_servo;
  haptics::Device& m_device;
  SpscRing<TickRecord>& m_records;
  const double m_period;
  core::SnapshotBuffer<ServoParameters> m_parameters;
  core::SnapshotBuffer<TickRecord> m_latest;
  std::atomic<bool> m_stop{false};
  std::atomic<bool> m_running{true};
  std::atomic<bool> m_realTime{false};
  std::atomic<std::uint64_t> m_ticks{0};
  std::atomic<std::uint64_t> m_late{0};
  std::atomic<std::uint64_t> m_postponed{0};
  std::atomic<long> m_majorFaults{0};
  core::TickHistogram m_wall;
  core::TickHistogram m_lateness;
  std::atomic<double> m_worstProcessor{0.0};
  std::atomic<double> m_worstPostponed{0.0};
  std::thread m_thread; // last: uses all other members
};

} // namespace petrous::session
