#pragma once

#include "petrous/Appearance/TransferFunction.h"

namespace petrous::appearance
{

/// Which image a tissue's transfer function reads.
enum class IntensitySource
{
  Ct,
  Second, ///< a registered second image, e.g. MR
  Third   ///< and another one beside it
};

/// Rendering parameters of one tissue: its surface, and the volume visible through it.
struct Material
{
  TransferFunction transfer = TransferFunction::constant({0.91F, 0.85F, 0.72F}, 1.0F);
  IntensitySource source = IntensitySource::Ct;
  float surfaceOpacity = 1.0F; ///< of the surface itself, 0 to 1; below 1 the interior is visible
  float shininess = 18.0F;     ///< specular exponent
  bool lumen = false;          ///< not rendered itself: it tints the bone that bounds it
};

} // namespace petrous::appearance
