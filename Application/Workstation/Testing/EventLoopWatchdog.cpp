#include "EventLoopWatchdog.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <execinfo.h>
#include <unistd.h>

namespace petrous::workstation
{

namespace
{

constexpr int kBeat = 5; // ms

double millisecondsNow()
{
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

void printWhere(int)
{
  void* frames[48];
  backtrace_symbols_fd(frames, backtrace(frames, 48), STDERR_FILENO);
  static const char kEnd[] = "--\n";
  (void)!write(STDERR_FILENO, kEnd, sizeof kEnd - 1);
}

} // namespace

EventLoopWatchdog::EventLoopWatchdog(double hangs)
  : m_watched(pthread_self())
{
  void* frame = nullptr;
  backtrace(&frame, 1); // loads libgcc outside of the handler
  std::signal(SIGUSR2, printWhere);
  m_timer.setTimerType(Qt::PreciseTimer);
  m_timer.setInterval(kBeat);
  QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { beat(); });
  m_timer.start();
  m_last = m_begun = millisecondsNow();
  m_watcher = std::thread([this, hangs] { watch(hangs); });
}

EventLoopWatchdog::~EventLoopWatchdog()
{
  m_ends = true;
  m_watcher.join();
  for (const Step& step : steps())
    std::printf("%-44s %7.0f ms, loop turned %5d times, longest block %6.0f ms\n",
                step.name.c_str(), step.whole, step.beats, step.longest);
  std::fflush(stdout);
}

void EventLoopWatchdog::begin(const std::string& step)
{
  steps();
  m_steps.push_back({step});
  m_last = m_begun = millisecondsNow();
}

const std::vector<EventLoopWatchdog::Step>& EventLoopWatchdog::steps()
{
  if (m_steps.empty())
    return m_steps;
  const double now = millisecondsNow();
  m_steps.back().whole = now - m_begun;
  m_steps.back().longest = std::max(m_steps.back().longest, now - m_last);
  return m_steps;
}

void EventLoopWatchdog::beat()
{
  const double now = millisecondsNow();
  if (!m_steps.empty())
  {
    ++m_steps.back().beats;
    m_steps.back().longest = std::max(m_steps.back().longest, now - m_last);
  }
  m_last = now;
}

void EventLoopWatchdog::watch(double hangs)
{
  const bool prints = qEnvironmentVariableIsSet("PETROUS_WATCHDOG");
  double told = 0.0; // the beat after which it was said
  while (!m_ends)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(kBeat));
    const double last = m_last;
    const double age = millisecondsNow() - last;
    if (hangs > 0.0 && age > 1000.0 * hangs)
    {
      pthread_kill(m_watched, SIGABRT); // whose handler prints where
      return;
    }
    if (!prints || age < kLong || told == last)
      continue;
    told = last;
    std::fprintf(stderr, "-- no events for %.0f ms:\n", age);
    pthread_kill(m_watched, SIGUSR2);
  }
}

} // namespace petrous::workstation
