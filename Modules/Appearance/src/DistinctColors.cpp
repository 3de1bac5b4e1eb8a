#include "petrous/Appearance/DistinctColors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "petrous/Appearance/StructurePresets.h"

namespace petrous::appearance
{

namespace
{

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;
using Color = std::array<float, 3>;

constexpr std::size_t kSights = 4; // normal, protan, deutan, tritan
constexpr std::array<double, kSights> kWeights{1.0, 1.6, 1.6, 2.5};

// Linear sRGB as perceived; severity 1 in the supplement of Machado et al.
constexpr std::array<Matrix, kSights> kSight{
    Matrix{Triple{1.0, 0.0, 0.0}, Triple{0.0, 1.0, 0.0}, Triple{0.0, 0.0, 1.0}},
    Matrix{Triple{0.152286, 1.052583, -0.204868}, Triple{0.114503, 0.786281, 0.099216},
           Triple{-0.003882, -0.048116, 1.051998}},
    Matrix{Triple{0.367322, 0.860646, -0.227968}, Triple{0.280085, 0.672501, 0.047413},
           Triple{-0.011820, 0.042940, 0.968881}},
    Matrix{Triple{1.255528, -0.076749, -0.178779}, Triple{-0.078411, 0.930809, 0.147602},
           Triple{0.004733, 0.691367, 0.303900}}};

// Linear sRGB to cone responses, and their cube roots to Oklab (Ottosson 2020).
constexpr Matrix kCones{Triple{0.4122214708, 0.5363325363, 0.0514459929},
                        Triple{0.2119034982, 0.6806995451, 0.1073969566},
                        Triple{0.0883024619, 0.2817188376, 0.6299787005}};
constexpr Matrix kLab{Triple{0.2104542553, 0.7936177850, -0.0040720468},
                      Triple{1.9779984951, -2.4285922050, 0.4505937099},
                      Triple{0.0259040371, 0.7827717662, -0.8086757660}};

Triple times(const Matrix& m, const Triple& v)
{
  Triple result{};
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

double linear(double srgb)
{
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

using Seen = std::array<Triple, kSights>; // in Oklab

Seen seen(const Color& color)
{
  Triple light{};
  for (std::size_t n = 0; n < 3; ++n)
    light[n] = linear(std::clamp(static_cast<double>(color[n]), 0.0, 1.0));
  Seen result{};
  for (std::size_t sight = 0; sight < kSights; ++sight)
  {
    Triple cones = times(kSight[sight], light);
    for (double& value : cones)
      value = std::clamp(value, 0.0, 1.0);
    cones = times(kCones, cones);
    for (double& value : cones)
      value = std::cbrt(value);
    result[sight] = times(kLab, cones);
  }
  return result;
}

double distance(const Seen& a, const Seen& b)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t sight = 0; sight < kSights; ++sight)
  {
    const double x = a[sight][0] - b[sight][0];
    const double y = a[sight][1] - b[sight][1];
    const double z = a[sight][2] - b[sight][2];
    least = std::min(least, kWeights[sight] * std::sqrt(x * x + y * y + z * z));
  }
  return least;
}

// Distinguishable from black slices and from bone, and sufficiently saturated.
bool isOffered(const Seen& color)
{
  const Triple& lab = color.front();
  return lab[0] > 0.5 && lab[0] < 0.92 && std::hypot(lab[1], lab[2]) > 0.06;
}

} // namespace

std::array<float, 3> distinctColor(const std::vector<std::array<float, 3>>& taken)
{
  const StructurePresets presets = StructurePresets::builtIn();
  std::vector<Seen> others{seen({0.5F, 0.5F, 0.5F})};
  for (const char* name : {"bone", "nerve", "artery", "vein"})
    others.push_back(seen(presets.preset(name).color));
  for (const Color& color : taken)
    others.push_back(seen(color));

  constexpr int kSteps = 8;
  Color best{};
  double farthest = -1.0;
  for (int r = 0; r <= kSteps; ++r)
    for (int g = 0; g <= kSteps; ++g)
      for (int b = 0; b <= kSteps; ++b)
      {
        const Color color{static_cast<float>(r) / kSteps, static_cast<float>(g) / kSteps,
                          static_cast<float>(b) / kSteps};
        const Seen candidate = seen(color);
        if (!isOffered(candidate))
          continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Seen& other : others)
          nearest = std::min(nearest, distance(candidate, other));
        if (nearest > farthest)
        {
          farthest = nearest;
          best = color;
        }
      }
  return best;
}

} // namespace petrous::appearance
