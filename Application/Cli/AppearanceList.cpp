#include "AppearanceList.h"

#include <cmath>
#include <cstdio>

#include "CaseJson.h"
#include "Numbers.h"
#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::cli
{

namespace
{

using appearance::StructureAppearance;

/// The control points in the intensities of an image.
std::string valuesOf(const StructureAppearance& look, const volume::IntensityScale& scale)
{
  if (!look.transfer)
    return "one colour";
  const auto transfer = look.relative ? onScale(*look.transfer, scale) : *look.transfer;
  const auto& points = transfer.points();
  const std::string from = fixed(points.front().value, 0);
  return (look.relative ? "" : "own values, ") +
         (points.size() == 1 ? "1 point at " + from
                             : std::to_string(points.size()) + " points from " + from + " to " +
                                   fixed(points.back().value, 0));
}

std::string hex(const std::array<float, 3>& color)
{
  char text[8];
  const auto byte = [&color](std::size_t c)
  { return static_cast<unsigned>(std::lround(color[c] * 255.0F)) & 0xFFU; };
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", byte(0), byte(1), byte(2));
  return text;
}

// Each property that has a phrase, unless it is off, and the transfer function.
std::string describe(const StructureAppearance& look, const volume::IntensityScale& scale)
{
  std::string text = look.solid ? "" : ", a lumen";
  for (const appearance::StructureProperty& property : appearance::kStructureProperties)
    if (std::holds_alternative<appearance::StructureProperty::Transfer>(property.member))
      text += ", " + valuesOf(look, scale);
    else if (property.phrase && !appearance::isOff(look, property))
    {
      const std::string unit = property.range.unit;
      text += std::string(", ") + property.phrase + toString(look, property) +
              (unit.empty() ? "" : " " + unit);
    }
  return text;
}

} // namespace

void listAppearance(const Context& context, const scene::Case& value)
{
  const auto entry = [&context, scale = value.intensityScale()](const std::string& name,
                                                                const std::string& kind,
                                                                const StructureAppearance& look)
  {
    nlohmann::json j = lookJson(look);
    j["name"] = name;
    j["kind"] = kind;
    context.print("  " + name + " (" + kind + "): " + look.preset + " " + hex(look.color) + ", " +
                  appearance::flagsOf(look) + describe(look, scale));
    return j;
  };
  presenters::IntensityDisplay display = presenters::displayOf(value);
  display.decimals = std::max(display.decimals, 1);
  context.print("surface at " + display.text(value.iso) + ", dense bone at " +
                display.text(value.denseBone) +
                (display.hounsfield ? "" : " (not in Hounsfield units)"));
  nlohmann::json bone = entry("ct", "bone", value.boneLook);
  nlohmann::json parts = nlohmann::json::array();
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      parts.push_back(entry(structure.name, "structure", structure.look));
  for (const auto& mesh : value.meshes)
    parts.push_back(entry(mesh.name, "mesh", mesh.look));
  context.printJson({{"case", value.name},
                     {"iso_hu", value.iso},
                     {"dense_bone_hu", value.denseBone},
                     {"hounsfield", display.hounsfield},
                     {"bone", std::move(bone)},
                     {"parts", std::move(parts)}});
}

void listPresets(const Context& context)
{
  nlohmann::json presets = nlohmann::json::array();
  for (const StructureAppearance& look : appearance::StructurePresets::builtIn().all())
  {
    nlohmann::json j = lookJson(look);
    j.erase("preset");
    j.erase("flags");
    j.erase("source");
    j["name"] = look.preset;
    presets.push_back(std::move(j));
    context.print("  " + look.preset + ": " + hex(look.color) + describe(look, {}));
  }
  context.printJson({{"presets", std::move(presets)}});
}

} // namespace petrous::cli
