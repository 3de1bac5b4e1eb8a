#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/SpscRing.h"

namespace petrous::session
{

/// Empties the servo's ring in a thread of its own: cuts, undoes, redoes, records. Never blocks the
/// servo; polls its ring every millisecond.
class DissectionThread
{
public:
  /// Called in the thread; each may be empty.
  struct Hooks
  {
    /// Receives every record, in order; for instance RecordingWriter::add. If it throws, only the
    /// recording ends.
    std::function<void(const TickRecord&)> tick;
    /// After a batch of ticks or an undo: to pass on the results.
    std::function<void()> after;
  };

  /// records, loop  must outlive this; used by the thread only, until stop()
  /// cuts           false: ticks never cut
  /// Throws std::system_error if the thread cannot be started.
  DissectionThread(SpscRing<TickRecord>& records, DissectionLoop& loop, Hooks hooks,
                   bool cuts = true);
  DissectionThread(const DissectionThread&) = delete;
  DissectionThread& operator=(const DissectionThread&) = delete;
  ~DissectionThread();

  /// Requests undo or redo of one stroke, after the current contents of the ring and after closing
  /// an open stroke; from any thread. A drill still running opens a new one with the first tick
  /// that felt the change.
  void undo();
  void redo();

  /// Empties the ring, completes requests, closes the stroke and ends the thread. Idempotent.
  void stop();

  /// First failure as one sentence, returned once. Empty if none.
  std::string takeFailure();

  /// A cut, an undo or `after` failed: previous work is kept, and no further tick cuts.
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
  std::mutex m_mutex; // for the members below
  std::condition_variable m_wake;
  std::vector<bool> m_asked; // true: undo, false: redo
  std::string m_failure;
  bool m_stop = false;
  std::thread m_thread;
};

} // namespace petrous::session
