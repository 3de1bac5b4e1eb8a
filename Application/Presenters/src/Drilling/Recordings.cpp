#include "petrous/Presenters/Recordings.h"

#include <algorithm>
#include <string_view>

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
