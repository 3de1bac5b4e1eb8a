#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/SpscRing.h"

namespace petrous::simulation
{

/// Empties the servo's ring in a thread of its own: cuts, undoes and redoes, records. It never
/// holds the servo up; the servo's ring is polled every millisecond.
class DissectionThread
{
public:
  /// Called in the thread; each may be empty.
  struct Hooks
  {
    /// Gets every record, in order; for instance RecordingWriter::add. What it throws ends it
    /// alone.
    std::function<void(const TickRecord&)> tick;
    /// After some ticks were looked at, or an undo: where what was done is passed on.
    std::function<void()> after;
  };

  /// records, loop  must outlive this; used by the thread alone until stop()
  /// cuts           false: no tick cuts, whatever it says
  /// Throws std::system_error when there is no thread to be had.
  DissectionThread(SpscRing<TickRecord>& records, DissectionLoop& loop, Hooks hooks,
                   bool cuts = true);
  DissectionThread(const DissectionThread&) = delete;
  DissectionThread& operator=(const DissectionThread&) = delete;
  ~DissectionThread();

  /// Asks for one stroke back or forth, to be done after what the ring holds now, the open stroke
  /// closed first; from any thread. What still drills opens another with the first tick that felt
  /// the change.
  void undo();
  void redo();

  /// Empties the ring, does what was asked, closes the stroke and ends the thread. Again is as
  /// once.
  void stop();

  /// What went wrong, one sentence, once. Empty when nothing did.
  std::string takeFailure();

  /// A cut, an undo or `after` failed: what was done until then stands, and no tick cuts any more.
  bool failed() const noexcept { return m_failed; }

private:
  void run();
  void drain();
  void obey();
  void pass();
  template <typename Work>
  bool attempt(const char* what, Work work);
  template <typename Work>
  void need(const char* what, Work work);

  SpscRing<TickRecord>& m_records;
  DissectionLoop& m_loop;
  Hooks m_hooks;
  const bool m_cuts;
  std::vector<TickRecord> m_batch;
  std::atomic<bool> m_failed{false};
  std::mutex m_mutex; // guards what follows
  std::condition_variable m_wake;
  std::vector<bool> m_asked; // true: undo, false: redo
  std::string m_failure;
  bool m_stop = false;
  std::thread m_thread;
};

} // namespace petrous::simulation
