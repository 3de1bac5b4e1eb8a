#include "petrous/Presenters/DeviceLimits.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "petrous/Core/Error.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/DefaultFolder.h"

namespace petrous::presenters
{

namespace
{

constexpr char kKey[] = "max_stiffness_n_per_mm";
constexpr double kLargest = 20.0; // N/mm

bool sound(double stiffness)
{
  return stiffness > 0.0 && stiffness <= kLargest;
}

constexpr double kMostOfDescribed = 2.0;
constexpr double kUntested = 0.25;    // of the described
constexpr double kMostUntested = 0.5; // N/mm
constexpr double kSoft = 0.2;         // N/mm: rendered by any device with force feedback

// Null if it is no such file.
nlohmann::json entriesOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  nlohmann::json entries = nlohmann::json::parse(file, nullptr, false);
  return entries.is_object() ? entries : nlohmann::json();
}

// A server's devices, also of the former format.
nlohmann::json devicesOf(const nlohmann::json& entries, const std::string& server)
{
  const auto entry = entries.find(server);
  if (entry == entries.end() || !entry->is_object())
    return nlohmann::json::object();
  const auto device = entry->find("device");
  if (device == entry->end() || !device->is_string())
    return *entry;
  const auto stiffness = entry->find(kKey);
  return stiffness == entry->end()
             ? nlohmann::json::object()
             : nlohmann::json{{device->get<std::string>(), {{kKey, *stiffness}}}};
}

void putAside(const std::filesystem::path& file)
{
  std::error_code error; // writing then says what is wrong
  if (std::filesystem::file_size(file, error) == 0 || error)
    return;
  std::filesystem::path aside = file;
  aside += ".damaged";
  for (int i = 2; std::filesystem::exists(aside, error); ++i)
  {
    aside = file;
    aside += ".damaged-" + std::to_string(i);
  }
  std::filesystem::rename(file, aside, error);
}

} // namespace

std::filesystem::path deviceLimitsFile()
{
  const std::filesystem::path beside = library::defaultFolderFile();
  return beside.empty() ? beside : beside.parent_path() / "device-limits.json";
}

double boundedStiffness(double measured, double described) noexcept
{
  return std::max(0.0, std::min(measured, kMostOfDescribed * described));
}

double untestedStiffness(double described) noexcept
{
  return std::clamp(kUntested * described, std::min(0.5 * described, kSoft), kMostUntested);
}

std::optional<double> keptStiffness(const std::filesystem::path& file, const std::string& server,
                                    const std::string& device, double described)
{
  const nlohmann::json devices = devicesOf(entriesOf(file), server);
  const auto entry = devices.find(device);
  if (entry == devices.end() || !entry->is_object())
    return std::nullopt;
  const auto stiffness = entry->find(kKey);
  if (stiffness == entry->end() || !stiffness->is_number() || !sound(stiffness->get<double>()))
    return std::nullopt;
  return boundedStiffness(stiffness->get<double>(), described);
}

void keepStiffness(const std::filesystem::path& file, const std::string& server,
                   const std::string& device, double stiffness)
{
  if (!sound(stiffness))
    throw core::InvalidParameter("device limits: a stiffness must be above 0, up to 20 N/mm");
  nlohmann::json entries = entriesOf(file);
  if (entries.is_null())
  {
    putAside(file);
    entries = nlohmann::json::object();
  }
  nlohmann::json devices = devicesOf(entries, server);
  devices[device] = {{kKey, stiffness}};
  entries[server] = std::move(devices);
  std::error_code ignored; // writing then says what is wrong
  std::filesystem::create_directories(file.parent_path(), ignored);
  // A device's name is whatever its server sends.
  core::writeFile(file,
                  entries.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

} // namespace petrous::presenters
