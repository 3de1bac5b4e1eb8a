#include <cstdlib>
#include <fstream>
#include <thread>

#include "Commands.h"
#include "Numbers.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::cli
{

namespace
{

double memoryMiB(const std::string& key)
{
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(key + ":", 0) == 0)
      return std::strtod(line.c_str() + key.size() + 1, nullptr) / 1024.0;
  return 0.0;
}

// The nearest folder that exists: where the library would be made.
std::filesystem::path existingFolder(std::filesystem::path path)
{
  path = std::filesystem::absolute(path);
  while (!std::filesystem::exists(path) && path.has_parent_path() && path != path.parent_path())
    path = path.parent_path();
  return path;
}

void doctor(const Context& context)
{
  nlohmann::json advice = nlohmann::json::array();
  const auto advise = [&](const std::string& text) { advice.push_back(text); };

  std::string gl;
  try
  {
    const rendering::OffscreenView view(16, 16);
    gl = view.glRenderer();
    if (gl.find("llvmpipe") != std::string::npos || gl.find("softpipe") != std::string::npos)
      advise("OpenGL runs on the processor: pictures are right but slow; install the driver of "
             "your graphics card");
  }
  catch (const rendering::RenderingError& error)
  {
    advise(error.what());
  }
  const char* display = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  const bool hasDisplay = (display && *display) || (wayland && *wayland);
  if (!hasDisplay)
    advise("there is no display: the command works, the workstation needs one");

  const library::Library library = context.openLibrary();
  std::error_code error;
  const auto space = std::filesystem::space(existingFolder(library.folder()), error);
  const double freeMiB = error ? 0.0 : static_cast<double>(space.available) / (1 << 20);
  if (freeMiB < 2048.0)
    advise("less than 2 GiB are free where the library lies; a head CT takes about 0.3 GiB");
  const double total = memoryMiB("MemTotal");
  const double available = memoryMiB("MemAvailable");
  if (available < 2048.0)
    advise("less than 2 GiB of memory are free; load only the ear with --roi");

  context.say("OpenGL      " + (gl.empty() ? std::string("none") : gl));
  context.say(std::string("display     ") + (hasDisplay ? "yes" : "none"));
  context.say("processors  " + std::to_string(std::thread::hardware_concurrency()));
  context.say("memory      " + fixed(total, 0) + " MiB, " + fixed(available, 0) + " MiB free");
  context.say("library     " + library.folder().string() + ", " + fixed(freeMiB, 0) +
              " MiB free there");
  context.say("devices     none are supported yet; drill with the mouse");
  for (const auto& text : advice)
    context.say("* " + text.get<std::string>());
  context.give({{"gl_renderer", gl.empty() ? nlohmann::json(nullptr) : nlohmann::json(gl)},
                {"display", hasDisplay},
                {"processors", std::thread::hardware_concurrency()},
                {"memory_mib", total},
                {"memory_free_mib", available},
                {"library", library.folder().string()},
                {"library_free_mib", freeMiB},
                {"devices", nlohmann::json::array()},
                {"advice", std::move(advice)}});
}

} // namespace

void addDoctorCommand(CLI::App& app, Context& context)
{
  context.addCommand(app, "doctor",
                     "What this machine offers, and what to do about what is missing",
                     [&context] { doctor(context); });
}

} // namespace petrous::cli
