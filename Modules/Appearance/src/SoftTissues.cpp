#include "petrous/Appearance/SoftTissues.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "SoftTissuesFile.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::appearance
{

namespace
{

using nlohmann::json;
using Range = std::array<double, 3>; // lowest, taken, highest

constexpr double kPi = 3.14159265358979323846;
constexpr double kSquareOfPoisson = 0.25; // of an incompressible solid
constexpr double kBall = 2.0;             // mm, radius of the usual burr
constexpr double kDepth = 0.5;            // mm
constexpr double kPerKilopascal = 1e-3;   // N/mm^2

void requirePositive(std::initializer_list<double> values)
{
  for (const double value : values)
    if (!(value > 0.0) || !std::isfinite(value))
      throw core::InvalidParameter("modulus and lengths of a contact must be above 0");
}

double toTwoDigits(double value)
{
  return core::parseDouble(core::generalText(value, 2)).value_or(value);
}

Range rangeOf(const json& entry, const char* key)
{
  const auto range = entry.at(key).get<Range>();
  if (!(range[0] > 0.0 && range[0] <= range[1] && range[1] <= range[2]))
    throw core::InvalidParameter(std::string("'") + key +
                                 "' must be the lowest, the usual and the highest value, above 0");
  return range;
}

SoftTissue softTissueFrom(const json& entry)
{
  SoftTissue tissue;
  tissue.name = entry.at("name").get<std::string>();
  tissue.title = entry.at("title").get<std::string>();
  tissue.certainty = entry.at("certainty").get<std::string>();
  tissue.status = entry.at("status").get<std::string>();
  const Range modulus = rangeOf(entry, "modulus_kpa");
  const auto contact = entry.at("contact").get<std::string>();
  Range stiffness{};
  if (contact == "solid")
    for (std::size_t n = 0; n < stiffness.size(); ++n)
      stiffness[n] = indentationStiffness(kPerKilopascal * modulus[n], kBall, kDepth);
  else if (contact == "membrane")
  {
    const Range thickness = rangeOf(entry, "thickness_mm");
    const double radius = entry.at("free_radius_mm").get<double>();
    for (std::size_t n = 0; n < stiffness.size(); ++n)
      stiffness[n] = plateStiffness(kPerKilopascal * modulus[n], thickness[n], radius);
  }
  else
    throw core::InvalidParameter("there is no contact '" + contact +
                                 "'; there are solid and membrane");
  tissue.lowest = toTwoDigits(stiffness[0]);
  tissue.stiffness = toTwoDigits(stiffness[1]);
  tissue.highest = toTwoDigits(stiffness[2]);
  return tissue;
}

} // namespace

double indentationStiffness(double modulus, double radius, double depth)
{
  requirePositive({modulus, radius, depth});
  return 4.0 / 3.0 * modulus / (1.0 - kSquareOfPoisson) * std::sqrt(radius * depth);
}

double plateStiffness(double modulus, double thickness, double radius)
{
  requirePositive({modulus, thickness, radius});
  const double rigidity =
      modulus * thickness * thickness * thickness / (12.0 * (1.0 - kSquareOfPoisson));
  return 16.0 * kPi * rigidity / (radius * radius);
}

std::vector<SoftTissue> parseSoftTissues(std::string_view text, const std::string& source)
{
  try
  {
    std::vector<SoftTissue> tissues;
    const auto root = json::parse(text);
    for (const auto& entry : root.at("soft_tissues"))
      tissues.push_back(softTissueFrom(entry));
    return tissues;
  }
  catch (const json::exception&)
  {
    throw core::InvalidParameter(source + ": not a table of soft tissues");
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(source + ": " + error.what());
  }
}

const std::vector<SoftTissue>& softTissues()
{
  static const std::vector<SoftTissue> kTissues =
      parseSoftTissues(kSoftTissuesFile, "soft-tissues.json");
  return kTissues;
}

const SoftTissue* findSoftTissue(const std::string& name)
{
  const auto& all = softTissues();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&name](const SoftTissue& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

} // namespace petrous::appearance
