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

using nlohmann::json;

StructureLook lookFrom(const json& entry)
{
  StructureLook look;
  look.preset = entry.at("name").get<std::string>();
  look.color = entry.at("color").get<std::array<float, 3>>();
  look.opacity = entry.at("opacity").get<float>();
  look.solid = entry.at("solid").get<bool>();
  look.tissue = entry.value("tissue", std::string());
  look.priority = entry.value("priority", look.priority);
  look.shininess = entry.value("shininess", look.shininess);
  const auto refuse = [&look](const std::string& what)
  { throw core::InvalidParameter("structure preset '" + look.preset + "': " + what); };
  const auto outside = [](float x) { return !(x >= 0.0F && x <= 1.0F); };
  if (outside(look.opacity) || std::any_of(look.color.begin(), look.color.end(), outside))
    refuse("colour and opacity must lie in 0 to 1");
  if (!(look.shininess >= kSmallestShininess && look.shininess <= kLargestShininess))
    refuse("shininess must lie in 1 to 200");
  try
  {
    setStiffness(look, entry.value("stiffness_n_per_mm", 0.0));
    setWarning(look, entry.value("warn_mm", 0.0));
  }
  catch (const core::InvalidParameter& error)
  {
    refuse(error.what());
  }
  if (!entry.contains("transfer"))
    return look;
  json transfer = entry.at("transfer");
  look.relative = transfer.value("relative", false);
  transfer.erase("relative");
  try
  {
    look.transfer = TransferFunction::fromJson(transfer.dump());
  }
  catch (const core::InvalidParameter& error)
  {
    refuse(error.what());
  }
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

StructurePresets::StructurePresets(std::string_view text)
{
  try
  {
    const auto catalogue = json::parse(text);
    m_other = lookFrom(catalogue.at("other"));
    for (const auto& entry : catalogue.at("presets"))
    {
      m_words.push_back({entry.at("words").get<std::vector<std::string>>(), m_presets.size()});
      m_presets.push_back(lookFrom(entry));
    }
    std::vector<Words> first;
    for (const auto& entry : catalogue.value("first", json::array()))
    {
      const auto name = entry.at("preset").get<std::string>();
      const StructureLook* look = find(name);
      if (!look)
        throw core::InvalidParameter("structure presets: 'first' names no preset '" + name + "'");
      // "other" stands behind the last of the presets.
      const auto index =
          look == &m_other ? m_presets.size() : static_cast<std::size_t>(look - m_presets.data());
      first.push_back({entry.at("words").get<std::vector<std::string>>(), index});
    }
    m_words.insert(m_words.begin(), first.begin(), first.end());
  }
  catch (const json::exception& error)
  {
    throw core::InvalidParameter(std::string("structure presets: ") + error.what());
  }
}

const StructureLook* StructurePresets::find(const std::string& name) const
{
  const auto found = std::find_if(m_presets.begin(), m_presets.end(),
                                  [&name](const auto& look) { return look.preset == name; });
  return found != m_presets.end() ? &*found : name == m_other.preset ? &m_other : nullptr;
}

const StructureLook* StructurePresets::lookByWord(const std::string& structureName) const
{
  const std::string name = " " + plainWords(structureName) + " ";
  for (const Words& entry : m_words)
    for (const std::string& word : entry.words)
      // At a word's start: "mastoid", not "sternocleidomastoid".
      if (name.find(" " + word) != std::string::npos)
        return entry.preset < m_presets.size() ? &m_presets[entry.preset] : &m_other;
  return nullptr;
}

StructureLook StructurePresets::lookFor(const std::string& structureName) const
{
  const StructureLook* look = lookByWord(structureName);
  return look ? *look : m_other;
}

StructureLook StructurePresets::preset(const std::string& name) const
{
  const StructureLook* look = find(name);
  if (!look)
    look = lookByWord(name);
  if (look)
    return *look;
  std::string there;
  for (const StructureLook& preset : all())
    there += (there.empty() ? "" : ", ") + preset.preset;
  throw core::InvalidParameter("there is no preset '" + name + "'; there are " + there);
}

std::vector<StructureLook> StructurePresets::all() const
{
  std::vector<StructureLook> presets = m_presets;
  presets.push_back(m_other);
  return presets;
}

StructureLook boneLook()
{
  return StructurePresets::builtIn().preset("bone");
}

} // namespace petrous::appearance
