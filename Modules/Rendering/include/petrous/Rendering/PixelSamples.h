#pragma once

#include <array>

namespace petrous::rendering
{

constexpr int kPixelSamples = 16;

/// Where within a pixel the n-th of kPixelSamples rays goes: right and down of its centre, pixels,
/// within +-0.5. A rank-1 lattice, so that no two share a row or a column of the pixel's 16; each
/// two in turn are opposite each other, so that the mean of an even number of them is the centre.
constexpr std::array<double, 2> pixelSample(int n)
{
  constexpr int kPairs[] = {1, 5, 3, 7, 0, 4, 2, 6};
  constexpr int kStep = 5; // the shortest distance of two is then 3.2 / 16
  const int first = kPairs[n / 2 % 8];
  const int k = n % 2 == 0 ? first : kPixelSamples - 1 - first;
  const auto at = [](int cell) { return (cell + 0.5) / kPixelSamples - 0.5; };
  return {at(k), at((kStep * k + (kStep - 1) / 2) % kPixelSamples)};
}

/// Corner of a cube in whose direction the n-th sample takes the CT's slope aside of its surface
/// (optics::asideOf): each four in turn are the corners of a tetrahedron, whose mean is zero.
constexpr std::array<double, 3> sampleCorner(int n)
{
  const auto sign = [](bool plus) { return plus ? 1.0 : -1.0; };
  return {sign(n % 2 == 1), sign(n / 2 % 2 == 1), sign(n % 4 == 0 || n % 4 == 3)};
}

} // namespace petrous::rendering
