#pragma once

#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SliceOverlay.h"

namespace petrous::presenters
{

/// Colour outside the MR if only the MR is shown.
constexpr std::array<std::uint8_t, 3> kOutsideMr{22, 26, 33};

/// Shares of a structure's colour, inside and at its outline.
constexpr float kStructureTint = 0.30F;
constexpr float kStructureOutline = 0.95F;

/// Grey of a value, 0 to 255. Minus infinity is black.
std::uint8_t greyOf(float value, const GreyWindow& window);

/// Blends a colour into a pixel by a fraction.
void blend(std::uint8_t* pixel, const std::array<float, 3>& color, float share);

/// Draws the MR, of which `mr` are the samples in the slice, over the grey CT in `pixels`.
void paintOverlay(const SliceOverlay& overlay, const SliceGeometry& slice, const PlaneSamples& mr,
                  SlicePixels& pixels);

/// Draws the CT's contours; `ct` are the CT's samples in the slice.
void paintEdges(const PlaneSamples& ct, const EdgeLevels& levels, double mmPerPixel,
                SlicePixels& pixels);

} // namespace petrous::presenters
