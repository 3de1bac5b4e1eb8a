#include "petrous/Presenters/DeviceLimits.h"

#include <fstream>

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

nlohmann::json entriesOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  nlohmann::json entries = nlohmann::json::parse(file, nullptr, false);
  return entries.is_object() ? entries : nlohmann::json::object();
}

} // namespace

std::filesystem::path deviceLimitsFile()
{
  const std::filesystem::path beside = library::defaultFolderFile();
  return beside.empty() ? beside : beside.parent_path() / "device-limits.json";
}

std::optional<double> keptStiffness(const std::filesystem::path& file, const std::string& server,
                                    const std::string& device)
{
  const nlohmann::json entries = entriesOf(file);
  const auto entry = entries.find(server);
  if (entry == entries.end() || !entry->is_object())
    return std::nullopt;
  const auto name = entry->find("device");
  const auto stiffness = entry->find(kKey);
  if (name == entry->end() || *name != device || stiffness == entry->end() ||
      !stiffness->is_number() || !sound(stiffness->get<double>()))
    return std::nullopt;
  return stiffness->get<double>();
}

void keepStiffness(const std::filesystem::path& file, const std::string& server,
                   const std::string& device, double stiffness)
{
  if (!sound(stiffness))
    throw core::InvalidParameter("device limits: a stiffness must be above 0, up to 20 N/mm");
  nlohmann::json entries = entriesOf(file);
  entries[server] = {{"device", device}, {kKey, stiffness}};
  std::error_code ignored; // writing then says what is wrong
  std::filesystem::create_directories(file.parent_path(), ignored);
  // A device's name is whatever its server sends.
  core::writeFile(file,
                  entries.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

} // namespace petrous::presenters
