#pragma once

#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SliceOverlay.h"

namespace petrous::presenters
{

/// Outside an MR, where it alone would be seen.
constexpr std::array<std::uint8_t, 3> kOutsideMr{22, 26, 33};

/// Grey of a value, 0 to 255. Minus infinity is black.
std::uint8_t greyOf(float value, const GreyWindow& window);

/// Mixes a share of a colour into a pixel.
void blend(std::uint8_t* pixel, const std::array<float, 3>& color, float share);

/// Lays the MR over the grey CT that `pixels` holds.
void paintOverlay(const SliceOverlay& overlay, const SliceGeometry& slice, SlicePixels& pixels);

/// Draws the contours of the CT, of which `ct` are the slice's samples.
void paintEdges(const PlaneSamples& ct, const EdgeLevels& levels, double mmPerPixel,
                SlicePixels& pixels);

} // namespace petrous::presenters
