#include "petrous/Rendering/PictureText.h"

#include <algorithm>
#include <cmath>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkTextProperty.h>

#include "FontText.h"

namespace petrous::rendering
{

namespace
{
constexpr int kBorder = 2; // pixels
constexpr double kBorderOpacity = 0.8;

// Coverage of each pixel by the text, 0 to 1, top row first.
struct TextMask
{
  int width = 0;
  int height = 0;
  std::vector<double> covered;

  double at(int column, int row) const
  {
    return column < 0 || row < 0 || column >= width || row >= height
               ? 0.0
               : covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(column)];
  }
  double around(int column, int row) const // coverage including the outline
  {
    double most = 0.0;
    for (int dy = -kBorder; dy <= kBorder; ++dy)
      for (int dx = -kBorder; dx <= kBorder; ++dx)
        if (dx * dx + dy * dy <= kBorder * kBorder)
          most = std::max(most, at(column + dx, row + dy));
    return most;
  }
};

TextMask maskOf(const std::string& text, int points)
{
  vtkNew<vtkTextProperty> style;
  style->SetFontFamilyToArial();
  style->SetFontSize(points);
  style->BoldOn();
  style->SetColor(1.0, 1.0, 1.0);
  vtkNew<vtkImageData> image;
  int size[2] = {0, 0};
  TextMask mask;
  if (!drawText(style, text, image, size))
    return mask;
  int extent[6];
  image->GetExtent(extent);
  mask.width = std::min(size[0], extent[1] - extent[0] + 1);
  mask.height = std::min(size[1], extent[3] - extent[2] + 1);
  const int last = image->GetNumberOfScalarComponents() - 1; // opacity
  for (int row = mask.height - 1; row >= 0; --row)           // VTK stores rows bottom up
    for (int column = 0; column < mask.width; ++column)
      mask.covered.push_back(
          image->GetScalarComponentAsDouble(extent[0] + column, extent[2] + row, 0, last) / 255.0);
  return mask;
}
} // namespace

void writeText(Picture& picture, const std::string& text, const TextPlace& place, int size,
               const std::array<std::uint8_t, 3>& color, const std::array<std::uint8_t, 3>& outline)
{
  const TextMask mask = maskOf(text, size);
  const int left = static_cast<int>(std::lround(place.column - place.across * mask.width));
  const int top = static_cast<int>(std::lround(place.row - place.down * mask.height));
  for (int row = -kBorder; row < mask.height + kBorder; ++row)
    for (int column = -kBorder; column < mask.width + kBorder; ++column)
    {
      const int x = left + column;
      const int y = top + row;
      if (x < 0 || y < 0 || x >= picture.width || y >= picture.height)
        continue;
      const double around = kBorderOpacity * mask.around(column, row);
      const double share = mask.at(column, row);
      std::uint8_t* pixel =
          &picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(x))];
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(std::lround(
            (pixel[c] * (1.0 - around) + outline[c] * around) * (1.0 - share) + color[c] * share));
    }
}

} // namespace petrous::rendering
