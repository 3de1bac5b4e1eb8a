#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace petrous::core
{

/// Opens stdin, stdout and stderr on /dev/null where they are closed: else the first file that is
/// opened would become one of them, and be written to. What is written to stdout fails, as it would
/// have. For the first line of main().
inline void holdStandardStreams() noexcept
{
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

} // namespace petrous::core
