#include "ProcessMemory.h"

#include <fstream>
#include <string>

namespace petrous::imaging
{

namespace
{

/// A value from /proc/self/status.
double memoryMb(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name + ":", 0) == 0)
      return static_cast<double>(std::stoll(line.substr(name.size() + 1))) * 1024.0 / 1e6;
  return 0.0;
}

} // namespace

double residentMb()
{
  return memoryMb("VmRSS");
}

double peakMb()
{
  return memoryMb("VmHWM");
}

void resetPeakMemory()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

} // namespace petrous::imaging
