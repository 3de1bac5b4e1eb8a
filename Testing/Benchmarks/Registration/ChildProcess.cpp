#include "ChildProcess.h"

#include <cerrno>
#include <chrono>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

extern char** environ;

namespace petrous::registration
{

namespace
{

double processorSecondsOf(const rusage& usage)
{
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

} // namespace

ProcessTimes runProcess(const std::vector<std::string>& words, const std::filesystem::path& output)
{
  std::vector<std::string> copy = words;
  std::vector<char*> arguments;
  for (std::string& word : copy)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string out = output.empty() ? "/dev/null" : output.string();
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  const int failed =
      ::posix_spawnp(&child, arguments.front(), &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ProcessTimes times;
  if (failed != 0)
  {
    times.status = 127;
    return times;
  }
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR)
      return times;
  times.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  times.processorSeconds = processorSecondsOf(usage);
  times.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return times;
}

double processorSeconds()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return processorSecondsOf(usage);
}

} // namespace petrous::registration
