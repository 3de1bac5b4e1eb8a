#pragma once

#include <array>
#include <string>

namespace petrous::appearance
{

/// How a structure is drawn, and what it is to hand and drill.
struct StructureLook
{
  std::string preset = "other";
  std::array<float, 3> color{0.4F, 0.72F, 0.45F}; ///< RGB, 0 to 1
  float opacity = 1.0F;                           ///< 0 to 1
  bool shown = true;
  bool touchable = true; ///< part of the tissue field of the hand
  bool drillable = true;
  bool solid = true; ///< false: a lumen, coloured and named but no tissue
};

/// Sets shown, touchable and drillable from a comma-separated list of the flags that hold, e.g.
/// "shown,drillable"; "none" clears all. Throws InvalidParameter naming an unknown flag.
void setFlags(StructureLook& look, const std::string& flags);

/// The flags that hold, as `setFlags` takes them.
std::string flagsOf(const StructureLook& look);

} // namespace petrous::appearance
