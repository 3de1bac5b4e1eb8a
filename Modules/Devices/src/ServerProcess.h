#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace petrous::devices
{

/// The child process of a device server.
class ServerProcess
{
public:
  ServerProcess() = default;
  /// Kills what still runs.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  /// Starts `command`, found on the PATH, with `block` as a further argument; nothing, or why not.
  std::optional<std::string> start(const std::vector<std::string>& command,
                                   const std::string& block);

  bool runs() const noexcept { return m_pid > 0; }
  pid_t pid() const noexcept { return m_pid; }

  /// Once it has ended, how, in words: "was killed by signal 9 (Killed)". Does not wait.
  std::optional<std::string> ended();

  /// Waits until it ends, `seconds` at most.
  bool waitForEnd(double seconds);

  void signal(int number) noexcept;

private:
  pid_t m_pid = 0;
};

} // namespace petrous::devices
