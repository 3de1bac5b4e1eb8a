#pragma once

#include "petrous/Appearance/StructureAppearance.h"

namespace petrous::presenters
{

/// Bone from opaque (1) to clear (0), inside and surface together, so that one slider leads from
/// the preset "bone" over "bone-translucent" to nothing.
///
/// The surface gets `opacity`. Below 1 the inside is that of "bone-translucent", as many times
/// denser or thinner as the surface is than that preset's: 1 - (1 - o)^(opacity / preset's). Values
/// of a person's own transfer function stay; only the surface changes then. Colour and flags stay.
appearance::StructureAppearance withOpacity(const appearance::StructureAppearance& bone, double opacity);

} // namespace petrous::presenters
