#include "AppearanceList.h"

#include <cmath>
#include <cstdio>

#include "CaseJson.h"
#include "Numbers.h"
#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/StructurePresets.h"
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

std::string yielding(const StructureAppearance& look)
{
  return look.stiffness > 0.0 ? ", " + nlohmann::json(look.stiffness).dump() + " N/mm" : "";
}

std::string warned(const StructureAppearance& look)
{
  return look.warning > 0.0 ? ", warned of at " + fixed(look.warning, 1) + " mm" : "";
}

std::string drilledAs(const StructureAppearance& look)
{
  return look.tissue.empty() ? "" : ", drilled as " + look.tissue;
}

std::string describe(const StructureAppearance& look, const volume::IntensityScale& scale)
{
  return look.preset + " " + hex(look.color) + ", " + appearance::flagsOf(look) +
         (look.solid ? "" : ", a lumen") + drilledAs(look) + yielding(look) + warned(look) +
         ", opacity " + fixed(static_cast<double>(look.opacity), 2) + ", " + valuesOf(look, scale) +
         (look.sourceImage.empty() ? "" : ", from " + look.sourceImage);
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
    context.print("  " + name + " (" + kind + "): " + describe(look, scale));
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
    context.print("  " + look.preset + ": opacity " + fixed(static_cast<double>(look.opacity), 2) +
                  (look.solid ? "" : " (a lumen)") + drilledAs(look) + yielding(look) +
                  warned(look) + ", " + valuesOf(look, {}));
  }
  context.printJson({{"presets", std::move(presets)}});
}

} // namespace petrous::cli
