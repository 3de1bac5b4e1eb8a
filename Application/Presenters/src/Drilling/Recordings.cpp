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
  const std::string stem = value.name + when;
  std::filesystem::path file = folder / (stem + ".ticks");
  for (int n = 2; std::filesystem::exists(file, error); ++n)
    file = folder / (stem + " (" + std::to_string(n) + ").ticks");
  return file;
}

} // namespace petrous::presenters
