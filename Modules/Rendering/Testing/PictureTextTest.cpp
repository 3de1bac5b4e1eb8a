#include "petrous/Rendering/PictureText.h"

#include <algorithm>

#include <gtest/gtest.h>

using namespace petrous::rendering;

namespace
{

constexpr std::array<std::uint8_t, 3> kInk{255, 255, 255};

Picture grey(int width, int height)
{
  return {width, height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 128)};
}

// Bounding box of pixels other than grey: left, top, right, bottom; right < left if there are none.
std::array<int, 4> written(const Picture& picture)
{
  std::array<int, 4> box{picture.width, picture.height, -1, -1};
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
      if (picture.pixel(column, row)[0] != 128)
        box = {std::min(box[0], column), std::min(box[1], row), std::max(box[2], column),
               std::max(box[3], row)};
  return box;
}

} // namespace

TEST(PictureText, StandsWhereItWasAskedForWithInkAndBorder)
{
  Picture picture = grey(120, 60);
  writeText(picture, "LR", {20.0, 10.0, 0.0, 0.0}, 18, kInk);
  const auto box = written(picture);
  EXPECT_NEAR(box[0], 20, 4);
  EXPECT_NEAR(box[1], 10, 4);
  EXPECT_GT(box[2], 35);
  EXPECT_LT(box[2], 60);
  EXPECT_LT(box[3], 40);
  EXPECT_EQ(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 255);
  EXPECT_LT(*std::min_element(picture.rgb.begin(), picture.rgb.end()), 40);

  picture = grey(120, 60);
  writeText(picture, "LR", {110.0, 50.0, 1.0, 1.0}, 18, kInk);
  const auto right = written(picture);
  EXPECT_NEAR(right[2], 110, 4);
  EXPECT_NEAR(right[3], 50, 4);
  EXPECT_EQ(right[2] - right[0], box[2] - box[0]);
}

TEST(PictureText, IsCutAtThePicturesEdges)
{
  for (const TextPlace& place : {TextPlace{-10.0, -8.0, 0.0, 0.0}, TextPlace{35.0, 18.0, 0.0, 0.0}})
  {
    Picture picture = grey(40, 20);
    writeText(picture, "MMM", place, 20, kInk);
    EXPECT_GE(written(picture)[2], 0);
  }
  Picture picture = grey(40, 20);
  writeText(picture, "far", {500.0, 500.0, 0.0, 0.0}, 20, kInk);
  EXPECT_LT(written(picture)[2], 0);
  writeText(picture, "", {10.0, 10.0, 0.0, 0.0}, 20, kInk);
  EXPECT_LT(written(picture)[2], 0);
}
