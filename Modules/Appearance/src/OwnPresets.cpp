#include "petrous/Appearance/OwnPresets.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "PresetEntry.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/FileLock.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::appearance
{

namespace
{

using nlohmann::json;

constexpr std::uintmax_t kLargest = 16U << 20; // bytes
constexpr std::size_t kLongestName = 60;       // bytes

bool isNamed(const std::vector<StructureAppearance>& presets, const std::string& name)
{
  return std::any_of(presets.begin(), presets.end(),
                     [&name](const auto& preset) { return preset.preset == name; });
}

// Between reading and replacing the file.
core::FileLock lockOf(const std::filesystem::path& file)
{
  return core::FileLock(file.parent_path() / ".presets.lock");
}

} // namespace

OwnPresets::OwnPresets(const std::filesystem::path& folder)
  : m_file(folder / "presets.json")
{
}

std::vector<StructureAppearance> OwnPresets::all() const
{
  std::vector<StructureAppearance> presets;
  std::error_code none;
  if (!std::filesystem::exists(m_file, none))
    return presets;
  const std::string text = core::readFile(m_file, kLargest);
  const auto refuse = [this](const std::string& what)
  { throw core::InvalidParameter(core::printable(m_file) + ": " + what); };
  try
  {
    const json file = json::parse(text);
    for (const json& entry : file.at("presets"))
    {
      presets.push_back(presetFrom(entry));
      const std::string name = presets.back().preset;
      // One that is built in by now is read all the same, and stands for it.
      if (!isNamed(StructurePresets::builtIn().all(), name))
        checkName(name);
      if (isNamed({presets.begin(), presets.end() - 1}, name))
        refuse("two presets are called '" + name + "'");
    }
  }
  catch (const json::exception&) // its text would quote the file
  {
    refuse("must be {\"presets\": [...]}, as the presets of structures.json");
  }
  catch (const core::InvalidParameter& error)
  {
    const std::string what = error.what();
    if (what.find(core::printable(m_file)) == 0)
      throw;
    refuse(what);
  }
  std::sort(presets.begin(), presets.end(),
            [](const auto& a, const auto& b) { return a.preset < b.preset; });
  return presets;
}

StructureAppearance
OwnPresets::preset(const std::string& name,
                   const std::function<bool(const StructureAppearance&)>& isListed) const
{
  const std::vector<StructureAppearance> own = all();
  for (const StructureAppearance& preset : own)
    if (preset.preset == name)
      return preset;
  const StructurePresets builtIn = StructurePresets::builtIn();
  try
  {
    return builtIn.preset(name);
  }
  catch (const core::InvalidParameter&) // lists its own alone
  {
  }
  std::vector<StructureAppearance> there = builtIn.all();
  there.insert(there.end(), own.begin(), own.end());
  std::string names;
  for (const StructureAppearance& preset : there)
    if (!isListed || isListed(preset))
      names += (names.empty() ? "" : ", ") + preset.preset;
  throw core::InvalidParameter("there is no preset '" + name + "'; there are " + names);
}

StructureAppearance OwnPresets::save(const StructureAppearance& look, const std::string& name,
                                     bool isPrimaryMr) const
{
  checkName(name);
  std::error_code none;
  std::filesystem::create_directories(m_file.parent_path(), none); // a failure is met below
  const core::FileLock lock = lockOf(m_file);
  std::vector<StructureAppearance> presets = all();
  StructureAppearance preset = look;
  preset.preset = name;
  const bool readsOther = look.solid && !look.sourceImage.empty(); // a lumen reads the bone around
  preset.sourceImage = !look.transfer || look.relative ? ""
                       : readsOther || isPrimaryMr     ? kOfMr
                                                       : kOfCt;
  preset = presetFrom(presetJson(preset)); // as it will be read
  const auto before = std::find_if(presets.begin(), presets.end(),
                                   [&name](const auto& one) { return one.preset == name; });
  if (before != presets.end())
    *before = preset;
  else
    presets.push_back(preset);
  write(presets);
  return preset;
}

void OwnPresets::remove(const std::string& name) const
{
  const bool isBuiltIn = isNamed(StructurePresets::builtIn().all(), name);
  const auto refuseBuiltIn = [&name]
  { throw core::InvalidParameter("preset '" + name + "' is built in and cannot be removed"); };
  std::error_code none;
  if (isBuiltIn && !std::filesystem::exists(m_file, none))
    refuseBuiltIn();
  if (!std::filesystem::exists(m_file, none))
    throw core::InvalidParameter("the library has no preset '" + name + "'");
  const core::FileLock lock = lockOf(m_file);
  std::vector<StructureAppearance> presets = all();
  if (isBuiltIn && !isNamed(presets, name))
    refuseBuiltIn();
  if (!isNamed(presets, name))
    throw core::InvalidParameter("the library has no preset '" + name + "'");
  presets.erase(std::remove_if(presets.begin(), presets.end(),
                               [&name](const auto& preset) { return preset.preset == name; }),
                presets.end());
  write(presets);
}

void OwnPresets::checkName(const std::string& name)
{
  const auto refuse = [](const std::string& what)
  { throw core::InvalidParameter("preset's name: " + what); };
  if (name.empty() || name.size() > kLongestName)
    refuse("must have 1 to " + std::to_string(kLongestName) + " bytes");
  if (!core::isUtf8(name) ||
      std::any_of(name.begin(), name.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }))
    refuse("must be UTF-8 text without control characters");
  if (name.front() == ' ' || name.back() == ' ')
    refuse("must not begin or end with a space");
  if (isNamed(StructurePresets::builtIn().all(), name))
    refuse("'" + name + "' is a built-in preset");
}

void OwnPresets::write(const std::vector<StructureAppearance>& presets) const
{
  json entries = json::array();
  for (const StructureAppearance& preset : presets)
    entries.push_back(presetJson(preset));
  core::writeFile(m_file, json{{"presets", std::move(entries)}}.dump(2) + "\n");
}

} // namespace petrous::appearance
