#include "petrous/Presenters/SliceOverlay.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "OverlayPainter.h"
#include "petrous/Appearance/AppearanceMaterial.h"

namespace petrous::presenters
{

namespace
{
constexpr float kLineWidth = 1.3F; // pixels
constexpr float kCasing = 1.6F;    // additional pixels, for the dark line beneath
constexpr float kCasingShare = 0.55F;
constexpr double kSquare = 40.0; // pixels, about
// Tint of an MR over the grey CT: the colour of white.
constexpr std::array<float, 3> kWarm{255.0F, 176.0F, 96.0F};

// For each row in parallel: paint(pixel bytes, MR sample, column, row).
template <class Paint>
void forEachSample(const PlaneSamples& samples, SlicePixels& pixels, const Paint& paint)
{
  tbb::parallel_for(0, samples.height,
                    [&](int row)
                    {
                      for (int column = 0; column < samples.width; ++column)
                      {
                        const std::size_t n = static_cast<std::size_t>(row) *
                                                  static_cast<std::size_t>(samples.width) +
                                              static_cast<std::size_t>(column);
                        paint(&pixels.rgb[3 * n], samples.values[n], column, row);
                      }
                    });
}

void paintBlend(const PlaneSamples& mr, const SliceOverlay& overlay, SlicePixels& pixels)
{
  const auto opacity = static_cast<float>(std::clamp(overlay.opacity, 0.0, 1.0));
  const float warm = 4.0F * opacity * (1.0F - opacity); // plain grey if only the MR is visible
  std::array<float, 3> white{};
  for (std::size_t c = 0; c < 3; ++c)
    white[c] = (255.0F + warm * (kWarm[c] - 255.0F)) / 255.0F;
  forEachSample(mr, pixels,
                [&](std::uint8_t* pixel, float value, int, int)
                {
                  if (std::isnan(value))
                    return;
                  const float grey = greyOf(value, overlay.window);
                  blend(pixel, {grey * white[0], grey * white[1], grey * white[2]}, opacity);
                });
}

void paintAlone(std::uint8_t* pixel, float value, const GreyWindow& window)
{
  if (std::isnan(value))
    std::copy(kOutsideMr.begin(), kOutsideMr.end(), pixel);
  else
    std::fill_n(pixel, 3, greyOf(value, window));
}

void paintChecker(const PlaneSamples& mr, const SliceOverlay& overlay, const SliceGeometry& slice,
                  SlicePixels& pixels)
{
  const double side = checkerSide(slice.mmPerPixel());
  const SliceAxes& axes = slice.axes();
  const auto square = [side](const Eigen::Vector3d& patient, const Eigen::Vector3d& axis)
  { return static_cast<long>(std::floor(patient.dot(axis) / side)); };
  forEachSample(mr, pixels,
                [&](std::uint8_t* pixel, float value, int column, int row)
                {
                  const Eigen::Vector3d patient = slice.patientFromPixel(column, row);
                  if ((square(patient, axes.right) + square(patient, axes.down)) % 2 != 0)
                    paintAlone(pixel, value, overlay.window);
                });
}
} // namespace

const char* nameOf(OverlayMode mode)
{
  constexpr const char* names[] = {"blend", "edges", "checker"};
  return names[static_cast<std::size_t>(mode)];
}

GreyWindow suggestMrWindow(const volume::IntensityHistogram& histogram)
{
  if (histogram.count() == 0)
    return {1.0, 0.5};
  const double top = histogram.percentile(0.998);
  const double bottom = histogram.range().min;
  const double background = bottom + 0.06 * (top - bottom);
  const double black = std::min(histogram.percentile(0.02, background), background);
  const double white = histogram.percentile(0.995, background);
  const double width = white - black;
  // A constant image: grey.
  return width > 0.0 ? GreyWindow{width, 0.5 * (white + black)} : GreyWindow{1.0, black};
}

SliceOverlay overlayOf(const scene::ImagePart& mr)
{
  SliceOverlay overlay;
  overlay.mr = mr.volume.get();
  overlay.mrFromCt = mr.mrFromCt;
  overlay.registered = mr.registered;
  if (overlay.mr)
    overlay.window = suggestMrWindow(volume::IntensityHistogram(*overlay.mr));
  return overlay;
}

EdgeLevels edgeLevels(const volume::IntensityScale& scale)
{
  const auto at = [&scale](double hounsfield)
  { return scale.calibrated ? hounsfield : appearance::onScale(hounsfield, scale); };
  return {static_cast<float>(scale.iso), static_cast<float>(at(-400.0)),
          static_cast<float>(at(150.0) - at(0.0))};
}

double checkerSide(double mmPerPixel)
{
  return scaleBarLength(kSquare * mmPerPixel * 1.4);
}

std::uint8_t greyOf(float value, const GreyWindow& window)
{
  if (!(window.width > 0.0))
    return value > window.level ? 255 : 0;
  const double grey = 255.0 * ((static_cast<double>(value) - window.level) / window.width + 0.5);
  return static_cast<std::uint8_t>(grey > 0.0 ? std::min(grey, 255.0) + 0.5 : 0.0);
}

void blend(std::uint8_t* pixel, const std::array<float, 3>& color, float share)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    const float mixed = static_cast<float>(pixel[c]) * (1.0F - share) + color[c] * share;
    pixel[c] = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0F, 255.0F)));
  }
}

void paintOverlay(const SliceOverlay& overlay, const SliceGeometry& slice, const PlaneSamples& mr,
                  SlicePixels& pixels)
{
  switch (overlay.mode)
  {
  case OverlayMode::Blend:
    return paintBlend(mr, overlay, pixels);
  case OverlayMode::Edges:
    return forEachSample(mr, pixels,
                         [&](std::uint8_t* pixel, float value, int, int)
                         { paintAlone(pixel, value, overlay.window); });
  case OverlayMode::Checker:
    return paintChecker(mr, overlay, slice, pixels);
  }
}

void paintEdges(const PlaneSamples& ct, const EdgeLevels& levels, double mmPerPixel,
                SlicePixels& pixels)
{
  const auto minSlope = static_cast<float>(levels.slope * mmPerPixel);
  const auto bone = contours(ct, levels.bone, minSlope);
  const auto skin = contours(ct, levels.skin, minSlope);
  const auto paint =
      [&pixels](const std::vector<float>& covered, const std::array<float, 3>& color, float most)
  {
    for (std::size_t n = 0; n < covered.size(); ++n)
      if (covered[n] > 0.0F)
        blend(&pixels.rgb[3 * n], color, most * covered[n]);
  };
  const auto draw = [&](const std::vector<ContourSegment>& lines, float width,
                        const std::array<float, 3>& color, float most)
  { paint(coverage(lines, ct.width, ct.height, width), color, most); };
  const auto floats = [](const std::array<std::uint8_t, 3>& color)
  {
    return std::array<float, 3>{static_cast<float>(color[0]), static_cast<float>(color[1]),
                                static_cast<float>(color[2])};
  };
  for (const auto* lines : {&skin, &bone})
    draw(*lines, kLineWidth + kCasing, {0.0F, 0.0F, 0.0F}, kCasingShare);
  draw(skin, kLineWidth, floats(kSkinEdge), 1.0F);
  draw(bone, kLineWidth, floats(kBoneEdge), 1.0F);
}

} // namespace petrous::presenters
