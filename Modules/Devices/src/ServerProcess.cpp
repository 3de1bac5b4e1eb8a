#include "ServerProcess.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace petrous::devices
{

namespace
{

std::string wordsFor(int status)
{
  if (WIFSIGNALED(status))
  {
    const int number = WTERMSIG(status);
    const char* name = ::sigdescr_np(number);
    return "was killed by signal " + std::to_string(number) + " (" + (name ? name : "unknown") +
           ")";
  }
  return "ended by itself with status " + std::to_string(WEXITSTATUS(status));
}

} // namespace

ServerProcess::~ServerProcess()
{
  if (!runs())
    return;
  signal(SIGKILL);
  ::waitpid(m_pid, nullptr, 0);
}

std::optional<std::string> ServerProcess::start(const std::vector<std::string>& command,
                                                const std::string& block)
{
  std::vector<std::string> words = command;
  words.push_back(block);
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);

  // The parent may have blocked or ignored signals; the server starts with defaults.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  pid_t pid = 0;
  const int error =
      ::posix_spawnp(&pid, arguments[0], nullptr, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0)
    return "cannot start " + command.front() + ": " + std::strerror(error);
  m_pid = pid;
  return std::nullopt;
}

std::optional<std::string> ServerProcess::ended()
{
  if (!runs())
    return std::nullopt;
  int status = 0;
  const pid_t result = ::waitpid(m_pid, &status, WNOHANG);
  if (result == 0 || (result < 0 && errno == EINTR))
    return std::nullopt;
  m_pid = 0;
  return result < 0 ? std::string("ended; how, the system does not say") : wordsFor(status);
}

bool ServerProcess::waitForEnd(double seconds)
{
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (runs() && !ended() && Clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return !runs();
}

void ServerProcess::signal(int number) noexcept
{
  if (runs())
    ::kill(m_pid, number);
}

} // namespace petrous::devices
