#include "petrous/Dissection/BurrCatalogue.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

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
constexpr double kSizeEffectEnd = 100.0; // um
constexpr std::array kKinds{Burr::Kind::Cutting, Burr::Kind::Diamond};

BurrModel modelFrom(const json& entry)
{
  const auto kindName = entry.at("kind").get<std::string>();
  const auto kind = parseBurrKind(kindName);
  if (!kind)
    throw core::InvalidParameter("there is no kind of burr '" + kindName +
                                 "'; there are cutting and diamond");
  BurrModel model;
  model.kind = *kind;
  const std::string& name = model.name = entry.value("name", kindName);
  if (!isCatalogueName(name))
    throw core::InvalidParameter("'" + name +
                                 "' cannot be a burr's name: it has a to z, 0 to 9 and hyphens, at "
                                 "most 40");
  if (parseBurrKind(name).value_or(*kind) != *kind)
    throw core::InvalidParameter("burr '" + name + "' must be of the kind of that name");
  if (*kind == Burr::Kind::Cutting)
    model.rake = kRadians * entry.at("rake_deg").get<double>();
  else
  {
    model.wearCoefficient = entry.at("wear_coefficient").get<double>();
    model.grit = entry.value("grit_um", 0.0);
    if (!(model.grit >= 0.0 && model.grit <= kMaxGrit))
      throw core::InvalidParameter("burr '" + name + "': 'grit_um' must be 0 to " +
                                   core::plainText(kMaxGrit) + " um");
  }
  model.diameters = entry.at("diameters_mm").get<std::vector<double>>();
  if (model.diameters.empty() ||
      !std::all_of(model.diameters.begin(), model.diameters.end(),
                   [](double d) { return d > 0.0 && d <= kMaxBurrDiameter; }))
    throw core::InvalidParameter("burr '" + name +
                                 "': 'diameters_mm' must list diameters above 0 to " +
                                 core::plainText(kMaxBurrDiameter) + " mm");
  model.certainty = entry.value("certainty", std::string());
  model.status = entry.value("status", std::string());
  return model;
}

} // namespace

double wearOfGrit(double grit, double coarse)
{
  if (!(grit > 0.0) || !(coarse > 0.0))
    throw core::InvalidParameter("grit and wear coefficient must be above 0");
  return coarse * std::min(grit / kSizeEffectEnd, 1.0);
}

BurrCatalogue BurrCatalogue::builtIn()
{
  return {kBurrs, "burrs.json"};
}

BurrCatalogue::BurrCatalogue(std::string_view text, const std::string& source)
{
  try
  {
    const auto catalogue = json::parse(text);
    for (const auto& entry : catalogue.at("burrs"))
    {
      BurrModel model = modelFrom(entry);
      if (find(model.name))
        throw core::InvalidParameter("there are two burrs '" + model.name +
                                     "'; each needs a name of its own");
      m_models.push_back(std::move(model));
    }
    auto next = m_models.begin();
    for (const Burr::Kind kind : kKinds)
    {
      const auto usual =
          std::find_if(next, m_models.end(),
                       [kind](const BurrModel& model) { return model.name == nameOf(kind); });
      if (usual == m_models.end())
        throw core::InvalidParameter(std::string("there must be a burr '") + nameOf(kind) +
                                     "', the usual one of its kind");
      std::rotate(next++, usual, std::next(usual));
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

const BurrModel* BurrCatalogue::find(const std::string& name) const noexcept
{
  const auto found = std::find_if(m_models.begin(), m_models.end(),
                                  [&name](const BurrModel& model) { return model.name == name; });
  return found == m_models.end() ? nullptr : &*found;
}

const BurrModel& BurrCatalogue::model(const std::string& name) const
{
  if (const BurrModel* found = find(name))
    return *found;
  std::string names;
  for (const BurrModel& one : m_models)
    names += (names.empty() ? "" : ", ") + one.name;
  throw core::InvalidParameter("there is no burr '" + name + "'; there are " + names);
}

const BurrModel& BurrCatalogue::model(const Burr& burr) const
{
  const BurrModel& found = model(nameOf(burr));
  if (found.kind != burr.kind)
    throw core::InvalidParameter("the burr '" + found.name + "' is a " + nameOf(found.kind) +
                                 " one in this catalogue, not a " + nameOf(burr.kind) + " one");
  return found;
}

void setModel(Burr& burr, const BurrModel& model)
{
  burr.kind = model.kind;
  setName(burr, model.name);
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
    throw core::InvalidParameter("material '" + material.name + "' with the " + burr.name +
                                 " burr: " + error.what());
  }
}

void checkPairs(const MaterialCatalogue& materials, const BurrCatalogue& burrs)
{
  for (const TissueMaterial& material : materials.all())
    for (const BurrModel& burr : burrs.all())
      resistanceOf(material, burr);
}

} // namespace petrous::dissection
