#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace petrous::rendering
{

/// An RGB picture, 8 bits a channel, rows from the top.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb; ///< 3 * width * height

  const std::uint8_t* pixel(int column, int row) const noexcept
  {
    return rgb.data() + 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(column));
  }
};

/// Distance from the camera along each pixel's own ray, mm, rows from the top; NaN: nothing hit.
struct DepthImage
{
  int width = 0;
  int height = 0;
  std::vector<float> millimetres;

  float at(int column, int row) const noexcept
  {
    return millimetres[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(column)];
  }
};

/// How many pixels are not the same in every channel; every pixel when the sizes differ.
std::size_t countDifferentPixels(const Picture& a, const Picture& b);

/// Writes beside the file and renames, so the file is whole or as it was.
/// Throws RenderingError CannotWrite naming the file.
void writePng(const std::filesystem::path& file, const Picture& picture);

/// NumPy format 1.0: '<f4', C order, shape (height, width). Written as writePng does.
void writeNpy(const std::filesystem::path& file, const DepthImage& depth);

} // namespace petrous::rendering
