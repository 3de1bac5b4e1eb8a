#include "petrous/Appearance/StructureAppearance.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "petrous/Core/Error.h"

namespace petrous::appearance
{

void setFlags(StructureAppearance& look, const std::string& flags)
{
  StructureAppearance result = look;
  result.shown = result.touchable = result.drillable = false;
  std::istringstream list(flags);
  for (std::string flag; std::getline(list, flag, ',');)
  {
    if (flag == "shown")
      result.shown = true;
    else if (flag == "touchable")
      result.touchable = true;
    else if (flag == "drillable")
      result.drillable = true;
    else if (flag != "none")
      throw core::InvalidParameter("flag '" + flag +
                                   "' is unknown; use shown, touchable, drillable or none");
  }
  look = result;
}

std::string flagsOf(const StructureAppearance& look)
{
  std::string flags;
  const auto add = [&flags](bool holds, const char* name)
  {
    if (holds)
      flags += (flags.empty() ? "" : ",") + std::string(name);
  };
  add(look.shown, "shown");
  add(look.touchable, "touchable");
  add(look.drillable, "drillable");
  return flags.empty() ? "none" : flags;
}

void setStiffness(StructureAppearance& look, double newtonPerMillimetre)
{
  if (newtonPerMillimetre != 0.0 &&
      !(newtonPerMillimetre >= kSoftest && newtonPerMillimetre <= kStiffest))
    throw core::InvalidParameter("the stiffness of a soft structure must lie within 0.001 to 100 "
                                 "N/mm; 0 is rigid");
  look.stiffness = newtonPerMillimetre;
}

void setWarning(StructureAppearance& look, double millimetres)
{
  if (!(millimetres >= 0.0 && millimetres <= kFarthestWarning))
    throw core::InvalidParameter("the warning distance of a structure must lie within 0 to 50 mm; "
                                 "0 is none");
  look.warning = millimetres;
}

void setColor(StructureAppearance& look, const std::array<float, 3>& color)
{
  if (std::any_of(color.begin(), color.end(), [](float x) { return !(x >= 0.0F && x <= 1.0F); }))
    throw core::InvalidParameter("colour: red, green and blue must lie in 0 to 1");
  if (look.transfer)
  {
    const auto brightness = [](const std::array<float, 3>& c)
    { return 0.299F * c[0] + 0.587F * c[1] + 0.114F * c[2]; };
    const float before = brightness(look.color);
    std::vector<ControlPoint> points = look.transfer->points();
    for (ControlPoint& point : points)
    {
      const float share = before > 0.0F ? brightness(point.color) / before : 1.0F;
      for (std::size_t c = 0; c < 3; ++c)
        point.color[c] = std::min(color[c] * share, 1.0F);
    }
    look.transfer = TransferFunction(std::move(points));
  }
  look.color = color;
}

void applyPreset(StructureAppearance& look, const StructureAppearance& preset)
{
  StructureAppearance result = preset;
  result.shown = look.shown;
  result.touchable = look.touchable;
  result.drillable = look.drillable;
  result.sourceImage = look.sourceImage;
  look = std::move(result);
}

} // namespace petrous::appearance
