#include "petrous/Presenters/Recordings.h"

#include <ctime>

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
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  char when[32];
  std::strftime(when, sizeof when, " %Y-%m-%d %H-%M-%S", &local);
  return unusedName(folder / (value.name + when + ".ticks"));
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
