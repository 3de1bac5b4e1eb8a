#pragma once

#include <array>
#include <vector>

namespace petrous::appearance
{

/// A colour for a structure whose name asks for none: of a fixed set the one that is farthest from
/// all `taken`, from bone, grey, and from what nerves, arteries and veins are drawn in. Called
/// again with each colour it gave, it makes a palette; the same colours give the same answer.
///
/// Far as the nearest of four eyes sees it: with normal sight, and without long, middle or short
/// wave cones (protan, deutan, tritan: matrices of severity 1 in Machado, Oliveira and Fernandes,
/// IEEE Trans. Visualization and Computer Graphics 15(6), 2009, doi 10.1109/TVCG.2009.113).
/// Distance is Euclidean in Oklab (Ottosson 2020), weighted by how common that sight is: 1 for
/// normal, 1.6, 1.6 and 2.5. The weights, and the set (steps of 1/8 in each channel of sRGB,
/// neither dark nor pale), are our choice.
///
/// Colours are sRGB, 0 to 1.
std::array<float, 3> distinctColor(const std::vector<std::array<float, 3>>& taken);

} // namespace petrous::appearance
