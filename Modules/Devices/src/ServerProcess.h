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
  /// Kills the process if it still runs.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  /// Starts `command`, searched on PATH, with `block` as last argument. Returns nullopt or the
  /// error.
  std::optional<std::string> start(const std::vector<std::string>& command,
                                   const std::string& block);

  bool runs() const noexcept { return m_pid > 0; }
  pid_t pid() const noexcept { return m_pid; }

  /// How the process ended, e.g. "was killed by signal 9 (Killed)"; nullopt while it runs. Does not
  /// wait.
  std::optional<std::string> ended();

  /// Waits for the process to end, at most `seconds`.
  bool waitForEnd(double seconds);

  void signal(int number) noexcept;

private:
  pid_t m_pid = 0;
};

} // namespace petrous::devices
