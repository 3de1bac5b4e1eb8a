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

/// Verifies memory-mapped objects, which are never read completely, against their hash on a
/// background thread. Each object once. Thread-safe; the thread exists while there is work, and
/// pending work is abandoned on destruction.
class ObjectChecks
{
public:
  ObjectChecks() = default;
  ~ObjectChecks();
  ObjectChecks(const ObjectChecks&) = delete;
  ObjectChecks& operator=(const ObjectChecks&) = delete;

  /// `what` describes the object to the user. An object that is intact or pending is not checked
  /// again; a damaged one is, since it may have been restored.
  void start(const std::filesystem::path& object, const std::string& what);

  bool knows(const std::filesystem::path& object) const;

  /// Lets an object be checked again that was intact: it may have been removed since.
  void forget(const std::filesystem::path& object);

  /// Starts the check if necessary, and waits for it: returns one sentence on the damage, empty if
  /// there is none. Throws CancelledError.
  std::string wait(const std::filesystem::path& object, const std::string& what,
                   const core::Progress& progress = {});

  /// Waits for all started checks; returns the damage, one sentence each. Throws CancelledError.
  std::vector<std::string> waitForAll(const core::Progress& progress = {});

  /// Damage of an object found so far, one sentence; empty: none.
  std::string found(const std::filesystem::path& object) const;

private:
  struct Check
  {
    std::string what;
    bool done = false;
    std::string damage;
  };
  void run();

  mutable std::mutex m_mutex; // guards everything but the token
  std::condition_variable m_done;
  std::map<std::filesystem::path, Check> m_checks;
  std::deque<std::filesystem::path> m_queue;
  bool m_running = false;
  core::CancelToken m_stop;
  std::thread m_thread;
};

} // namespace petrous::library
