#include "petrous/Appearance/DistinctColors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "petrous/Appearance/StructurePresets.h"

namespace petrous::appearance
{

namespace
{

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;
using Color = std::array<float, 3>;
using Seen = DistinctColors::Seen;

constexpr std::size_t kSights = std::tuple_size_v<Seen>; // normal, protan, deutan, tritan
constexpr double kNoticed = 2.0;   // a palette of which this much is left is used up
constexpr int kSteps = 8;          // of the grid that follows it
constexpr double kDichromat = 1.4; // weight of differences that dichromats see

// Linear sRGB as perceived; severity 1 in the supplement of Machado et al.
constexpr std::array<Matrix, kSights> kSight{
    Matrix{Triple{1.0, 0.0, 0.0}, Triple{0.0, 1.0, 0.0}, Triple{0.0, 0.0, 1.0}},
    Matrix{Triple{0.152286, 1.052583, -0.204868}, Triple{0.114503, 0.786281, 0.099216},
           Triple{-0.003882, -0.048116, 1.051998}},
    Matrix{Triple{0.367322, 0.860646, -0.227968}, Triple{0.280085, 0.672501, 0.047413},
           Triple{-0.011820, 0.042940, 0.968881}},
    Matrix{Triple{1.255528, -0.076749, -0.178779}, Triple{-0.078411, 0.930809, 0.147602},
           Triple{0.004733, 0.691367, 0.303900}}};

// Linear sRGB to XYZ, and the white of D65 (IEC 61966-2-1).
constexpr Matrix kXyz{Triple{0.4124564, 0.3575761, 0.1804375},
                      Triple{0.2126729, 0.7151522, 0.0721750},
                      Triple{0.0193339, 0.1191920, 0.9503041}};
constexpr Triple kWhite{0.95047, 1.0, 1.08883};

// Sixteenths of red, green and blue, each as far as possible from those before it, from bone,
// nerve, artery, vein, black and grey, by `distance` below: chosen one after the other from all of
// L* 35 to 93 and a chroma above 15.
constexpr unsigned char kPalette[][3] = {
    {0, 14, 16},  {13, 9, 4},   {8, 4, 5},    {11, 7, 16},  {7, 11, 9},  {5, 8, 5},    {10, 7, 10},
    {13, 10, 12}, {5, 5, 7},    {12, 15, 15}, {11, 12, 8},  {14, 5, 6},  {10, 9, 13},  {1, 7, 0},
    {5, 0, 16},   {12, 12, 0},  {11, 2, 9},   {7, 5, 16},   {8, 6, 7},   {16, 10, 11}, {8, 11, 16},
    {0, 10, 7},   {6, 6, 4},    {12, 7, 3},   {9, 13, 12},  {15, 15, 0}, {9, 7, 12},   {12, 8, 10},
    {13, 15, 10}, {10, 11, 14}, {8, 11, 6},   {16, 12, 13}, {9, 13, 6},  {1, 7, 10},   {10, 1, 6},
    {14, 12, 14}, {9, 6, 3},    {9, 16, 13},  {15, 8, 9},   {0, 11, 11}, {10, 5, 6},   {13, 3, 5},
    {13, 3, 9},   {3, 4, 13},   {14, 12, 10}, {0, 9, 14},   {15, 13, 2}, {14, 7, 0},   {0, 8, 8},
    {11, 9, 8},   {9, 4, 3},    {13, 13, 8},  {5, 9, 11},   {8, 6, 13},  {0, 9, 7},    {7, 9, 4},
    {14, 2, 0},   {15, 14, 16}, {13, 6, 9},   {13, 6, 14},  {5, 6, 8},   {10, 6, 8},   {12, 11, 4},
    {4, 10, 11}};

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

Seen seen(const Color& color)
{
  Triple light{};
  for (std::size_t n = 0; n < 3; ++n)
    light[n] = linear(std::clamp(static_cast<double>(color[n]), 0.0, 1.0));
  Seen result{};
  for (std::size_t sight = 0; sight < kSights; ++sight)
  {
    Triple rgb = times(kSight[sight], light);
    for (double& value : rgb)
      value = std::clamp(value, 0.0, 1.0);
    Triple f = times(kXyz, rgb);
    for (std::size_t n = 0; n < 3; ++n)
    {
      const double t = f[n] / kWhite[n];
      f[n] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    }
    result[sight] = {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
  }
  return result;
}

// CIEDE2000 colour difference, all weights 1 (ISO/CIE 11664-6; Sharma, Wu and Dalal, Color Research
// and Application 30(1), 2005).
double difference(const Triple& a, const Triple& b)
{
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  const auto chromaTerm = [](double chroma)
  {
    const double power = std::pow(chroma, 7.0);
    return std::sqrt(power / (power + std::pow(25.0, 7.0)));
  };
  const double stretch =
      1.5 - 0.5 * chromaTerm(0.5 * (std::hypot(a[1], a[2]) + std::hypot(b[1], b[2])));
  const double chromaA = std::hypot(a[1] * stretch, a[2]);
  const double chromaB = std::hypot(b[1] * stretch, b[2]);
  const auto hueOf = [&](const Triple& lab) // degrees, 0 to 360
  {
    const double hue = std::atan2(lab[2], lab[1] * stretch) / kDegree;
    return hue < 0.0 ? hue + 360.0 : hue;
  };
  const double hueA = hueOf(a);
  const double hueB = hueOf(b);
  const bool isGrey = chromaA * chromaB == 0.0;
  double turn = isGrey ? 0.0 : hueB - hueA;
  double meanHue = isGrey ? hueA + hueB : 0.5 * (hueA + hueB);
  if (std::abs(turn) > 180.0)
  {
    turn += turn > 0.0 ? -360.0 : 360.0;
    meanHue += meanHue < 180.0 ? 180.0 : -180.0;
  }
  const double lightness = b[0] - a[0];
  const double chroma = chromaB - chromaA;
  const double hue = 2.0 * std::sqrt(chromaA * chromaB) * std::sin(0.5 * turn * kDegree);
  const double fromMiddle = std::pow(0.5 * (a[0] + b[0]) - 50.0, 2.0);
  const double meanChroma = 0.5 * (chromaA + chromaB);
  const double t = 1.0 - 0.17 * std::cos((meanHue - 30.0) * kDegree) +
                   0.24 * std::cos(2.0 * meanHue * kDegree) +
                   0.32 * std::cos((3.0 * meanHue + 6.0) * kDegree) -
                   0.20 * std::cos((4.0 * meanHue - 63.0) * kDegree);
  const double l = lightness / (1.0 + 0.015 * fromMiddle / std::sqrt(20.0 + fromMiddle));
  const double c = chroma / (1.0 + 0.045 * meanChroma);
  const double h = hue / (1.0 + 0.015 * meanChroma * t);
  const double rotation =
      -2.0 * chromaTerm(meanChroma) *
      std::sin(60.0 * kDegree * std::exp(-std::pow((meanHue - 275.0) / 25.0, 2.0)));
  return std::sqrt(std::max(0.0, l * l + c * c + h * h + rotation * c * h));
}

double distance(const Seen& a, const Seen& b)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t sight = 0; sight < kSights; ++sight)
    least = std::min(least, (sight == 0 ? 1.0 : kDichromat) * difference(a[sight], b[sight]));
  return least;
}

// Distinguishable from black slices, and sufficiently saturated.
bool isOffered(const Seen& color)
{
  const Triple& lab = color.front();
  return lab[0] > 35.0 && lab[0] < 93.0 && std::hypot(lab[1], lab[2]) > 15.0;
}

float part(int n, int of)
{
  return static_cast<float>(n) / static_cast<float>(of);
}

} // namespace

DistinctColors::DistinctColors(const std::vector<Color>& taken)
{
  const StructurePresets presets = StructurePresets::builtIn();
  m_taken = {seen({0.0F, 0.0F, 0.0F}), seen({0.5F, 0.5F, 0.5F})};
  for (const char* name : {"bone", "nerve", "artery", "vein"})
    m_taken.push_back(seen(presets.preset(name).color));
  for (const Color& color : taken)
    m_taken.push_back(seen(color));
  for (const auto& color : kPalette)
    offer({part(color[0], 16), part(color[1], 16), part(color[2], 16)});
}

void DistinctColors::offer(const Color& color)
{
  const Seen sights = seen(color);
  if (!isOffered(sights) ||
      std::any_of(m_offered.begin(), m_offered.end(),
                  [&color](const Offered& each) { return each.color == color; }))
    return;
  m_offered.push_back({color, sights, std::numeric_limits<double>::infinity(), 0});
  for (const Seen& taken : m_taken)
    m_offered.back().nearest = std::min(m_offered.back().nearest, distance(sights, taken));
}

void DistinctColors::take(const Color& color)
{
  m_taken.push_back(seen(color));
  for (Offered& each : m_offered)
    if (each.nearest > 0.0)
      each.nearest = std::min(each.nearest, distance(each.sights, m_taken.back()));
}

Color DistinctColors::next()
{
  const auto farthest = [this]
  {
    return std::max_element(m_offered.begin(), m_offered.end(),
                            [](const Offered& a, const Offered& b) {
                              return std::tie(a.nearest, b.given) < std::tie(b.nearest, a.given);
                            });
  };
  if (!m_hasGrid && farthest()->nearest < kNoticed)
  {
    m_hasGrid = true;
    for (int r = 0; r <= kSteps; ++r)
      for (int g = 0; g <= kSteps; ++g)
        for (int b = 0; b <= kSteps; ++b)
          offer({part(r, kSteps), part(g, kSteps), part(b, kSteps)});
  }
  const auto chosen = farthest();
  ++chosen->given;
  const Color color = chosen->color;
  take(color);
  return color;
}

} // namespace petrous::appearance
