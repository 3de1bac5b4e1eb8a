#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace petrous::registration
{

/// What a process took, from its start to its end.
struct ProcessTimes
{
  int status = -1;               ///< its exit status; 127 where it could not be started
  double seconds = 0.0;          ///< wall time
  double processorSeconds = 0.0; ///< user and system time of all its threads
};

/// Runs a program (looked up in PATH) and waits for its end. Its stdout goes to `output`, or
/// nowhere where that is empty; it reads nothing, and its stderr goes nowhere.
ProcessTimes runProcess(const std::vector<std::string>& words,
                        const std::filesystem::path& output = {});

/// User and system time of this process until now, s.
double processorSeconds();

} // namespace petrous::registration
