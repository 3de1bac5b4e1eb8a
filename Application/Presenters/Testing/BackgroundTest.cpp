#include "petrous/Presenters/Background.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Presenters/LabelledPicture.h"

namespace petrous::presenters
{
namespace
{

using rendering::BackgroundColor;

TEST(Background, IsANameOrAColour)
{
  EXPECT_EQ(parseBackground("black"), (BackgroundColor{0.0, 0.0, 0.0}));
  EXPECT_EQ(parseBackground("dark-grey"), rendering::kDefaultBackground);
  EXPECT_EQ(parseBackground("white"), (BackgroundColor{1.0, 1.0, 1.0}));
  EXPECT_EQ(parseBackground("#FF0033"), (BackgroundColor{1.0, 0.0, 0.2}));
  EXPECT_EQ(backgroundText({1.0, 0.0, 0.2}), "#ff0033");
  EXPECT_EQ(backgroundText(rendering::kDefaultBackground), "dark-grey");
  for (const NamedBackground& one : kBackgrounds)
    EXPECT_EQ(parseBackground(backgroundText(one.color)), one.color) << one.name;
  for (const char* other : {"", "White", "#fff", "#12345g", "#1234567", "ffffff", "# 12345"})
    EXPECT_EQ(parseBackground(other), std::nullopt) << other;
}

// WCAG 2.1: (L1 + 0.05) / (L2 + 0.05). Grey 0x75 has 4.56 to black and 4.61 to white, 0x77 the
// other way round: 4.69 and 4.48.
TEST(Background, HasLettersOfTheGreaterContrast)
{
  const auto grey = [](int byte) { return backdropOf({byte / 255.0, byte / 255.0, byte / 255.0}); };
  EXPECT_EQ(grey(0), Backdrop::Dark);
  EXPECT_EQ(grey(0x75), Backdrop::Dark);
  EXPECT_EQ(grey(0x77), Backdrop::Light);
  EXPECT_EQ(grey(255), Backdrop::Light);
  EXPECT_EQ(backdropOf({0.0, 0.0, 1.0}), Backdrop::Dark);  // L 0.0722
  EXPECT_EQ(backdropOf({1.0, 1.0, 0.0}), Backdrop::Light); // L 0.9278
  EXPECT_EQ(backdropOf(rendering::kDefaultBackground), Backdrop::Dark);
  EXPECT_EQ(backdropOf(kBackgrounds[2].color), Backdrop::Light);
}

// Of all that is written on a picture of one colour: how far the pixel that differs most is from
// it.
int farthest(std::uint8_t ground, Backdrop backdrop)
{
  constexpr int kEdge = 300;
  rendering::Picture picture{kEdge, kEdge, std::vector<std::uint8_t>(3 * kEdge * kEdge, ground)};
  addLines(picture, {"Left side"}, 1.0, backdrop);
  int most = 0;
  for (const std::uint8_t value : picture.rgb)
    most = std::max(most, std::abs(int(value) - int(ground)));
  return most;
}

TEST(LabelledPicture, HasDarkLettersOnALightBackground)
{
  EXPECT_GT(farthest(255, Backdrop::Light), 220);
  EXPECT_GT(farthest(0, Backdrop::Dark), 220);
}

TEST(LabelledPicture, HasADarkScaleBarOnALightBackground)
{
  constexpr int kWidth = 300, kHeight = 200;
  rendering::Picture picture{kWidth, kHeight, std::vector<std::uint8_t>(3 * kWidth * kHeight, 255)};
  addScaleBar(picture, 0.5, {}, 1.0, Backdrop::Light);
  const std::uint8_t* bar = &picture.rgb[3 * (std::size_t(kHeight - 9) * kWidth + kWidth - 20)];
  EXPECT_LT(int(bar[0]), 40) << "its lowest row, above the margin";
}

} // namespace
} // namespace petrous::presenters
