#pragma once

#include "petrous/Appearance/StructureAppearance.h"

namespace petrous::presenters
{

/// Bone from opaque (1) to transparent (0), interior and surface together, so that one slider leads
/// from the preset "bone" via "bone-translucent" to invisible.
///
/// The surface gets `opacity`. Below 1 the interior is that of "bone-translucent", its density
/// scaled by the ratio of the surface's opacity to that preset's: 1 - (1 - o)^(opacity / preset's).
/// A user-defined transfer function is kept; only the surface changes then. Colour and flags are
/// kept.
appearance::StructureAppearance withOpacity(const appearance::StructureAppearance& bone,
                                            double opacity);

} // namespace petrous::presenters
