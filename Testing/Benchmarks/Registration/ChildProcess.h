#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace petrous::registration
{

/// Resource usage of a process over its lifetime.
struct ProcessTimes
{
  int status = -1;               ///< exit status; 127 if it could not be started
  double seconds = 0.0;          ///< wall time
  double processorSeconds = 0.0; ///< user and system time of all threads
};

/// Runs a program (looked up in PATH) and waits for it. Its stdout goes to `output`, or is
/// discarded if that is empty; stdin is empty and stderr is discarded.
ProcessTimes runProcess(const std::vector<std::string>& words,
                        const std::filesystem::path& output = {});

/// User and system time of this process so far, s.
double processorSeconds();

} // namespace petrous::registration
