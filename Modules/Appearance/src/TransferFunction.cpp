#include "petrous/Appearance/TransferFunction.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <nlohmann/json.hpp>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::appearance
{

namespace
{

void check(const std::vector<ControlPoint>& points)
{
  const auto refuse = [](std::size_t i, const char* what)
  {
    throw core::InvalidParameter("transfer function: point " + std::to_string(i + 1) + ": " + what);
  };
  if (points.empty())
    throw core::InvalidParameter("transfer function: at least one point is needed");
  const auto outside = [](float x) { return !(x >= 0.0F && x <= 1.0F); };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const ControlPoint& point = points[i];
    if (!std::isfinite(point.value))
      refuse(i, "the value must be a finite number");
    if (i > 0 && !(point.value > points[i - 1].value))
      refuse(i, "values must rise from point to point");
    if (std::any_of(point.color.begin(), point.color.end(), outside))
      refuse(i, "colour must lie in 0 to 1");
    if (outside(point.opacity))
      refuse(i, "opacity (of 1 mm) must lie in 0 to 1");
    if (outside(point.specular))
      refuse(i, "specular must lie in 0 to 1");
  }
}

using nlohmann::json;

// More points are certainly not a transfer function, and each costs the renderer.
constexpr std::size_t kMaxPoints = 1024;

[[noreturn]] void refuseJson(const std::string& what)
{
  throw core::InvalidParameter("transfer function: " + what);
}

// A misspelled key would otherwise be ignored silently.
void checkKeys(const json& object, std::initializer_list<const char*> known,
               const std::string& where)
{
  for (const auto& entry : object.items())
    if (std::find(known.begin(), known.end(), entry.key()) == known.end())
    {
      std::string list;
      for (const char* name : known)
        list += (list.empty() ? "" : ", ") + std::string(name);
      refuseJson(where + "'" + entry.key().substr(0, 40) + "' means nothing here; use " + list);
    }
}

double numberIn(const json& point, const char* key, const std::string& where)
{
  const auto found = point.find(key);
  if (found == point.end())
    refuseJson(where + "'" + key + "' is missing");
  if (!found->is_number())
    refuseJson(where + "'" + key + "' must be a number");
  return found->get<double>();
}

ControlPoint pointIn(const json& j, const std::string& where)
{
  if (!j.is_object())
    refuseJson(where + "must be {\"value\", \"color\", \"opacity\", \"specular\"}");
  checkKeys(j, {"value", "color", "opacity", "specular"}, where);
  ControlPoint point;
  point.value = numberIn(j, "value", where);
  point.opacity = static_cast<float>(numberIn(j, "opacity", where));
  if (j.contains("specular"))
    point.specular = static_cast<float>(numberIn(j, "specular", where));
  const auto color = j.find("color");
  if (color == j.end() || !color->is_array() || color->size() != 3 ||
      !std::all_of(color->begin(), color->end(), [](const json& c) { return c.is_number(); }))
    refuseJson(where + "'color' must be [red, green, blue], each 0 to 1");
  for (std::size_t c = 0; c < 3; ++c)
    point.color[c] = (*color)[c].get<float>();
  return point;
}

// The double with the shortest representation of the float: 0.9, not 0.8999999761581421.
double shortest(float value)
{
  return core::parseDouble(core::exactText(value)).value_or(value);
}

double extinctionOf(double opacity)
{
  return -std::log1p(-std::min(opacity, TransferFunction::kLargestOpacity));
}

} // namespace

TransferFunction::TransferFunction(std::vector<ControlPoint> points)
  : m_points(std::move(points))
{
  check(m_points);
}

TransferFunction TransferFunction::constant(const std::array<float, 3>& color, float opacity,
                                            float specular)
{
  return TransferFunction({ControlPoint{0.0, color, opacity, specular}});
}

TransferFunction::Optics TransferFunction::at(double value) const noexcept
{
  const auto after = std::upper_bound(m_points.begin(), m_points.end(), value,
                                      [](double v, const ControlPoint& p) { return v < p.value; });
  const bool first = after == m_points.begin() || std::isnan(value);
  const ControlPoint& a = first ? m_points.front() : *(after - 1);
  const ControlPoint& b = first ? a : (after == m_points.end() ? a : *after);
  const double w = b.value > a.value ? (value - a.value) / (b.value - a.value) : 0.0;
  const auto mix = [w](double x, double y) { return x + (y - x) * w; };
  Optics optics;
  for (std::size_t c = 0; c < 3; ++c)
    optics.color[c] = mix(a.color[c], b.color[c]);
  optics.extinction = extinctionOf(mix(a.opacity, b.opacity));
  optics.specular = mix(a.specular, b.specular);
  return optics;
}

bool TransferFunction::transparent() const noexcept
{
  return std::all_of(m_points.begin(), m_points.end(),
                     [](const ControlPoint& point) { return point.opacity == 0.0F; });
}

TransferFunction TransferFunction::fromJson(std::string_view text)
{
  json j;
  try
  {
    j = json::parse(text);
  }
  catch (const json::parse_error& error) // error.what() would quote the file
  {
    const std::string_view before = text.substr(0, std::min(error.byte, text.size()));
    refuseJson("not JSON; look at line " +
               std::to_string(1 + std::count(before.begin(), before.end(), '\n')));
  }
  catch (const json::exception&)
  {
    refuseJson("not JSON that can be read: a number is too large");
  }
  if (!j.is_object() || !j.contains("points") || !j["points"].is_array())
    refuseJson("must be {\"points\": [{\"value\": 300, \"color\": [r, g, b], \"opacity\": 0.2, "
               "\"specular\": 0.5}, ...]}");
  checkKeys(j, {"points"}, "");
  if (j["points"].size() > kMaxPoints)
    refuseJson("has " + std::to_string(j["points"].size()) + " points; at most " +
               std::to_string(kMaxPoints) + " are taken");
  std::vector<ControlPoint> points;
  for (const json& point : j["points"])
    points.push_back(pointIn(point, "point " + std::to_string(points.size() + 1) + ": "));
  return TransferFunction(std::move(points));
}

std::string TransferFunction::toJson() const
{
  json points = json::array();
  for (const ControlPoint& point : m_points)
    points.push_back(
        {{"value", point.value},
         {"color", {shortest(point.color[0]), shortest(point.color[1]), shortest(point.color[2])}},
         {"opacity", shortest(point.opacity)},
         {"specular", shortest(point.specular)}});
  return json{{"points", std::move(points)}}.dump();
}

bool operator==(const ControlPoint& a, const ControlPoint& b) noexcept
{
  return a.value == b.value && a.color == b.color && a.opacity == b.opacity &&
         a.specular == b.specular;
}

bool operator==(const TransferFunction& a, const TransferFunction& b) noexcept
{
  return a.points() == b.points();
}

} // namespace petrous::appearance
