#pragma once

#include <array>
#include <optional>
#include <string>

#include "petrous/Appearance/TransferFunction.h"

namespace petrous::appearance
{

/// How a structure is rendered, and its behaviour in haptics and drilling. Ranges, names and texts
/// of the members: StructureProperties.h.
struct StructureAppearance
{
  std::string preset = "other";
  std::array<float, 3> color{0.4F, 0.72F, 0.45F}; ///< RGB, 0 to 1
  float opacity = 1.0F; ///< of its surface, 0 to 1; of a lumen, how strongly it tints the bone
  bool shown = true;
  bool touchable = true; ///< part of the haptic tissue field
  bool drillable = true;
  bool solid = true;      ///< false: a lumen, coloured and named but not tissue
  double stiffness = 0.0; ///< N/mm, spring stiffness in haptic contact; 0: rigid
  double warning = 0.0;   ///< mm from its surface within which a burr triggers a warning; 0: none
  std::string tissue; ///< material for drilling (Resources/materials.json); empty: bone by density

  std::optional<TransferFunction> transfer; ///< absent: `color` at every intensity
  bool relative = false;   ///< values of `transfer` are mapped to the case's scale (onScale)
  std::string sourceImage; ///< the MR whose intensities `transfer` reads; empty: the CT
  float shininess = 18.0F; ///< specular exponent
  int priority = 90;       ///< where structures overlap, the lowest number owns the voxel
};

/// Sets shown, touchable and drillable from a comma-separated list of the flags that are set, e.g.
/// "shown,drillable"; "none" clears all. Throws InvalidParameter naming an unknown flag.
void setFlags(StructureAppearance& look, const std::string& flags);

/// Sets or clears single flags from a comma-separated list, e.g. "+touchable,-drillable"; the
/// others stay. A list without signs is one of `setFlags`. Throws InvalidParameter naming an
/// unknown flag, or if some have a sign and others do not.
void changeFlags(StructureAppearance& look, const std::string& flags);

/// The flags that are set, in the format of `setFlags`.
std::string flagsOf(const StructureAppearance& look);

/// Changes the colour, also of the transfer function, whose points keep their brightness relative
/// to the appearance's colour; the colour it has already changes nothing. Throws InvalidParameter
/// outside 0 to 1.
void setColor(StructureAppearance& look, const std::array<float, 3>& color);

/// Makes it that of what is air to haptics and drilling: neither touchable nor drillable, without
/// material, stiffness and warning distance.
void makeUntouchable(StructureAppearance& look);

/// Copies from `preset` its rendering parameters, whether it is a lumen, stiffness, tissue, warning
/// distance and priority; flags and source image are kept.
void applyPreset(StructureAppearance& look, const StructureAppearance& preset);

/// As above, for soft tissue, which stays air to haptics and drilling. It reads the primary image
/// if the preset is made for CT, or has values of one (OwnPresets).
void applySoftTissuePreset(StructureAppearance& look, const StructureAppearance& preset);

} // namespace petrous::appearance
