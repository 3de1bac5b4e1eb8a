#include "petrous/Dissection/BurrCatalogue.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "Burrs.h"
#include "JsonFault.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/RemovalLaw.h"

namespace petrous::dissection
{

namespace
{

using nlohmann::json;

constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr double kPascalOfMega = 1e6;
constexpr std::array kKinds{Burr::Kind::Cutting, Burr::Kind::Diamond};

BurrModel modelFrom(const json& entry)
{
  const auto name = entry.at("kind").get<std::string>();
  const auto kind = parseBurrKind(name);
  if (!kind)
    throw core::InvalidParameter("there is no kind of burr '" + name +
                                 "'; there are cutting and diamond");
  BurrModel model;
  model.kind = *kind;
  if (*kind == Burr::Kind::Cutting)
    model.rake = kRadians * entry.at("rake_deg").get<double>();
  else
    model.wearCoefficient = entry.at("wear_coefficient").get<double>();
  model.diameters = entry.at("diameters_mm").get<std::vector<double>>();
  if (model.diameters.empty() ||
      !std::all_of(model.diameters.begin(), model.diameters.end(),
                   [](double d) { return d > 0.0 && d <= kMaxBurrDiameter; }))
    throw core::InvalidParameter("burr '" + name +
                                 "': 'diameters_mm' must list diameters above 0 to " +
                                 core::generalText(kMaxBurrDiameter) + " mm");
  model.status = entry.value("status", std::string());
  return model;
}

} // namespace

BurrCatalogue BurrCatalogue::builtIn()
{
  return {kBurrs, "burrs.json"};
}

BurrCatalogue::BurrCatalogue(std::string_view text, const std::string& source)
{
  try
  {
    const auto catalogue = json::parse(text);
    std::vector<BurrModel> models;
    for (const auto& entry : catalogue.at("burrs"))
      models.push_back(modelFrom(entry));
    for (const Burr::Kind kind : kKinds)
    {
      const auto isIt = [kind](const BurrModel& model) { return model.kind == kind; };
      if (std::count_if(models.begin(), models.end(), isIt) != 1)
        throw core::InvalidParameter(std::string("there must be one burr of the kind ") +
                                     nameOf(kind));
      m_models.push_back(*std::find_if(models.begin(), models.end(), isIt));
    }
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

const BurrModel& BurrCatalogue::model(Burr::Kind kind) const noexcept
{
  return m_models[kind == Burr::Kind::Cutting ? 0 : 1];
}

double resistanceOf(const TissueMaterial& material, const BurrModel& burr)
{
  try
  {
    const double pascal =
        burr.kind == Burr::Kind::Cutting
            ? OrthogonalCutting(material.specificEnergy, material.friction, burr.rake).resistance()
            : AbrasiveWear(material.hardness, burr.wearCoefficient).resistance();
    return pascal / kPascalOfMega;
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter("material '" + material.name + "' with the " + nameOf(burr.kind) +
                                 " burr: " + error.what());
  }
}

void checkPairs(const MaterialCatalogue& materials, const BurrCatalogue& burrs)
{
  for (const TissueMaterial& material : materials.all())
    for (const Burr::Kind kind : kKinds)
      resistanceOf(material, burrs.model(kind));
}

} // namespace petrous::dissection
