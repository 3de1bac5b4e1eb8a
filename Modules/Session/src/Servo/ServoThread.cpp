#include "petrous/Session/ServoThread.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <pthread.h>
#include <sched.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/LockedMemory.h"

namespace petrous::session
{

namespace
{

// Above ordinary threads, below the kernel's own watchdogs and interrupt threads (50).
constexpr int kPriority = 40;
constexpr int kMaxTicksToStop = 200;

double secondsOf(clockid_t clock) noexcept
{
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void sleepUntil(double seconds) noexcept
{
  timespec until{};
  const double whole = std::floor(seconds);
  until.tv_sec = static_cast<time_t>(whole);
  until.tv_nsec = std::clamp(static_cast<long>(1e9 * (seconds - whole)), 0L, 999999999L);
  // A signal only makes this tick early; the next one is on the grid again.
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

void raise(std::atomic<double>& worst, double value) noexcept
{
  if (value > worst.load(std::memory_order_relaxed))
    worst.store(value, std::memory_order_relaxed);
}

const ServoParameters& checked(const ServoParameters& parameters)
{
  check(parameters);
  return parameters;
}

double checkedPeriod(double period)
{
  if (!(period >= 1e-4 && period <= 0.1))
    throw core::InvalidParameter("servo thread: the period must lie within 0.0001 to 0.1 s");
  return period;
}

bool atRest(const TickRecord& record) noexcept
{
  const haptics::Wrench output = record.output.wrench();
  return output.linear.isZero(0.0) && output.angular.isZero(0.0);
}

} // namespace

ServoThread::ServoThread(Servo& servo, haptics::Device& device, SpscRing<TickRecord>& records,
                         const ServoParameters& parameters, double period)
  : m_servo(servo)
  , m_device(device)
  , m_records(records)
  , m_period(checkedPeriod(period))
  , m_parameters(checked(parameters))
  , m_thread([this] { run(); })
{
}

ServoThread::~ServoThread()
{
  stop();
}

void ServoThread::stop()
{
  m_stop.store(true);
  if (m_thread.joinable())
    m_thread.join();
}

void ServoThread::setParameters(const ServoParameters& parameters)
{
  m_parameters.write(checked(parameters));
}

bool ServoThread::latest(TickRecord& record) const noexcept
{
  return m_latest.count() > 1 && m_latest.read(record); // 1: the initial value
}

ServoThread::State ServoThread::state() const noexcept
{
  State state;
  state.running = m_running.load();
  state.realTime = m_realTime.load();
  state.ticks = m_ticks.load();
  state.late = m_late.load();
  state.worstWall = m_wall.max();
  state.worstProcessor = m_worstProcessor.load();
  state.dropped = m_records.dropped();
  state.postponed = m_postponed.load();
  state.worstPostponed = m_worstPostponed.load();
  state.majorFaults = m_majorFaults.load();
  return state;
}

void ServoThread::tickOnce(const ServoParameters& parameters) noexcept
{
  const double start = secondsOf(CLOCK_MONOTONIC);
  const double processor = secondsOf(CLOCK_THREAD_CPUTIME_ID);
  const haptics::DeviceReading reading = m_device.read(start);
  const TickRecord& record = m_servo.tick(TickInput::of(start, reading, parameters));
  m_device.send(record.output.wrench());
  m_latest.write(record);
  m_records.push(record);
  m_ticks.store(m_ticks.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  raise(m_worstProcessor, secondsOf(CLOCK_THREAD_CPUTIME_ID) - processor);
  if (const double left = m_servo.postponed(); left > 0.0)
  {
    m_postponed.store(m_postponed.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    raise(m_worstPostponed, left);
  }
  m_wall.add(secondsOf(CLOCK_MONOTONIC) - start);
}

void ServoThread::run() noexcept
{
  sched_param priority{};
  priority.sched_priority = kPriority;
  m_realTime.store(pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0);

  ServoParameters parameters;
  std::uint64_t seen = 0;
  double due = secondsOf(CLOCK_MONOTONIC);
  int toStop = kMaxTicksToStop;
  bool resting = false;
  while (toStop > 0 && !(m_stop.load(std::memory_order_relaxed) && resting))
  {
    due += m_period;
    sleepUntil(due);
    const double behind = secondsOf(CLOCK_MONOTONIC) - due;
    m_lateness.add(behind);
    if (behind > m_period)
    {
      m_late.store(m_late.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      due += m_period * std::floor(behind / m_period);
    }
    const std::uint64_t count = m_parameters.count();
    if (count != seen && m_parameters.read(parameters))
      seen = count;
    if (m_stop.load(std::memory_order_relaxed))
    {
      parameters.pause = 1;
      --toStop;
    }
    tickOnce(parameters);
    m_majorFaults.store(core::majorPageFaults(), std::memory_order_relaxed);
    TickRecord last;
    resting = m_latest.read(last) && atRest(last);
  }
  m_device.send({});
  m_running.store(false);
}

} // namespace petrous::session
