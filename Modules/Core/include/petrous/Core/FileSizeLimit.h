#pragma once

#include <csignal>

namespace petrous::core
{

/// Beyond the process's limit of a file's size (ulimit -f) a write fails (EFBIG), as on a full
/// disk, instead of ending the process with what it has begun left behind. For the begin of main();
/// programs that are started inherit it.
inline void failBeyondFileSizeLimit() noexcept
{
  std::signal(SIGXFSZ, SIG_IGN);
}

} // namespace petrous::core
