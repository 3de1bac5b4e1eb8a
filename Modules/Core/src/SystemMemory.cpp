#include "petrous/Core/SystemMemory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
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

// What a control group may still get. Files in its page cache are given up for it.
std::uint64_t leftIn(const std::string& group)
{
  const std::uint64_t most = numberIn(group + "/memory.max");
  if (most == 0)
    return std::numeric_limits<std::uint64_t>::max();
  std::uint64_t used = numberIn(group + "/memory.current");
  std::ifstream statistics(group + "/memory.stat");
  std::uint64_t bytes = 0;
  for (std::string name; statistics >> name >> bytes;)
    if (name == "inactive_file")
      used -= std::min(used, bytes);
  return most - std::min(used, most);
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
      const std::string root = "/sys/fs/cgroup";
      for (std::string group = root + line.substr(3); group.size() >= root.size();
           group.resize(group.rfind('/'))) // the limits of all above it hold too
        memory.available = std::min(memory.available, leftIn(group));
    }
  return memory;
}

} // namespace petrous::core
