#include "petrous/Rendering/PrintPicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>

#include <libdeflate.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/PixelSamples.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

constexpr double kInch = 25.4; // mm
constexpr int kMinEdge = 16;

void append(std::vector<std::uint8_t>& bytes, std::uint32_t number) // most significant byte first
{
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

void checkEdges(int width, int height)
{
  if (std::min(width, height) < kMinEdge || std::max(width, height) > PrintSize::kMaxEdge)
    throw core::InvalidParameter("a picture of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " pixels: " + std::to_string(kMinEdge) +
                                 " to " + std::to_string(PrintSize::kMaxEdge) + " are possible");
}

// Of tiles beyond the whole picture the rest is dropped.
void put(const Picture& tile, const PictureTile& place, Picture& whole)
{
  const int columns = std::min(tile.width, whole.width - place.left);
  for (int row = std::max(0, -place.top); row < tile.height; ++row)
    std::copy_n(tile.pixel(0, row), 3 * static_cast<std::ptrdiff_t>(columns),
                whole.rgb.begin() + (whole.pixel(place.left, place.top + row) - whole.rgb.data()));
}

} // namespace

int PrintSize::width() const noexcept
{
  return static_cast<int>(
      std::lround(std::clamp(widthMillimetres / kInch * dotsPerInch, 0.0, 1e6)));
}

int PrintSize::height() const noexcept
{
  return static_cast<int>(std::lround(width() * heightToWidth));
}

void PrintSize::validate() const
{
  checkEdges(width(), height());
}

double millimetresPerPixel(const core::CameraPose& camera, int height)
{
  constexpr double kHalfDegree = 3.14159265358979323846 / 360.0;
  const double halfHeight = camera.parallelScale ? *camera.parallelScale
                                                 : (camera.focalPoint - camera.position).norm() *
                                                       std::tan(camera.viewAngle * kHalfDegree);
  return 2.0 * halfHeight / height;
}

// Tiles are counted from the bottom: whatever repeats with the pixels of a window (screen doors)
// goes on from tile to tile, as their edges are multiples of its period.
Picture renderTiled(ScenePicture& scene, const core::CameraPose& camera, int width, int height,
                    const core::Progress& progress, int tile, int samples)
{
  constexpr int kPeriod = 64;
  checkEdges(width, height);
  if (samples < 1 || samples > kPixelSamples)
    throw core::InvalidParameter("a picture of " + std::to_string(samples) +
                                 " samples a pixel: 1 to " + std::to_string(kPixelSamples) +
                                 " are possible");
  const auto edge = [tile](int whole)
  {
    const int longest = std::max(tile / kPeriod, 1) * kPeriod;
    return std::min(longest, (whole + kPeriod - 1) / kPeriod * kPeriod);
  };
  OffscreenView view(edge(width), edge(height));
  const int columns = (width + edge(width) - 1) / edge(width);
  const int rows = (height + edge(height) - 1) / edge(height);
  Picture picture{width, height,
                  std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) *
                                            static_cast<std::size_t>(height))};
  scene.setCamera(camera);
  struct Reset
  {
    ScenePicture& scene;
    ~Reset() { scene.setTile(std::nullopt); }
  } reset{scene};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
    {
      PictureTile place{width, height, column * edge(width), height - (row + 1) * edge(height)};
      std::vector<unsigned> sums;
      Picture drawn;
      for (int n = 0; n < samples; ++n)
      {
        progress.report((row * columns + column + static_cast<double>(n) / samples) /
                            (rows * columns),
                        "drawing the picture");
        if (samples > 1)
        {
          const auto [right, down] = pixelSample(n);
          place.right = right;
          place.down = down;
          place.sample = n;
        }
        scene.setTile(place);
        drawn = view.render(scene);
        sums.resize(drawn.rgb.size());
        std::transform(drawn.rgb.begin(), drawn.rgb.end(), sums.begin(), sums.begin(),
                       [](std::uint8_t value, unsigned sum) { return sum + value; });
      }
      const auto count = static_cast<unsigned>(samples);
      std::transform(sums.begin(), sums.end(), drawn.rgb.begin(),
                     [count](unsigned sum)
                     { return static_cast<std::uint8_t>((sum + count / 2) / count); });
      put(drawn, place, picture);
    }
  return picture;
}

std::vector<std::uint8_t> pngOf(const Picture& picture, double dotsPerInch)
{
  constexpr std::size_t kHeader = 8 + 25; // signature and IHDR, after which pHYs may stand
  std::vector<std::uint8_t> png = pngOf(picture);
  if (png.size() < kHeader)
    throw RenderingError(RenderingError::Reason::CannotWrite, "the picture could not be encoded");
  const auto perMetre = static_cast<std::uint32_t>(std::lround(dotsPerInch / kInch * 1000.0));
  std::vector<std::uint8_t> chunk;
  append(chunk, 9);
  for (const char letter : {'p', 'H', 'Y', 's'})
    chunk.push_back(static_cast<std::uint8_t>(letter));
  append(chunk, perMetre);
  append(chunk, perMetre);
  chunk.push_back(1); // the unit is the metre
  append(chunk, libdeflate_crc32(0, chunk.data() + 4, chunk.size() - 4));
  png.insert(png.begin() + kHeader, chunk.begin(), chunk.end());
  return png;
}

} // namespace petrous::rendering
