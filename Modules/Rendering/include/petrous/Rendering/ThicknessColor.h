#pragma once

#include <array>

namespace petrous::rendering
{

/// Colours of bone by how thick it is, from 0 to the farthest that is shown, linear between these:
/// blue where it is thinnest, as a surgeon sees a sinus through its last bone, over red to yellow.
/// In CIELAB their lightness goes up by even steps from 28 to 88, so more is lighter to every eye.
constexpr std::array<std::array<float, 3>, 9> kThicknessColors{{{0.131F, 0.196F, 0.662F},
                                                                {0.504F, 0.152F, 0.643F},
                                                                {0.723F, 0.098F, 0.590F},
                                                                {0.885F, 0.128F, 0.514F},
                                                                {0.997F, 0.253F, 0.430F},
                                                                {0.999F, 0.456F, 0.394F},
                                                                {0.997F, 0.603F, 0.400F},
                                                                {0.998F, 0.731F, 0.428F},
                                                                {1.000F, 0.853F, 0.395F}}};

/// RGB, 0 to 1. `share` of the farthest, held within 0 to 1.
std::array<double, 3> thicknessColor(double share);

} // namespace petrous::rendering
