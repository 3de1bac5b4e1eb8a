#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Appearance/DistinctColors.h"
#include "petrous/Appearance/StructurePresets.h"

using petrous::appearance::distinctColor;
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
  Deutan
};

// CIE L*a*b* (D65) of the colour as seen by dichromats according to Vienot, Brettel and Mollon
// (Color Research and Application 24(4), 1999): a model and a colour space independent of those of
// the palette.
Triple labOf(const Color& color, Sight sight)
{
  Triple rgb{linear(double(color[0])), linear(double(color[1])), linear(double(color[2]))};
  if (sight == Sight::Protan)
    rgb = times({{0.11238, 0.88762, 0.0}, {0.11238, 0.88762, 0.0}, {0.00401, -0.00401, 1.0}}, rgb);
  if (sight == Sight::Deutan)
    rgb = times({{0.29275, 0.70725, 0.0}, {0.29275, 0.70725, 0.0}, {-0.02234, 0.02234, 1.0}}, rgb);
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

std::vector<Color> palette(std::size_t count)
{
  std::vector<Color> colors;
  while (colors.size() < count)
    colors.push_back(distinctColor(colors));
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
  EXPECT_EQ(distinctColor({colors.begin(), colors.begin() + 5}), colors[5]);
  EXPECT_EQ(palette(12), colors);
}
