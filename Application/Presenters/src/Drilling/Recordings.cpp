#include "petrous/Presenters/Recordings.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "petrous/Core/LocalTime.h"

namespace petrous::presenters
{

std::filesystem::path newRecording(const library::Library& library, const scene::Case& value)
{
  const std::filesystem::path folder = library.folder() / "recordings";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw core::Error(core::Fault::Refused, folder.string() +
                                                ": cannot be made (no permission or a full disk); "
                                                "choose another place for the recording");
  return unusedName(folder / (value.name + core::localTime(" %Y-%m-%d %H-%M-%S") + ".ticks"));
}

std::vector<std::filesystem::path> recordingsOf(const library::Library& library,
                                                const std::string& name)
{
  constexpr std::string_view kDate = "0000-00-00 00-00-00";
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(library.folder() / "recordings", error), end;
       !error && entry != end; entry.increment(error))
  {
    const std::string file = entry->path().filename().string();
    if (file.rfind(name + " ", 0) != 0 || entry->path().extension() != ".ticks" ||
        file.size() < name.size() + 1 + kDate.size())
      continue;
    const bool isDated = std::equal(
        kDate.begin(), kDate.end(), file.begin() + static_cast<std::ptrdiff_t>(name.size()) + 1,
        [](char form, char c) { return form == '0' ? c >= '0' && c <= '9' : c == form; });
    if (isDated)
      files.push_back(entry->path());
  }
  std::sort(files.rbegin(), files.rend());
  return files;
}

namespace
{

// The file's name without " (N)", and N; 1 without one.
std::pair<std::filesystem::path, int> sessionOf(const std::filesystem::path& file)
{
  constexpr std::size_t kDigits = 6;
  const std::string stem = file.stem().string();
  const std::size_t open = stem.rfind(" (");
  if (open == std::string::npos || open == 0 || stem.back() != ')')
    return {file, 1};
  const std::string number = stem.substr(open + 2, stem.size() - open - 3);
  const bool isNumber = !number.empty() && number.size() <= kDigits && number.front() != '0' &&
                        number.find_first_not_of("0123456789") == std::string::npos;
  if (!isNumber)
    return {file, 1};
  return {file.parent_path() / (stem.substr(0, open) + file.extension().string()),
          std::stoi(number)};
}

} // namespace

std::vector<std::vector<std::filesystem::path>>
inOperations(const std::vector<std::filesystem::path>& files)
{
  struct Operation
  {
    std::filesystem::path session;
    std::map<int, std::filesystem::path> parts;
  };
  std::vector<Operation> operations;
  for (const std::filesystem::path& file : files)
  {
    const auto [session, part] = sessionOf(file);
    auto at = std::find_if(operations.begin(), operations.end(),
                           [&name = session](const Operation& one) { return one.session == name; });
    if (at == operations.end())
      at = operations.insert(at, Operation{session, {}});
    at->parts[part] = file;
  }
  std::vector<std::vector<std::filesystem::path>> result;
  for (const Operation& one : operations)
  {
    result.emplace_back();
    for (const auto& [part, file] : one.parts)
      result.back().push_back(file);
  }
  return result;
}

std::filesystem::path unusedName(const std::filesystem::path& file)
{
  std::error_code error;
  std::filesystem::path unused = file;
  for (int n = 2; std::filesystem::exists(unused, error); ++n)
    unused.replace_filename(file.stem().string() + " (" + std::to_string(n) + ")" +
                            file.extension().string());
  return unused;
}

} // namespace petrous::presenters
