#pragma once

#include <array>

namespace petrous::rendering
{

/// Colour map of bone thickness, from 0 to the maximum shown, linear in between: blue where bone is
/// thinnest, as a sinus shines through its last bone, over red to yellow. Lightness in CIELAB
/// increases uniformly from 28 to 88, so the order is also visible to colour-blind observers.
constexpr std::array<std::array<float, 3>, 9> kThicknessColors{{{0.131F, 0.196F, 0.662F},
                                                                {0.504F, 0.152F, 0.643F},
                                                                {0.723F, 0.098F, 0.590F},
                                                                {0.885F, 0.128F, 0.514F},
                                                                {0.997F, 0.253F, 0.430F},
                                                                {0.999F, 0.456F, 0.394F},
                                                                {0.997F, 0.603F, 0.400F},
                                                                {0.998F, 0.731F, 0.428F},
                                                                {1.000F, 0.853F, 0.395F}}};

/// RGB, 0 to 1. `share`: thickness relative to the maximum shown, clamped to 0 to 1.
std::array<double, 3> thicknessColor(double share);

} // namespace petrous::rendering
