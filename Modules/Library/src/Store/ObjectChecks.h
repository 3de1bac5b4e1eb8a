#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "petrous/Core/Progress.h"

namespace petrous::library
{

/// Holds objects that are mapped, and so are not read as a whole, against their hash, in a thread
/// of its own. Each object once. Thread-safe; the thread is there while there is something to do,
/// and what is left undone is given up on destruction.
class ObjectChecks
{
public:
  ObjectChecks() = default;
  ~ObjectChecks();
  ObjectChecks(const ObjectChecks&) = delete;
  ObjectChecks& operator=(const ObjectChecks&) = delete;

  /// `what` names for the user what the object is. One that was found whole, or that waits for its
  /// turn, is not looked at again; one that was damaged is: it may have been restored.
  void start(const std::filesystem::path& object, const std::string& what);

  bool knows(const std::filesystem::path& object) const;

  /// Starts the check where that was not done, and waits for it: one sentence on the damage, empty
  /// where there is none. Throws CancelledError.
  std::string wait(const std::filesystem::path& object, const std::string& what,
                   const core::Progress& progress = {});

  /// Waits for all that were given: the damage, one sentence each. Throws CancelledError.
  std::vector<std::string> waitForAll(const core::Progress& progress = {});

  /// The damage of an object that was found so far, one sentence; empty: none.
  std::string found(const std::filesystem::path& object) const;

private:
  struct Check
  {
    std::string what;
    bool done = false;
    std::string damage;
  };
  void run();

  mutable std::mutex m_mutex; // guards all but the token
  std::condition_variable m_done;
  std::map<std::filesystem::path, Check> m_checks;
  std::deque<std::filesystem::path> m_queue;
  bool m_running = false;
  core::CancelToken m_stop;
  std::thread m_thread;
};

} // namespace petrous::library
