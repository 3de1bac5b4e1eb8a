#pragma once

#include <condition_variable>
#include <functional>
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
class JournalThread
{
public:
  /// What the open stroke has removed so far. Asked in the journal's thread, whatever became of the
  /// one that gave it.
  using Measure = std::function<dissection::RemovedVolume(const dissection::Dissection&)>;

  /// As library::Journal, and std::system_error.
  JournalThread(const library::Library& library, const scene::Case& value);
  JournalThread(const JournalThread&) = delete;
  JournalThread& operator=(const JournalThread&) = delete;
  ~JournalThread(); ///< the journal goes: what it holds is saved, or nobody wants it

  /// The dissection as it is now; from any thread. Copies it.
  void follow(const dissection::Dissection& work, const Measure& measure = {});

  /// The case was saved. All that it holds must have been handed over before.
  void saved(const scene::Case& value);

  /// Why it cannot be written, one sentence, once until it can again. Empty otherwise.
  std::string takeFailure();

private:
  struct Work
  {
    dissection::Dissection dissection;
    Measure measure;
  };
  void run();
  void write(std::optional<Work>& work, std::optional<scene::Case>& saved);

  Measure m_measure; // of what is written now
  library::Journal m_journal;
  std::mutex m_mutex; // guards what follows
  std::condition_variable m_wake;
  std::optional<Work> m_work;
  std::optional<scene::Case> m_saved;
  std::string m_failure;
  bool m_stop = false;
  std::thread m_thread; // last: uses all the others
};

} // namespace petrous::presenters
