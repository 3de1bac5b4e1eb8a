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

/// Writes a case's journal in a thread of its own, so that neither who cuts nor who draws waits for
/// the disk. Only the latest state that was handed over matters, so nothing piles up; what cannot
/// be written is tried again every second, and told.
///
/// It is there before the case is in a library, and stays when the case moves to another one: the
/// latest state is kept, and goes to each journal that is begun.
class JournalThread
{
public:
  /// What the open stroke has removed so far. Asked in the journal's thread, whatever became of the
  /// one that gave it.
  using Measure = std::function<dissection::RemovedVolume(const dissection::Dissection&)>;

  JournalThread(); ///< throws std::system_error
  JournalThread(const JournalThread&) = delete;
  JournalThread& operator=(const JournalThread&) = delete;
  ~JournalThread(); ///< the journal goes: what it holds is saved, or nobody wants it

  /// From now on the journal is that of the case in this state. What was handed over last goes
  /// there first, then the journal before is removed. Throws as library::Journal.
  void begin(const library::Library& library, const library::SavedState& saved);
  bool begun() const;

  /// The dissection as it is now; from any thread. Copies it.
  void follow(const dissection::Dissection& work, const Measure& measure = {});

  /// The case was saved. All that it holds must have been handed over before.
  void saved(const library::SavedState& now);

  /// Why it cannot be written, one sentence, once until it can again. Empty otherwise.
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
    bool news = false; ///< the latest state is not written
    std::optional<library::SavedState> saved;
    bool empty() const noexcept { return !begin && !work && !news && !saved; }
  };
  void run();
  void write(Tasks& tasks);

  // Of the thread alone.
  Measure m_measure; // of what is written now
  std::optional<Work> m_latest;
  std::unique_ptr<library::Journal> m_journal;

  mutable std::mutex m_mutex; // guards what follows
  std::condition_variable m_wake;
  Tasks m_tasks;
  bool m_begun = false;
  std::string m_failure;
  bool m_stop = false;
  std::thread m_thread; // last: uses all the others
};

} // namespace petrous::presenters
