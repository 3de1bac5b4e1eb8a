#include "petrous/Presenters/LabelledPicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "petrous/Core/NumberText.h"
#include "petrous/Interaction/OrbitCamera.h"
#include "petrous/Rendering/PictureText.h"

namespace petrous::presenters
{

namespace
{

using Color = std::array<std::uint8_t, 3>;
constexpr Color kDark{0, 0, 0};
constexpr Color kCross{255, 208, 64};
constexpr int kMargin = 8;
constexpr int kLetter = 17;
constexpr int kLine = 14;

// Of letters and bars, with what is around them.
struct Ink
{
  Color color;
  Color outline;
};

constexpr Ink inkOn(Backdrop backdrop)
{
  return backdrop == Backdrop::Dark ? Ink{{242, 245, 248}, kDark}
                                    : Ink{{16, 22, 30}, {255, 255, 255}};
}

int scaled(double pixels, double magnified)
{
  return static_cast<int>(std::lround(pixels * magnified));
}

void fill(rendering::Picture& picture, int left, int top, int right, int bottom, const Color& color)
{
  for (int row = std::max(top, 0); row < std::min(bottom, picture.height); ++row)
    for (int column = std::max(left, 0); column < std::min(right, picture.width); ++column)
      std::copy(color.begin(), color.end(),
                picture.rgb.begin() +
                    3 * (static_cast<std::ptrdiff_t>(row) * picture.width + column));
}

template <class Letters>
void addLetters(rendering::Picture& picture, const Letters& letters, double magnified,
                Backdrop backdrop = Backdrop::Dark)
{
  const Ink ink = inkOn(backdrop);
  const double width = picture.width;
  const double height = picture.height;
  const double margin = kMargin * magnified;
  const auto letter = [&](const std::string& text, const rendering::TextPlace& place) {
    rendering::writeText(picture, text, place, scaled(kLetter, magnified), ink.color, ink.outline);
  };
  letter(letters.left, {margin, 0.5 * height, 0.0, 0.5});
  letter(letters.right, {width - margin, 0.5 * height, 1.0, 0.5});
  letter(letters.top, {0.5 * width, margin, 0.5, 0.0});
  letter(letters.bottom, {0.5 * width, height - margin, 0.5, 1.0});
}

} // namespace

void addEdgeLetters(rendering::Picture& picture, const core::CameraPose& camera, double magnified,
                    Backdrop backdrop)
{
  addLetters(picture, interaction::edgeDirections(camera), magnified, backdrop);
}

// Text above a bar with end marks.
void addScaleBar(rendering::Picture& picture, double mmPerPixel, const std::string& where,
                 double magnified, Backdrop backdrop)
{
  const Ink ink = inkOn(backdrop);
  const double length = scaleBarLength(0.28 * picture.width * mmPerPixel);
  if (length <= 0.0)
    return;
  const auto pixels = [magnified](double count) { return scaled(count, magnified); };
  const int right = picture.width - pixels(kMargin);
  const int bottom = picture.height - pixels(kMargin);
  const int left = right - static_cast<int>(std::lround(length / mmPerPixel));
  const auto bar = [&](int wider, const Color& color)
  {
    fill(picture, left - wider, bottom - pixels(2) - wider, right + wider, bottom + wider, color);
    fill(picture, left - wider, bottom - pixels(7) - wider, left + pixels(2) + wider, bottom,
         color);
    fill(picture, right - pixels(2) - wider, bottom - pixels(7) - wider, right + wider, bottom,
         color);
  };
  bar(pixels(1), ink.outline);
  bar(0, ink.color);
  const std::string text = core::plainText(length) + " mm";
  const double middle = 0.5 * (left + right);
  if (where.empty())
    rendering::writeText(picture, text, {middle, bottom - 10.0 * magnified, 0.5, 1.0},
                         pixels(kLine), ink.color, ink.outline);
  else
    rendering::writeText(picture, text + " " + where,
                         {double(right), bottom - 10.0 * magnified, 1.0, 1.0}, pixels(kLine),
                         ink.color, ink.outline);
}

void addLines(rendering::Picture& picture, const std::vector<std::string>& lines, double magnified,
              Backdrop backdrop)
{
  const Ink ink = inkOn(backdrop);
  double row = kMargin * magnified;
  for (const std::string& line : lines)
  {
    rendering::writeText(picture, line, {kMargin * magnified, row, 0.0, 0.0},
                         scaled(kLine, magnified), ink.color, ink.outline);
    row += 1.5 * kLine * magnified;
  }
}

void addCross(rendering::Picture& picture, const Eigen::Vector2d& place)
{
  constexpr int kGap = 6, kArm = 16;
  const int column = static_cast<int>(std::lround(place[0]));
  const int row = static_cast<int>(std::lround(place[1]));
  const auto arms = [&](int wider, const Color& color)
  {
    for (const int side : {-1, 1})
    {
      const int near = side * kGap, far = side * kArm;
      fill(picture, column + std::min(near, far) - wider, row - wider,
           column + std::max(near, far) + 1 + wider, row + 1 + wider, color);
      fill(picture, column - wider, row + std::min(near, far) - wider, column + 1 + wider,
           row + std::max(near, far) + 1 + wider, color);
    }
  };
  arms(1, kDark);
  arms(0, kCross);
}

void addLine(rendering::Picture& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * (to - from).norm())));
  const auto draw = [&](int wider, const Color& color)
  {
    for (int n = 0; n <= steps; ++n)
    {
      const Eigen::Vector2d at = from + (to - from) * (static_cast<double>(n) / steps);
      const int column = static_cast<int>(std::lround(at[0]));
      const int row = static_cast<int>(std::lround(at[1]));
      fill(picture, column - wider, row - wider, column + 1 + wider, row + 1 + wider, color);
    }
  };
  draw(1, kDark);
  draw(0, kCross);
}

rendering::Picture labelledSlice(SlicePixels pixels, const SliceGeometry& slice,
                                 const std::vector<std::string>& lines)
{
  rendering::Picture picture{pixels.width, pixels.height, std::move(pixels.rgb)};
  addLetters(picture, slice.edgeLetters(), 1.0);
  addLines(picture, lines);
  addScaleBar(picture, slice.mmPerPixel());
  return picture;
}

std::string sideText(scene::Side side)
{
  switch (side)
  {
  case scene::Side::Left:
    return "Left side";
  case scene::Side::Right:
    return "Right side";
  case scene::Side::Both:
    return "Both sides";
  case scene::Side::Unknown:
    break;
  }
  return "Side not stated";
}

} // namespace petrous::presenters
