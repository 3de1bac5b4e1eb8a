#include "petrous/Devices/ServerCatalogue.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include <unistd.h>

namespace petrous::devices
{

namespace
{

namespace fs = std::filesystem;

constexpr char kPrefix[] = "petrous-device-";
constexpr std::size_t kMaxLength = 48;

// Empty if it is not a valid server name.
std::string nameOf(const fs::path& program)
{
  std::string name = program.filename().string();
  if (name.rfind(kPrefix, 0) == 0)
    name.erase(0, sizeof kPrefix - 1);
  const bool sound = std::all_of(name.begin(), name.end(),
                                 [](char c)
                                 {
                                   return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                                          (c >= '0' && c <= '9') || c == '.' || c == '-' ||
                                          c == '_';
                                 });
  return sound && !name.empty() && name.front() != '.' && name.size() <= kMaxLength ? name
                                                                                    : std::string();
}

bool mayRun(const fs::path& program)
{
  std::error_code error;
  return fs::is_regular_file(program, error) && ::access(program.c_str(), X_OK) == 0;
}

fs::path folderOf(const char* variable)
{
  const char* value = std::getenv(variable);
  return value ? fs::path(value) : fs::path();
}

} // namespace

std::vector<FoundServer> findServers(const std::vector<fs::path>& folders)
{
  std::vector<FoundServer> found;
  for (const fs::path& folder : folders)
  {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
    {
      const std::string name = nameOf(entry->path());
      const bool known = std::any_of(found.begin(), found.end(),
                                     [&name](const FoundServer& s) { return s.name == name; });
      if (!name.empty() && !known && mayRun(entry->path()))
        found.push_back({name, fs::absolute(entry->path(), error)});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const FoundServer& a, const FoundServer& b) { return a.name < b.name; });
  return found;
}

std::vector<fs::path> serverFolders()
{
  std::vector<fs::path> folders;
  if (const char* listed = std::getenv("PETROUS_DEVICE_SERVERS"))
  {
    std::istringstream list(listed);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty())
        folders.emplace_back(folder);
    return folders;
  }
  fs::path data = folderOf("XDG_DATA_HOME");
  if (data.empty() && !folderOf("HOME").empty())
    data = folderOf("HOME") / ".local" / "share";
  if (!data.empty())
    folders.push_back(data / "petrous" / "devices");
  folders.emplace_back("/usr/local/lib/petrous/devices");
  folders.emplace_back("/usr/lib/petrous/devices");
  return folders;
}

} // namespace petrous::devices
