#include "SlicePicture.h"

#include <algorithm>
#include <cmath>

#include "Numbers.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Rendering/PictureText.h"

namespace petrous::cli
{

namespace
{
using Color = std::array<std::uint8_t, 3>;
constexpr Color kInk{242, 245, 248};
constexpr Color kDark{0, 0, 0};
constexpr int kMargin = 8;
constexpr int kLetter = 17;
constexpr int kLine = 14;

void fill(rendering::Picture& picture, int left, int top, int right, int bottom, const Color& color)
{
  for (int row = std::max(top, 0); row < std::min(bottom, picture.height); ++row)
    for (int column = std::max(left, 0); column < std::min(right, picture.width); ++column)
      std::copy(color.begin(), color.end(),
                picture.rgb.begin() +
                    3 * (static_cast<std::ptrdiff_t>(row) * picture.width + column));
}

// Text above a bar with end marks, at the lower right.
void addScaleBar(rendering::Picture& picture, double mmPerPixel)
{
  const double length = presenters::scaleBarLength(0.28 * picture.width * mmPerPixel);
  if (length <= 0.0)
    return;
  const int right = picture.width - kMargin;
  const int bottom = picture.height - kMargin;
  const int left = right - static_cast<int>(std::lround(length / mmPerPixel));
  const auto bar = [&](int wider, const Color& color)
  {
    fill(picture, left - wider, bottom - 2 - wider, right + wider, bottom + wider, color);
    fill(picture, left - wider, bottom - 7 - wider, left + 2 + wider, bottom, color);
    fill(picture, right - 2 - wider, bottom - 7 - wider, right + wider, bottom, color);
  };
  bar(1, kDark);
  bar(0, kInk);
  rendering::writeText(picture, core::generalText(length) + " mm",
                       {0.5 * (left + right), bottom - 10.0, 0.5, 1.0}, kLine, kInk);
}

} // namespace

rendering::Picture labelled(presenters::SlicePixels pixels, const presenters::SliceGeometry& slice,
                            const std::vector<std::string>& lines)
{
  rendering::Picture picture{pixels.width, pixels.height, std::move(pixels.rgb)};
  const double width = picture.width;
  const double height = picture.height;
  const auto letter = [&](char c, const rendering::TextPlace& place)
  { rendering::writeText(picture, std::string(1, c), place, kLetter, kInk); };
  const auto letters = slice.edgeLetters();
  letter(letters.left, {double(kMargin), 0.5 * height, 0.0, 0.5});
  letter(letters.right, {width - kMargin, 0.5 * height, 1.0, 0.5});
  letter(letters.top, {0.5 * width, double(kMargin), 0.5, 0.0});
  letter(letters.bottom, {0.5 * width, height - kMargin, 0.5, 1.0});
  double row = kMargin;
  for (const std::string& line : lines)
  {
    rendering::writeText(picture, line, {double(kMargin), row, 0.0, 0.0}, kLine, kInk);
    row += 1.5 * kLine;
  }
  addScaleBar(picture, slice.mmPerPixel());
  return picture;
}

} // namespace petrous::cli
