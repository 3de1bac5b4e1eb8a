#include "petrous/Rendering/ThicknessLegend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkTextProperty.h>

#include "FontText.h"
#include "petrous/Rendering/ThicknessColor.h"

namespace petrous::rendering
{

namespace
{

using Color = std::array<double, 3>;

constexpr int kMinWidth = 120;
constexpr double kShade = 0.75;
constexpr Color kGround{0.063, 0.075, 0.090};
constexpr Color kInk{0.843, 0.863, 0.886};

void blend(Picture& picture, int column, int row, const Color& color, double share)
{
  if (column < 0 || row < 0 || column >= picture.width || row >= picture.height)
    return;
  std::uint8_t* pixel = picture.rgb.data() + 3 * (static_cast<std::size_t>(row) *
                                                      static_cast<std::size_t>(picture.width) +
                                                  static_cast<std::size_t>(column));
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] =
        static_cast<std::uint8_t>(std::lround((1.0 - share) * pixel[c] + share * 255.0 * color[c]));
}

struct Box
{
  int left, top, width, height;
};

void fill(Picture& picture, const Box& box, const Color& color, double share)
{
  for (int row = box.top; row < box.top + box.height; ++row)
    for (int column = box.left; column < box.left + box.width; ++column)
      blend(picture, column, row, color, share);
}

class Writer
{
public:
  explicit Writer(int size)
  {
    m_look->SetFontFamilyToArial();
    m_look->SetFontSize(size);
    m_look->SetColor(kInk[0], kInk[1], kInk[2]);
  }

  /// Returns the width in pixels, drawn or not; clipped at `most` pixels.
  int write(Picture* picture, const std::string& text, int left, int top, int most) const
  {
    vtkNew<vtkImageData> image;
    int dims[2] = {0, 0};
    if (!drawText(m_look, text, image, dims))
      return 0;
    // Rows bottom up; the image may be larger than the text.
    for (int row = 0; picture && row < dims[1]; ++row)
      for (int column = 0; column < std::min(dims[0], most); ++column)
      {
        const auto* rgba = static_cast<const std::uint8_t*>(image->GetScalarPointer(
            image->GetExtent()[0] + column, image->GetExtent()[2] + dims[1] - 1 - row, 0));
        blend(*picture, left + column, top + row, kInk, rgba[3] / 255.0);
      }
    return dims[0];
  }

private:
  vtkNew<vtkTextProperty> m_look;
};

} // namespace

void drawThicknessLegend(Picture& picture, const std::string& structure, double farthest)
{
  if (picture.width < kMinWidth || !(farthest > 0.0))
    return;
  const int type = std::clamp(picture.height / 40, 9, 28);
  const int width = std::min(picture.width / 2, 18 * type);
  const int margin = type;
  const Box panel{margin / 2, margin / 2, width, 5 * type};
  fill(picture, panel, kGround, kShade);
  const Writer writer(type);
  std::string name = structure;
  std::replace(name.begin(), name.end(), '_', ' ');
  const int left = panel.left + margin;
  const Box bar{left, panel.top + 2 * type, width - 2 * margin, type};
  writer.write(&picture, "Bone over " + name + ", mm", left, panel.top + type / 2, bar.width);
  for (int n = 0; n < bar.width; ++n)
    fill(picture, {bar.left + n, bar.top, 1, bar.height},
         thicknessColor(static_cast<double>(n) / (bar.width - 1)), 1.0);
  const int last = static_cast<int>(farthest);
  for (int mm = 0; mm <= last; ++mm)
  {
    const int x = bar.left + static_cast<int>(std::lround((bar.width - 1) * mm / farthest));
    fill(picture, {x, bar.top + bar.height - 2, 1, 4}, kInk, 1.0);
    const std::string number = std::to_string(mm);
    const int wide = writer.write(nullptr, number, 0, 0, width);
    writer.write(&picture, number, x - wide / 2, bar.top + bar.height + type / 4, width);
  }
}

} // namespace petrous::rendering
