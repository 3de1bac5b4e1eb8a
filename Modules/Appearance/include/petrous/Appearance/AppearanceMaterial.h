#pragma once

#include <optional>

#include "petrous/Appearance/Material.h"
#include "petrous/Appearance/StructureAppearance.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::appearance
{

/// Preset values refer to a calibrated CT, where bone begins at 300 HU and is dense at 1800 HU.
/// They are mapped linearly to the bone range of the case's image, so that bone of a cone-beam or
/// micro-CT gets the same appearance:
///
///   v' = iso + (v - 300) (dense - iso) / (1800 - 300)
///
/// If dense <= iso (an iso value set by the user), dense = iso + 1500 is used.
double onScale(double value, const volume::IntensityScale& scale) noexcept;
TransferFunction onScale(const TransferFunction& transfer, const volume::IntensityScale& scale);

/// Opacity of 1 mm inside a structure that has no transfer function and an opaque surface; scaled
/// by the opacity of the surface.
constexpr float kPlainOpacity = 0.95F;

/// The material of an appearance. User-defined values are used unchanged, preset values are mapped
/// to `scale`. Presets are not defined for MR: with an MR as source image, a preset's material is a
/// constant colour that reads no image.
Material materialOf(const StructureAppearance& look, const volume::IntensityScale& scale = {});

/// The material of a lumen: that of the surrounding bone, tinted by the lumen's opacity, so that
/// its wall remains as opaque as bone.
Material lumenMaterial(const StructureAppearance& look, const Material& bone,
                       const volume::IntensityScale& scale = {});

/// The material of what is neither bone nor a structure; `shown` does not count.
///
/// The opacity of the look is a factor of that of its transfer function, as there is no surface.
/// Below its first point it is transparent, falling to it over a twentieth of the function's width,
/// so that air is not drawn. `scale`: as for materialOf, but Hounsfield units where the image has
/// them, whatever the threshold of bone.
///
/// nullopt, as there is nothing to draw: no transfer function or one with a single point, which
/// would fill air too; a preset's over an MR; transparent at every intensity.
std::optional<Material> softTissueMaterial(const StructureAppearance& look,
                                           const volume::IntensityScale& scale = {});

/// Soft tissue in an MR of its own values: black air is transparent, and a ramp of grey leads to an
/// opacity of 0.1 of 1 mm for bright tissue. `scale`: of volume::suggestMrScale.
TransferFunction softTissueOfMr(const volume::IntensityScale& scale);

} // namespace petrous::appearance
