#pragma once

#include "petrous/Appearance/Material.h"
#include "petrous/Appearance/StructureAppearance.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::appearance
{

/// The values of presets are made for a calibrated CT, whose bone begins at 300 HU and is dense at
/// 1800 HU. They are carried over linearly to where bone lies in the case's image, so that bone of
/// a cone-beam or micro-CT looks the same at once:
///
///   v' = iso + (v - 300) (dense - iso) / (1800 - 300)
///
/// Where dense is not above iso (a surface that somebody chose), iso + 1500 is taken for it.
double onScale(double value, const volume::IntensityScale& scale) noexcept;
TransferFunction onScale(const TransferFunction& transfer, const volume::IntensityScale& scale);

/// Opacity of 1 mm inside a structure that has no transfer function and an opaque surface; with the
/// opacity of the surface it becomes less in proportion.
constexpr float kPlainOpacity = 0.95F;

/// The material of a look. Values given by a person are taken as they are, those of a preset on
/// `scale`. A preset says nothing of MR: where such a look is to read one, it is drawn in one
/// colour and reads nothing.
Material materialOf(const StructureAppearance& look, const volume::IntensityScale& scale = {});

/// The material of a lumen: that of the bone around it, tinted by the lumen's opacity, so that its
/// wall stays as opaque as bone is.
Material lumenMaterial(const StructureAppearance& look, const Material& bone,
                       const volume::IntensityScale& scale = {});

} // namespace petrous::appearance
