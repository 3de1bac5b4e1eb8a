#include "Sources.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <sstream>

#include "LibraryFolder.h"
#include "Salt.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/ObjectStore.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 28;
constexpr std::size_t kMaxLinks = 10000; // of a folder

using Nanoseconds = std::chrono::nanoseconds;

long long nanoseconds(fs::file_time_type time)
{
  return std::chrono::duration_cast<Nanoseconds>(time.time_since_epoch()).count();
}

fs::file_time_type fileTime(long long count)
{
  return fs::file_time_type(
      std::chrono::duration_cast<fs::file_time_type::duration>(Nanoseconds(count)));
}

// Files that were chosen one by one are read from a folder of links to them.
std::vector<fs::path> pathsOf(const fs::path& origin)
{
  std::vector<fs::path> paths{resolvedPath(origin)};
  std::error_code error;
  std::size_t count = 0;
  for (fs::directory_iterator entry(origin, error), end;
       !error && entry != end && count < kMaxLinks; entry.increment(error))
  {
    std::error_code ignored;
    if (!entry->is_symlink(ignored))
      continue;
    paths.push_back(resolvedPath(entry->path()));
    ++count;
  }
  return paths;
}

} // namespace

Sources::Sources(const fs::path& library)
  : m_file(library / "sources")
{
  std::error_code error;
  if (fs::symlink_status(m_file, error).type() == fs::file_type::not_found)
  {
    m_salt = hasSalt(library) ? saltOf(library) : std::string();
    return;
  }
  m_salt = saltOf(library);
  try
  {
    std::istringstream lines(core::readFile(m_file, kLargestFile));
    for (std::string line; std::getline(lines, line);)
    {
      const std::size_t space = line.find(' ');
      long long when = 0;
      if (space != std::string::npos &&
          std::from_chars(line.data() + space + 1, line.data() + line.size(), when).ec ==
              std::errc())
        m_read[line.substr(0, space)] = fileTime(when);
    }
  }
  catch (const core::InputFileError& fault)
  {
    throw libraryError(fault);
  }
}

std::string Sources::hashOf(const fs::path& path) const
{
  const std::string text = m_salt + '\n' + path.string();
  return sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

std::optional<fs::file_time_type> Sources::whenRead(const fs::path& path) const
{
  const auto found = m_read.find(hashOf(path));
  return found == m_read.end() ? std::nullopt : std::optional(found->second);
}

void Sources::add(const std::vector<scene::PartsOrigin>& origins)
{
  if (origins.empty())
    return;
  if (m_salt.empty())
    m_salt = saltOf(m_file.parent_path());
  bool isNew = false;
  for (const scene::PartsOrigin& origin : origins)
    for (const fs::path& path : pathsOf(origin.path))
    {
      const auto [known, isAdded] = m_read.emplace(hashOf(path), origin.read);
      isNew = isNew || isAdded || known->second < origin.read;
      known->second = std::max(known->second, origin.read);
    }
  if (!isNew)
    return;
  std::string text;
  for (const auto& [hash, read] : m_read)
    text += hash + ' ' + std::to_string(nanoseconds(read)) + '\n';
  try
  {
    core::writeFile(m_file, text);
  }
  catch (const core::OutputFileError& fault)
  {
    throw libraryError(fault);
  }
}

} // namespace petrous::library
