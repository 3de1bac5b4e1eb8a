#pragma once

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

} // namespace petrous::appearance
