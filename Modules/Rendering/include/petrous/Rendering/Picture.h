#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace petrous::rendering
{

/// An RGB picture, 8 bits per channel, top row first.
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

/// Distance from the camera along each pixel's ray, mm, top row first; NaN: no hit.
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

/// Number of pixels that differ in any channel; all pixels if the sizes differ.
std::size_t countDifferentPixels(const Picture& a, const Picture& b);

/// As PNG, with the pixels and nothing else. Throws RenderingError BadSize.
std::vector<std::uint8_t> pngOf(const Picture& picture);

/// Writes atomically (temporary file and rename). Throws RenderingError CannotWrite naming the
/// file.
void writePng(const std::filesystem::path& file, const Picture& picture);

/// NumPy format 1.0: '<f4', C order, shape (height, width). Atomic as writePng.
void writeNpy(const std::filesystem::path& file, const DepthImage& depth);

} // namespace petrous::rendering
