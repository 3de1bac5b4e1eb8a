#include "petrous/Rendering/PictureText.h"

#include <algorithm>
#include <string>
#include <vector>

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

// Pixels of the text alone that are bright.
int inked(const std::string& text)
{
  Picture picture = grey(400, 60);
  writeText(picture, text, {20.0, 20.0, 0.0, 0.0}, 18, kInk);
  int count = 0;
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
      count += picture.pixel(column, row)[0] > 200 ? 1 : 0;
  return count;
}

std::vector<std::uint8_t> drawn(const std::string& text)
{
  Picture picture = grey(400, 60);
  writeText(picture, text, {20.0, 20.0, 0.0, 0.0}, 18, kInk);
  return picture.rgb;
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

TEST(PictureText, DrawsLettersBeyondAscii)
{
  for (const char* letter : {"ä", "ö", "ü", "Ä", "Ö", "Ü", "ß", "é", "è", "ç", "ñ", "ø", "Å",
                             "µ", "°", "±", "³", "×", "–", "−", "…", "Š", "š", "Ž", "č", "ě",
                             "ř", "ő", "ű", "ł", "Ł", "ą", "ę", "ś", "ş", "ğ", "İ"})
  {
    EXPECT_GT(inked(letter), 8) << letter;
    EXPECT_NE(drawn(letter), drawn("?")) << letter;
  }
  // Two dots over the u, and not a letter less.
  EXPECT_GT(inked("Für"), inked("Fur"));
  EXPECT_GT(inked("Für"), inked("Fr") + 8);
  EXPECT_EQ(drawn("Fu\u0308r"), drawn("F\u00fcr")) << "as other systems store names of files";
}

TEST(PictureText, ShowsThatACharacterIsMissingInTheFont)
{
  for (const char* character : {"中", "ш", "\U0001F600", "\xff"})
    EXPECT_EQ(drawn(std::string("A") + character + "B"), drawn("A?B")) << character;
  for (const char* blank : {"\u202f", "\u00a0", "\u2009", "\t", "\n"})
    EXPECT_EQ(drawn(std::string("60") + blank + "000"), drawn("60 000"));
  EXPECT_EQ(drawn("A\u202eB\u200b"), drawn("AB")) << "what is not seen anyway";
}
