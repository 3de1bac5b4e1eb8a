#pragma once

#include "petrous/Appearance/TransferFunction.h"

namespace petrous::appearance
{

/// Which image a tissue's transfer function reads.
enum class IntensitySource
{
  Ct,
  Second ///< a registered second image, e.g. MR
};

/// How one tissue of the volume is drawn: its surface and what shines through it.
struct Material
{
  TransferFunction transfer = TransferFunction::constant({0.91F, 0.85F, 0.72F}, 1.0F);
  IntensitySource source = IntensitySource::Ct;
  float surfaceOpacity = 1.0F; ///< of the surface itself, 0 to 1; below 1 the inside shows
  float shininess = 18.0F;     ///< exponent of the highlight
  bool lumen = false; ///< no tissue of its own: it lends its look to the bone that bounds it
};

} // namespace petrous::appearance
