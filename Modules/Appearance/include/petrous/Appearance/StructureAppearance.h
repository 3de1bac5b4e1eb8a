#pragma once

#include <array>
#include <optional>
#include <string>

#include "petrous/Appearance/TransferFunction.h"

namespace petrous::appearance
{

/// How a structure is drawn, and what it is to hand and drill.
struct StructureAppearance
{
  std::string preset = "other";
  std::array<float, 3> color{0.4F, 0.72F, 0.45F}; ///< RGB, 0 to 1
  float opacity = 1.0F; ///< of its surface, 0 to 1; of a lumen, how much it tints the bone
  bool shown = true;
  bool touchable = true; ///< part of the tissue field of the hand
  bool drillable = true;
  bool solid = true;      ///< false: a lumen, coloured and named but no tissue
  double stiffness = 0.0; ///< N/mm, of the spring that it is under the hand; 0: rigid
  double warning = 0.0;   ///< mm from its surface: a burr that is nearer is warned of; 0: none
  std::string tissue; ///< what the drill meets (Resources/materials.json); empty: bone by density

  std::optional<TransferFunction> transfer; ///< absent: `color` at every intensity
  bool relative = false;   ///< the values of `transfer` are stretched to the case (onScale)
  std::string sourceImage; ///< the MR whose intensities `transfer` reads; empty: the CT
  float shininess = 18.0F; ///< exponent of the highlight, 1 to 200
  int priority = 90; ///< where structures overlap, the one with the lowest number has the voxel
};

constexpr float kSmallestShininess = 1.0F;
constexpr float kLargestShininess = 200.0F;
constexpr double kSoftest = 0.001; ///< N/mm
constexpr double kStiffest = 100.0;
constexpr double kFarthestWarning = 50.0; ///< mm

/// Throws InvalidParameter unless the stiffness is 0 (rigid) or lies within kSoftest to kStiffest.
void setStiffness(StructureAppearance& look, double newtonPerMillimetre);

/// Throws InvalidParameter unless the distance lies within 0 (no warning) to kFarthestWarning.
void setWarning(StructureAppearance& look, double millimetres);

/// Sets shown, touchable and drillable from a comma-separated list of the flags that hold, e.g.
/// "shown,drillable"; "none" clears all. Throws InvalidParameter naming an unknown flag.
void setFlags(StructureAppearance& look, const std::string& flags);

/// The flags that hold, as `setFlags` takes them.
std::string flagsOf(const StructureAppearance& look);

/// Gives the look another colour; its transfer function takes that colour too and keeps how bright
/// each of its points is beside the look's colour. Throws InvalidParameter outside 0 to 1.
void setColor(StructureAppearance& look, const std::array<float, 3>& color);

/// Takes over how `preset` looks, whether it is a lumen, how it yields, its tissue, its warning
/// distance and its priority; flags and the image that is read stay.
void applyPreset(StructureAppearance& look, const StructureAppearance& preset);

} // namespace petrous::appearance
