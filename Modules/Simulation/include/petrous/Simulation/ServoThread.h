#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Haptics/Device.h"
#include "petrous/Simulation/Servo.h"
#include "petrous/Simulation/SpscRing.h"

namespace petrous::simulation
{

/// Runs a servo at 1 kHz from construction to stop(), at real-time priority (SCHED_FIFO) where the
/// system grants it. Its clock is CLOCK_MONOTONIC in seconds (std::chrono::steady_clock), for
/// devices that time their readings themselves.
///
/// Ticks fall on a grid of the period. A tick that comes after the next one was due is late; the
/// ones that were missed are left out, not made up for, so that a machine that slept takes up the
/// work with one tick (see ServoSetup::stallAfter).
class ServoThread
{
public:
  struct State
  {
    bool running = false;
    bool realTime = false; ///< the system granted real-time priority
    std::uint64_t ticks = 0;
    std::uint64_t late = 0;      ///< ticks that began after the next one was due
    double worstWall = 0.0;      ///< s, longest tick, device included
    double worstProcessor = 0.0; ///< s of the thread's processor time, longest tick
    std::uint64_t dropped = 0;   ///< records that found the ring full
    long majorFaults = 0;        ///< page faults that waited for the disk
  };

  /// servo, device, records  must outlive this; used by the thread alone until stop()
  /// period                  s, in [1e-4, 0.1]
  /// Throws InvalidParameter, or std::system_error when there is no thread to be had.
  ServoThread(Servo& servo, haptics::Device& device, SpscRing<TickRecord>& records,
              const ServoParameters& parameters, double period = 0.001);
  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;
  ~ServoThread();

  /// For the ticks to come; from one thread at a time. Throws InvalidParameter.
  void setParameters(const ServoParameters& parameters);

  /// The record of the last tick; false before the first.
  bool latest(TickRecord& record) const noexcept;

  State state() const noexcept;

  /// Lets the force fall to zero, then ends the thread: some 20 ticks. Again is as once.
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
  std::atomic<long> m_majorFaults{0};
  std::atomic<double> m_worstWall{0.0};
  std::atomic<double> m_worstProcessor{0.0};
  std::thread m_thread; // last: it uses all the others
};

} // namespace petrous::simulation
