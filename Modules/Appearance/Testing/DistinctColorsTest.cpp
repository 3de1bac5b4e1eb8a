#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "petrous/Appearance/DistinctColors.h"
#include "petrous/Appearance/StructurePresets.h"

using petrous::appearance::DistinctColors;
using Color = std::array<float, 3>;
using Triple = std::array<double, 3>;

namespace
{

double linear(double c)
{
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Triple times(const double (&m)[3][3], const Triple& v)
{
  Triple result{};
  for (std::size_t n = 0; n < 3; ++n)
    result[n] = m[n][0] * v[0] + m[n][1] * v[1] + m[n][2] * v[2];
  return result;
}

enum class Sight
{
  Normal,
  Protan,
  Deutan,
  MachadoProtan,
  MachadoDeutan,
  MachadoTritan
};
constexpr std::array<Sight, 6> kSights{Sight::Normal,        Sight::Protan,
                                       Sight::Deutan,        Sight::MachadoProtan,
                                       Sight::MachadoDeutan, Sight::MachadoTritan};

// CIE L*a*b* (D65) of the colour as seen by dichromats according to Vienot, Brettel and Mollon
// (Color Research and Application 24(4), 1999), a model independent of that of the palette, and to
// Machado, Oliveira and Fernandes (IEEE TVCG 15(6), 2009).
Triple labOf(const Color& color, Sight sight)
{
  Triple rgb{linear(double(color[0])), linear(double(color[1])), linear(double(color[2]))};
  if (sight == Sight::Protan)
    rgb = times({{0.11238, 0.88762, 0.0}, {0.11238, 0.88762, 0.0}, {0.00401, -0.00401, 1.0}}, rgb);
  if (sight == Sight::Deutan)
    rgb = times({{0.29275, 0.70725, 0.0}, {0.29275, 0.70725, 0.0}, {-0.02234, 0.02234, 1.0}}, rgb);
  if (sight == Sight::MachadoProtan)
    rgb = times({{0.152286, 1.052583, -0.204868},
                 {0.114503, 0.786281, 0.099216},
                 {-0.003882, -0.048116, 1.051998}},
                rgb);
  if (sight == Sight::MachadoDeutan)
    rgb = times({{0.367322, 0.860646, -0.227968},
                 {0.280085, 0.672501, 0.047413},
                 {-0.011820, 0.042940, 0.968881}},
                rgb);
  if (sight == Sight::MachadoTritan)
    rgb = times({{1.255528, -0.076749, -0.178779},
                 {-0.078411, 0.930809, 0.147602},
                 {0.004733, 0.691367, 0.303900}},
                rgb);
  for (double& channel : rgb)
    channel = std::min(std::max(channel, 0.0), 1.0);
  Triple xyz = times({{0.4124564, 0.3575761, 0.1804375},
                      {0.2126729, 0.7151522, 0.0721750},
                      {0.0193339, 0.1191920, 0.9503041}},
                     rgb);
  const Triple white{0.95047, 1.0, 1.08883};
  for (std::size_t n = 0; n < 3; ++n)
  {
    const double t = std::max(xyz[n], 0.0) / white[n];
    xyz[n] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  }
  return {116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2])};
}

// Smallest CIE 1976 colour difference between any two of them.
double minDifference(const std::vector<Color>& colors, Sight sight)
{
  double least = 1e9;
  for (std::size_t a = 0; a < colors.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
    {
      const Triple x = labOf(colors[a], sight);
      const Triple y = labOf(colors[b], sight);
      least = std::min(least, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
    }
  return least;
}

// CIEDE2000 (Sharma, Wu and Dalal 2005, equations 2 to 22).
double difference2000(const Triple& one, const Triple& two)
{
  const double pi = std::acos(-1.0);
  const auto radians = [pi](double degrees) { return degrees * pi / 180.0; };
  const double meanC = (std::hypot(one[1], one[2]) + std::hypot(two[1], two[2])) / 2.0;
  const double g =
      0.5 * (1.0 - std::sqrt(std::pow(meanC, 7) / (std::pow(meanC, 7) + std::pow(25.0, 7))));
  const double a1 = (1.0 + g) * one[1], a2 = (1.0 + g) * two[1];
  const double c1 = std::hypot(a1, one[2]), c2 = std::hypot(a2, two[2]);
  const auto hue = [pi](double a, double b)
  {
    if (a == 0.0 && b == 0.0)
      return 0.0;
    const double degrees = std::atan2(b, a) * 180.0 / pi;
    return degrees >= 0.0 ? degrees : degrees + 360.0;
  };
  const double h1 = hue(a1, one[2]), h2 = hue(a2, two[2]);
  double dh = 0.0, mean = h1 + h2;
  if (c1 * c2 != 0.0)
  {
    dh = h2 - h1;
    if (dh > 180.0)
      dh -= 360.0;
    else if (dh < -180.0)
      dh += 360.0;
    if (std::abs(h1 - h2) <= 180.0)
      mean = (h1 + h2) / 2.0;
    else
      mean = h1 + h2 < 360.0 ? (h1 + h2 + 360.0) / 2.0 : (h1 + h2 - 360.0) / 2.0;
  }
  const double dL = two[0] - one[0], dC = c2 - c1;
  const double dH = 2.0 * std::sqrt(c1 * c2) * std::sin(radians(dh / 2.0));
  const double l = (one[0] + two[0]) / 2.0, c = (c1 + c2) / 2.0;
  const double t =
      1.0 - 0.17 * std::cos(radians(mean - 30.0)) + 0.24 * std::cos(radians(2.0 * mean)) +
      0.32 * std::cos(radians(3.0 * mean + 6.0)) - 0.20 * std::cos(radians(4.0 * mean - 63.0));
  const double theta = 30.0 * std::exp(-std::pow((mean - 275.0) / 25.0, 2));
  const double rc = 2.0 * std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)));
  const double sl = 1.0 + 0.015 * std::pow(l - 50.0, 2) / std::sqrt(20.0 + std::pow(l - 50.0, 2));
  const double sc = 1.0 + 0.045 * c, sh = 1.0 + 0.015 * c * t;
  return std::sqrt(std::pow(dL / sl, 2) + std::pow(dC / sc, 2) + std::pow(dH / sh, 2) -
                   std::sin(radians(2.0 * theta)) * rc * (dC / sc) * (dH / sh));
}

// Smallest CIEDE2000 between any of `colors` and any other of them, or of `others`.
double minDifference2000(const std::vector<Color>& colors, const std::vector<Color>& others,
                         Sight sight)
{
  double least = 1e9;
  for (std::size_t a = 0; a < colors.size(); ++a)
  {
    for (std::size_t b = 0; b < a && others.empty(); ++b)
      least = std::min(least, difference2000(labOf(colors[a], sight), labOf(colors[b], sight)));
    for (const Color& other : others)
      least = std::min(least, difference2000(labOf(colors[a], sight), labOf(other, sight)));
  }
  return least;
}

std::vector<Color> palette(std::size_t count)
{
  std::vector<Color> colors;
  DistinctColors distinct;
  while (colors.size() < count)
    colors.push_back(distinct.next());
  return colors;
}

} // namespace

// Okabe and Ito's palette (2008), without black: published for colour-blind readers.
TEST(DistinctColors, SevenAreAsDistinctToTheColourBlindAsThePublishedPalette)
{
  std::vector<Color> published;
  for (const auto& rgb : {std::array<int, 3>{230, 159, 0},
                          {86, 180, 233},
                          {0, 158, 115},
                          {240, 228, 66},
                          {0, 114, 178},
                          {213, 94, 0},
                          {204, 121, 167}})
    published.push_back({static_cast<float>(rgb[0]) / 255.0F, static_cast<float>(rgb[1]) / 255.0F,
                         static_cast<float>(rgb[2]) / 255.0F});
  const auto colors = palette(published.size());
  for (const Sight sight : {Sight::Protan, Sight::Deutan})
    EXPECT_GE(minDifference(colors, sight), minDifference(published, sight))
        << static_cast<int>(sight);
}

TEST(DistinctColors, TheTestsDifferenceIsThatOfThePublishedPairs)
{
  // Table 1 of Sharma, Wu and Dalal (2005): pairs 1, 7, 17 and 25.
  EXPECT_NEAR(difference2000({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 2.0425, 1e-4);
  EXPECT_NEAR(difference2000({50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}), 2.3669, 1e-4);
  EXPECT_NEAR(difference2000({50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}), 27.1492, 1e-4);
  EXPECT_NEAR(difference2000({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644,
              1e-4);
}

// CIEDE2000 between any two, under normal vision and three dichromacies, each by one model or two;
// about 1 is just noticeable side by side.
TEST(DistinctColors, KeepTheirDistanceUnderAnyColourVision)
{
  const auto colors = palette(60);
  const std::vector<Color> bone{
      petrous::appearance::StructurePresets::builtIn().preset("bone").color};
  const std::vector<Color> background{{0.105F, 0.115F, 0.130F}, {0.0F, 0.0F, 0.0F}};
  const auto first = [&colors](std::size_t n)
  { return std::vector<Color>(colors.begin(), colors.begin() + static_cast<std::ptrdiff_t>(n)); };
  for (const Sight sight : kSights)
  {
    const bool isNormal = sight == Sight::Normal;
    EXPECT_GE(minDifference2000(first(12), {}, sight), isNormal ? 14.5 : 9.4) << int(sight);
    EXPECT_GE(minDifference2000(first(24), {}, sight), isNormal ? 10.0 : 6.4) << int(sight);
    EXPECT_GE(minDifference2000(colors, {}, sight), isNormal ? 6.0 : 4.0) << int(sight);
    EXPECT_GE(minDifference2000(first(12), bone, sight), 9.5) << int(sight);
    EXPECT_GE(minDifference2000(colors, bone, sight), 4.5) << int(sight);
    EXPECT_GE(minDifference2000(colors, background, sight), 14.0) << int(sight);
  }
}

TEST(DistinctColors, BeyondThePaletteNoneIsGivenTwice)
{
  auto colors = palette(90);
  std::sort(colors.begin(), colors.end());
  EXPECT_EQ(std::adjacent_find(colors.begin(), colors.end()), colors.end());
}

TEST(DistinctColors, SixtyDifferByMoreThanTheEyeNeeds)
{
  const auto colors = palette(60);
  constexpr double kNoticed = 2.3; // just noticeable difference (Mahy et al. 1994)
  EXPECT_GT(minDifference(colors, Sight::Normal), 3.0 * kNoticed);
  EXPECT_GT(minDifference(colors, Sight::Protan), kNoticed);
  EXPECT_GT(minDifference(colors, Sight::Deutan), kNoticed);
}

TEST(DistinctColors, NoneIsTakenForANerveOrAVessel)
{
  const auto presets = petrous::appearance::StructurePresets::builtIn();
  for (const Color& color : palette(20))
    for (const char* name : {"nerve", "artery", "vein", "bone"})
      EXPECT_GT(minDifference({color, presets.preset(name).color}, Sight::Normal), 10.0) << name;
}

TEST(DistinctColors, KeepsClearOfWhatIsTaken)
{
  const auto colors = palette(12);
  // The result depends only on the colours taken.
  EXPECT_EQ(DistinctColors({colors.begin(), colors.begin() + 5}).next(), colors[5]);
  DistinctColors told;
  for (int n = 0; n < 5; ++n)
    told.take(colors[static_cast<std::size_t>(n)]);
  EXPECT_EQ(told.next(), colors[5]);
  EXPECT_EQ(palette(12), colors);
}

// More than the palette and the grid have: given twice, and none before all were.
TEST(DistinctColors, GoesOnWhereAllAreTaken)
{
  const auto colors = palette(1500);
  const std::set<Color> different(colors.begin(), colors.end());
  EXPECT_GT(different.size(), 300u);
  EXPECT_LT(different.size(), 800u);
  EXPECT_EQ(std::set<Color>(colors.begin(),
                            colors.begin() + static_cast<std::ptrdiff_t>(different.size())),
            different);
  for (const Color& color : different)
    EXPECT_LE(std::count(colors.begin(), colors.end(), color),
              static_cast<std::ptrdiff_t>(colors.size() / different.size() + 1));
}
