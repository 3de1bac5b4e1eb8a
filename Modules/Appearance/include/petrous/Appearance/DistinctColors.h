#pragma once

#include <array>
#include <vector>

namespace petrous::appearance
{

/// A colour for a structure whose name matches no preset: the member of a fixed set farthest from
/// all `taken` colours, from bone, from grey, and from the colours of nerves, arteries and veins.
/// Repeated calls, each with the results so far, give a palette. Deterministic.
///
/// The distance of two colours is the minimum over four kinds of vision: normal, and without long,
/// middle or short wavelength cones (protan, deutan, tritan: matrices of severity 1 in Machado,
/// Oliveira and Fernandes, IEEE Trans. Visualization and Computer Graphics 15(6), 2009, doi
/// 10.1109/TVCG.2009.113). Each is the Euclidean distance in Oklab (Ottosson 2020), weighted by how
/// common that vision is: 1 for normal, 1.6, 1.6 and 2.5. The weights, and the set (steps of 1/8 in
/// each sRGB channel, neither dark nor pale), are our choice.
///
/// Colours are sRGB, 0 to 1.
std::array<float, 3> distinctColor(const std::vector<std::array<float, 3>>& taken);

} // namespace petrous::appearance
