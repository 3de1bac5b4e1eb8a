#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <pthread.h>

#include <QTimer>

namespace petrous::workstation
{

/// For how long the thread that makes it handles no events. A timer of that thread beats; another
/// thread looks at the age of the last beat. Prints a table when it is destroyed.
///
/// PETROUS_WATCHDOG=1: where the thread is, is printed whenever a beat is kLong late.
class EventLoopWatchdog
{
public:
  static constexpr double kLong = 100.0; ///< ms

  struct Step
  {
    std::string name;
    int beats = 0;        ///< how often the loop turned
    double longest = 0.0; ///< ms between two beats
    double whole = 0.0;   ///< ms
  };

  /// `hangs`: s without a beat after which the process is aborted; 0: never.
  explicit EventLoopWatchdog(double hangs = 0.0);
  ~EventLoopWatchdog();

  void begin(const std::string& step); ///< and ends the one before
  const std::vector<Step>& steps();    ///< with the present one

private:
  void beat();
  void watch(double hangs);

  std::vector<Step> m_steps;
  QTimer m_timer;
  std::atomic<double> m_last{0.0}; // ms, of a steady clock
  double m_begun = 0.0;
  std::atomic<bool> m_ends{false};
  pthread_t m_watched;
  std::thread m_watcher;
};

} // namespace petrous::workstation
