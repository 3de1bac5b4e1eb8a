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
  /// Gets every record, in order; for instance RecordingWriter::add. What it throws ends it alone.
  using Sink = std::function<void(const TickRecord&)>;

  /// records, loop  must outlive this; used by the thread alone until stop()
  /// Throws std::system_error when there is no thread to be had.
  DissectionThread(SpscRing<TickRecord>& records, DissectionLoop& loop, Sink sink = {});
  DissectionThread(const DissectionThread&) = delete;
  DissectionThread& operator=(const DissectionThread&) = delete;
  ~DissectionThread();

  /// Asks for one stroke back or forth, to be done after what the ring holds now; from any thread.
  void undo();
  void redo();

  /// Empties the ring, closes the stroke and ends the thread. Again is as once.
  void stop();

  /// What went wrong, one sentence, once: the sink or a cut failed. Empty when nothing did.
  std::string takeFailure();

private:
  void run();
  void drain();
  void obey();
  template <typename Work>
  void attempt(const char* what, Work work);

  SpscRing<TickRecord>& m_records;
  DissectionLoop& m_loop;
  Sink m_sink;
  std::vector<TickRecord> m_batch;
  std::mutex m_mutex; // guards what follows
  std::condition_variable m_wake;
  std::vector<bool> m_asked; // true: undo, false: redo
  std::string m_failure;
  bool m_stop = false;
  std::thread m_thread;
};

} // namespace petrous::simulation
