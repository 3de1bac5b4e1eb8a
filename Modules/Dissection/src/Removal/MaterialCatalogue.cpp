#include "petrous/Dissection/MaterialCatalogue.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "JsonFault.h"
#include "Materials.h"
#include "petrous/Core/Error.h"

namespace petrous::dissection
{

namespace
{

using nlohmann::json;

TissueMaterial materialFrom(const json& entry)
{
  TissueMaterial material;
  material.name = entry.at("name").get<std::string>();
  const auto positive = [&](const char* key)
  {
    const double value = entry.at(key).get<double>();
    if (!(value > 0.0) || !std::isfinite(value))
      throw core::InvalidParameter("material '" + material.name + "': '" + key +
                                   "' must be above 0, it is " + entry.at(key).dump());
    return value;
  };
  if (material.name.empty())
    throw core::InvalidParameter("a material has an empty name");
  material.title = entry.value("title", material.name);
  material.specificEnergy = kPascalOfGiga * positive("specific_cutting_energy_gpa");
  material.friction = positive("friction");
  material.hardness = kPascalOfVickers * positive("vickers_hardness_hv");
  material.certainty = entry.value("certainty", std::string());
  material.status = entry.value("status", std::string());
  return material;
}

} // namespace

MaterialCatalogue MaterialCatalogue::builtIn()
{
  return {kMaterials, "materials.json"};
}

MaterialCatalogue::MaterialCatalogue(std::string_view text, const std::string& source)
{
  try
  {
    const auto catalogue = json::parse(text);
    for (const auto& entry : catalogue.at("materials"))
    {
      TissueMaterial material = materialFrom(entry);
      if (contains(material.name))
        throw core::InvalidParameter("material '" + material.name + "' stands there twice");
      m_materials.push_back(std::move(material));
    }
    const auto& bone = catalogue.at("bone");
    m_bone.cellular = bone.at("cellular").get<std::string>();
    m_bone.cortical = bone.at("cortical").get<std::string>();
    m_bone.low = bone.at("from_hu").get<double>();
    m_bone.high = bone.at("to_hu").get<double>();
    material(m_bone.cellular);
    material(m_bone.cortical);
    if (!(m_bone.low < m_bone.high))
      throw core::InvalidParameter("bone: 'from_hu' must lie below 'to_hu'");
  }
  catch (const json::exception& error)
  {
    throw core::InvalidParameter(source + ": " + jsonFault(error, text));
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(source + ": " + error.what());
  }
}

bool MaterialCatalogue::contains(const std::string& name) const noexcept
{
  return std::any_of(m_materials.begin(), m_materials.end(),
                     [&name](const auto& material) { return material.name == name; });
}

const TissueMaterial& MaterialCatalogue::material(const std::string& name) const
{
  std::string names;
  for (const TissueMaterial& material : m_materials)
  {
    if (material.name == name)
      return material;
    names += (names.empty() ? "" : ", ") + material.name;
  }
  throw core::InvalidParameter("there is no material '" + name + "'; there are " + names);
}

} // namespace petrous::dissection
