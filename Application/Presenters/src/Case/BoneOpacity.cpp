#include "petrous/Presenters/BoneOpacity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Appearance/StructurePresets.h"

namespace petrous::presenters
{

appearance::StructureAppearance withOpacity(const appearance::StructureAppearance& bone,
                                            double opacity)
{
  opacity = std::clamp(opacity, 0.0, 1.0);
  appearance::StructureAppearance look = bone;
  const bool own = look.transfer && !look.relative;
  if (!own)
  {
    const auto presets = appearance::StructurePresets::builtIn();
    const appearance::StructureAppearance preset =
        presets.preset(opacity < 1.0 ? "bone-translucent" : "bone");
    applyPreset(look, preset);
    if (bone.color != look.color)
      setColor(look, bone.color);
    if (opacity < 1.0 && look.transfer)
    {
      auto points = look.transfer->points();
      for (appearance::ControlPoint& point : points)
        point.opacity =
            static_cast<float>(1.0 - std::pow(1.0 - static_cast<double>(point.opacity),
                                              opacity / static_cast<double>(preset.opacity)));
      look.transfer = appearance::TransferFunction(std::move(points));
    }
  }
  look.opacity = static_cast<float>(opacity);
  return look;
}

} // namespace petrous::presenters
