#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/ScenePicture.h"

namespace petrous::rendering
{

/// Size of a picture on paper.
struct PrintSize
{
  static constexpr int kMaxEdge = 12000; ///< pixels

  double widthMillimetres = 0.0; ///< on paper
  double dotsPerInch = 300.0;
  double heightToWidth = 0.75;

  int width() const noexcept; ///< pixels
  int height() const noexcept;
  void validate() const; ///< throws InvalidParameter unless both are 16 to kMaxEdge
};

/// mm of the patient per pixel in the plane through the focal point, parallel to the picture; of a
/// parallel projection everywhere.
double millimetresPerPixel(const core::CameraPose& camera, int height);

/// Draws a scene off-screen at any size up to PrintSize::kMaxEdge, in tiles of at most `tile`
/// pixels along an edge, between which it can be cancelled. The tiles are parts of one picture:
/// joined, they are what one window of that size would show; with more than one of up to
/// kPixelSamples `samples` the mean of as many, with rays through other places of each pixel.
/// Throws RenderingError, InvalidParameter, CancelledError.
Picture renderTiled(ScenePicture& scene, const core::CameraPose& camera, int width, int height,
                    const core::Progress& progress = {}, int tile = 1024, int samples = 1);

/// As pngOf(picture), with the resolution at which it is to be printed (pHYs, in whole dots per
/// metre) [ISO/IEC 15948, 11.3.5.3].
std::vector<std::uint8_t> pngOf(const Picture& picture, double dotsPerInch);

} // namespace petrous::rendering
