#include "petrous/Core/SystemMemory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>

namespace petrous::core
{

namespace
{

// 0 where there is no number, e.g. "max".
std::uint64_t numberIn(const std::string& file)
{
  std::uint64_t number = 0;
  std::ifstream(file) >> number;
  return number;
}

} // namespace

SystemMemory systemMemory()
{
  SystemMemory memory;
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    for (const auto& [key, value] :
         {std::pair{"MemTotal:", &memory.total}, std::pair{"MemAvailable:", &memory.available}})
      if (line.rfind(key, 0) == 0)
        *value = std::strtoull(line.c_str() + std::char_traits<char>::length(key), nullptr, 10)
                 << 10;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);)
    if (line.rfind("0::", 0) == 0)
    {
      const std::string folder = "/sys/fs/cgroup" + line.substr(3);
      const std::uint64_t most = numberIn(folder + "/memory.max");
      const std::uint64_t used = numberIn(folder + "/memory.current");
      if (most > 0)
        memory.available = std::min(memory.available, most - std::min(used, most));
    }
  return memory;
}

} // namespace petrous::core
