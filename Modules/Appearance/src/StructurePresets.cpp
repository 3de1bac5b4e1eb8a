#include "petrous/Appearance/StructurePresets.h"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "Structures.h"
#include "petrous/Core/Error.h"

namespace petrous::appearance
{

namespace
{

StructureLook lookFrom(const nlohmann::json& entry)
{
  StructureLook look;
  look.preset = entry.at("name").get<std::string>();
  look.color = entry.at("color").get<std::array<float, 3>>();
  look.opacity = entry.at("opacity").get<float>();
  look.solid = entry.at("solid").get<bool>();
  const auto outside = [](float x) { return !(x >= 0.0F && x <= 1.0F); };
  if (outside(look.opacity) || std::any_of(look.color.begin(), look.color.end(), outside))
    throw core::InvalidParameter("structure preset '" + look.preset +
                                 "': colour and opacity must lie in 0 to 1");
  return look;
}

std::string plainWords(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) {
                   return c == '_' || c == '-' || c == '.' ? ' '
                                                           : static_cast<char>(std::tolower(c));
                 });
  return name;
}

} // namespace

StructurePresets StructurePresets::builtIn()
{
  return StructurePresets(kStructures);
}

StructurePresets::StructurePresets(std::string_view json)
{
  try
  {
    const auto catalogue = nlohmann::json::parse(json);
    m_other = lookFrom(catalogue.at("other"));
    for (const auto& entry : catalogue.at("presets"))
      m_entries.push_back({entry.at("words").get<std::vector<std::string>>(), lookFrom(entry)});
  }
  catch (const nlohmann::json::exception& error)
  {
    throw core::InvalidParameter(std::string("structure presets: ") + error.what());
  }
}

StructureLook StructurePresets::lookFor(const std::string& structureName) const
{
  const std::string name = " " + plainWords(structureName);
  for (const Entry& entry : m_entries)
    for (const std::string& word : entry.words)
      // At a word's start: "mastoid", not "sternocleidomastoid".
      if (name.find(" " + word) != std::string::npos)
        return entry.look;
  return m_other;
}

} // namespace petrous::appearance
