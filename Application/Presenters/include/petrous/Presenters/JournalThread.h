#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Library/Journal.h"

namespace petrous::presenters
{

/// Writes a case's journal in a thread of its own, so that neither drilling nor rendering waits for
/// the disk. Only the latest state handed over matters, so nothing queues up; failed writes are
/// retried every second and reported.
///
/// Exists before the case is in a library, and is kept when the case moves to another one: the
/// latest state is kept and written to each journal that is begun.
class JournalThread
{
public:
  /// What the open stroke has removed so far. Called in the journal's thread, possibly after its
  /// provider is gone.
  using Measure = std::function<dissection::RemovedVolume(const dissection::Dissection&)>;

  JournalThread(); ///< throws std::system_error
  JournalThread(const JournalThread&) = delete;
  JournalThread& operator=(const JournalThread&) = delete;
  ~JournalThread(); ///< the journal is removed: its contents are saved or no longer needed

  /// From now on the journal is that of the case in this state. The last state handed over is
  /// written to it, then the previous journal is removed. Throws as library::Journal.
  void begin(const library::Library& library, const library::SavedState& saved);
  bool begun() const;

  /// The current dissection; copied. Thread-safe.
  void follow(const dissection::Dissection& work, const Measure& measure = {});

  /// The case was saved. Everything it contains must have been handed over before.
  void saved(const library::SavedState& now);

  /// Why the journal cannot be written, one sentence, reported once until it can again; else empty.
  std::string takeFailure();

private:
  struct Work
  {
    dissection::Dissection dissection;
    Measure measure;
  };
  /// What the thread has to do.
  struct Tasks
  {
    std::unique_ptr<library::Journal> begin; ///< then `work`, then `saved`
    std::size_t beginStrokes = 0;
    std::optional<Work> work;
    bool news = false; ///< the latest state is not yet written
    std::optional<library::SavedState> saved;
    bool empty() const noexcept { return !begin && !work && !news && !saved; }
  };
  void run();
  void write(Tasks& tasks);

  // Used by the thread only.
  Measure m_measure; // of what is being written
  std::optional<Work> m_latest;
  std::unique_ptr<library::Journal> m_journal;

  mutable std::mutex m_mutex; // guards what follows
  std::condition_variable m_wake;
  Tasks m_tasks;
  bool m_begun = false;
  std::string m_failure;
  bool m_stop = false;
  std::thread m_thread; // last: uses all others
};

} // namespace petrous::presenters
