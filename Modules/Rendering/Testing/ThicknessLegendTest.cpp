#include "petrous/Rendering/ThicknessLegend.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "petrous/Rendering/ThicknessColor.h"

using namespace petrous::rendering;

namespace
{

Picture grey(int width, int height)
{
  return {width, height,
          std::vector<std::uint8_t>(
              3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128)};
}

bool isColor(const Picture& picture, int column, int row, const std::array<double, 3>& color)
{
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(picture.pixel(column, row)[c] - 255.0 * color[c]) > 1.0)
      return false;
  return true;
}

} // namespace

// Some row contains the whole scale from end to end, in order; the rest of the picture is
// unchanged.
TEST(ThicknessLegend, HasTheScaleInTheUpperLeftCorner)
{
  Picture picture = grey(640, 480);
  drawThicknessLegend(picture, "sigmoid_sinus", 5.0);
  bool found = false;
  for (int row = 0; row < 120 && !found; ++row)
    for (int left = 0; left < 60 && !found; ++left)
    {
      if (!isColor(picture, left, row, thicknessColor(0.0)))
        continue;
      int last = left;
      while (last + 1 < 320 && !isColor(picture, last, row, thicknessColor(1.0)))
        ++last;
      const int wide = last - left;
      found = wide > 100;
      for (int n = 0; n <= wide && found; ++n)
        found = isColor(picture, left + n, row, thicknessColor(static_cast<double>(n) / wide));
    }
  EXPECT_TRUE(found);
  for (int row = 0; row < 480; ++row)
    for (int column = 0; column < 640; ++column)
      if (row >= 120 || column >= 320)
      {
        ASSERT_TRUE(isColor(picture, column, row, {128 / 255.0, 128 / 255.0, 128 / 255.0}));
      }
}

TEST(ThicknessLegend, SaysWhichStructure)
{
  Picture a = grey(640, 480), b = grey(640, 480);
  drawThicknessLegend(a, "facial_nerve", 5.0);
  drawThicknessLegend(b, "sinus", 5.0);
  EXPECT_GT(countDifferentPixels(a, b), 20u);
  drawThicknessLegend(b = grey(640, 480), "facial nerve", 5.0);
  EXPECT_EQ(countDifferentPixels(a, b), 0u);
}

TEST(ThicknessLegend, LeavesAPictureWithoutRoomAsItIs)
{
  Picture picture = grey(100, 80);
  drawThicknessLegend(picture, "sinus", 5.0);
  EXPECT_EQ(countDifferentPixels(picture, grey(100, 80)), 0u);
  Picture small = grey(121, 9);
  drawThicknessLegend(small, std::string(500, 'w'), 5.0); // nothing outside its rows
}
