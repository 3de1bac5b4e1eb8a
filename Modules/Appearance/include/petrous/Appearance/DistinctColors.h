#pragma once

#include <array>
#include <vector>

namespace petrous::appearance
{

/// A colour for a structure whose name matches no preset: of a palette of 64 the one farthest from
/// all `taken` colours, from bone, black, grey, and from the colours of nerves, arteries and veins;
/// where those are used up, of a grid in steps of 1/8. Repeated calls, each with the results so
/// far, give a palette. Deterministic.
///
/// The distance of two colours is the minimum over four kinds of vision: normal, and without long,
/// middle or short wavelength cones (protan, deutan, tritan: matrices of severity 1 in Machado,
/// Oliveira and Fernandes, IEEE Trans. Visualization and Computer Graphics 15(6), 2009, doi
/// 10.1109/TVCG.2009.113). Each is CIEDE2000 (ISO/CIE 11664-6), weighted 1 for normal vision
/// and 1.4 for the others, our choice, so that it is larger for normal vision. Between any two of
/// the first 12, 24 and 60 it is at least 14.8, 10.3 and 6.4 for normal vision, and 9.5, 6.5
/// and 4.1 for the others, also by the model of Vienot, Brettel and Mollon (1999).
///
/// Colours are sRGB, 0 to 1.
std::array<float, 3> distinctColor(const std::vector<std::array<float, 3>>& taken);

} // namespace petrous::appearance
