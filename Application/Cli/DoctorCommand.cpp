#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/Log.h"
#include "petrous/Core/SystemMemory.h"
#include "petrous/Devices/DeviceCatalogue.h"
#include "petrous/Rendering/GraphicsReport.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::cli
{

namespace
{

// The nearest existing folder: where the library would be created.
std::filesystem::path existingFolder(std::filesystem::path path)
{
  path = std::filesystem::absolute(path);
  while (!std::filesystem::exists(path) && path.has_parent_path() && path != path.parent_path())
    path = path.parent_path();
  return path;
}

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

bool rayCasterWorks(const rendering::GraphicsReport& graphics)
{
  return std::all_of(graphics.variants.begin(), graphics.variants.end(),
                     [](const auto& variant) { return variant.compiles; });
}

std::vector<std::string> graphicsAdvice(const rendering::GraphicsReport& graphics)
{
  constexpr int kLargeCt = 1024;
  std::vector<std::string> advice;
  if (graphics.renderer.find("llvmpipe") != std::string::npos ||
      graphics.renderer.find("softpipe") != std::string::npos)
    advice.emplace_back("OpenGL runs on the CPU: pictures are correct but slow; install the "
                        "driver of your graphics card");
  if (!rayCasterWorks(graphics))
    advice.emplace_back("the driver refuses a shader of the ray caster; a newer driver may take "
                        "it, and 'render --engine reference' needs none");
  if (graphics.largestTexture3d < kLargeCt)
    advice.push_back("the driver takes volumes of up to " +
                     std::to_string(graphics.largestTexture3d) +
                     " voxels along an axis; larger ones are drawn reduced: load only the ear "
                     "with --roi");
  return advice;
}

nlohmann::json graphicsJson(const std::optional<rendering::GraphicsReport>& graphics)
{
  if (!graphics)
    return {{"gl_renderer", nullptr},
            {"gl_version", nullptr},
            {"largest_3d_texture", nullptr},
            {"filter_bits", nullptr},
            {"ray_caster", {{"works", false}, {"variants", nlohmann::json::array()}}}};
  nlohmann::json variants = nlohmann::json::array();
  for (const auto& variant : graphics->variants)
    variants.push_back({{"features", variant.features},
                        {"compiles", variant.compiles},
                        {"error", variant.error.empty() ? nlohmann::json(nullptr)
                                                        : nlohmann::json(variant.error)}});
  return {
      {"gl_renderer", graphics->renderer},
      {"gl_version", graphics->version},
      {"largest_3d_texture", graphics->largestTexture3d},
      {"filter_bits", graphics->filterBits},
      {"ray_caster", {{"works", rayCasterWorks(*graphics)}, {"variants", std::move(variants)}}}};
}

void doctor(const Context& context)
{
  nlohmann::json advice = nlohmann::json::array();
  const auto advise = [&](const std::string& text) { advice.push_back(text); };

  std::optional<rendering::GraphicsReport> graphics;
  try
  {
    graphics = rendering::reportGraphics();
  }
  catch (const rendering::RenderingError& error)
  {
    advise(std::string(error.what()) +
           "; until then 'render --engine reference' draws on the processor, slowly");
  }
  if (graphics)
    for (const std::string& text : graphicsAdvice(*graphics))
      advise(text);
  const char* display = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  const bool hasDisplay = (display && *display) || (wayland && *wayland);
  if (!hasDisplay)
    advise("there is no display: the command works, the workstation needs one");

  std::vector<devices::FoundDevice> devices;
  try
  {
    devices = devices::findDevices(devices::HidLibrary());
  }
  catch (const devices::HidError& error)
  {
    advise(std::string(error.what()) +
           "; install libhidapi-hidraw0 for a SpaceMouse or a foot pedal");
  }
  for (const auto& device : devices)
    if (!device.advice.empty())
      advise(device.title() + ": " + device.advice);

  const library::Library library = context.openLibrary();
  std::error_code error;
  const auto space = std::filesystem::space(existingFolder(library.folder()), error);
  const double freeMiB = error ? 0.0 : static_cast<double>(space.available) / (1 << 20);
  if (freeMiB < 2048.0)
    advise("less than 2 GiB are free where the library lies; a head CT takes about 0.3 GiB");
  const core::SystemMemory memory = core::systemMemory();
  const double total = std::ldexp(static_cast<double>(memory.total), -20);
  const double available = std::ldexp(static_cast<double>(memory.available), -20);
  if (available < 2048.0)
    advise("less than 2 GiB of memory are free; load only the ear with --roi");

  context.print("OpenGL      " + (graphics ? graphics->renderer : std::string("none")));
  if (graphics)
  {
    context.print("            version " + graphics->version);
    context.print("            volumes up to " + std::to_string(graphics->largestTexture3d) +
                  " voxels along an axis");
    if (graphics->filterBits > 0 &&
        graphics->filterBits < rendering::RenderQuality::kExactFilterBits)
      context.print("            filters with weights of " + std::to_string(graphics->filterBits) +
                    " bits; an exact filter takes its place");
    for (const auto& variant : graphics->variants)
      context.print("ray caster  " + joined(variant.features) +
                    (variant.compiles ? "" : ": does not work: " + variant.error));
  }
  context.print(std::string("display     ") + (hasDisplay ? "yes" : "none"));
  context.print("processors  " + std::to_string(std::thread::hardware_concurrency()));
  context.print("memory      " + fixed(total, 0) + " MiB, " + fixed(available, 0) + " MiB free");
  context.print("library     " + library.folder().string() + ", " + fixed(freeMiB, 0) +
                " MiB free there");
  const std::filesystem::path log = core::log::defaultFile();
  context.print("log         " +
                (log.empty() ? std::string("none: no home folder") : log.string()));
  for (const auto& device : devices)
    context.print("device      " + device.title() + (device.advice.empty() ? ", ready" : ""));
  if (devices.empty())
    context.print(
        "devices     no SpaceMouse and no foot pedal is plugged in; drill with the mouse");
  for (const auto& text : advice)
    context.print("* " + text.get<std::string>());
  nlohmann::json found = nlohmann::json::array();
  for (const auto& device : devices)
    found.push_back({{"name", device.title()}, {"ready", device.advice.empty()}});
  nlohmann::json report = graphicsJson(graphics);
  report.update({{"display", hasDisplay},
                 {"processors", std::thread::hardware_concurrency()},
                 {"memory_mib", total},
                 {"memory_free_mib", available},
                 {"library", library.folder().string()},
                 {"library_free_mib", freeMiB},
                 {"log_file", log.empty() ? nlohmann::json(nullptr) : nlohmann::json(log.string())},
                 {"devices", std::move(found)},
                 {"advice", std::move(advice)}});
  context.printJson(report);
}

} // namespace

void addDoctorCommand(CLI::App& app, Context& context)
{
  context.addCommand(app, "doctor",
                     "Report what this machine provides, and what to do about what is missing",
                     [&context] { doctor(context); });
}

} // namespace petrous::cli
