#include "petrous/Rendering/RenderQuality.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::rendering
{

namespace
{
void require(bool holds, const char* name, double value, const char* range)
{
  if (holds)
    return;
  throw core::InvalidParameter(std::string("picture quality: ") + name + " is " +
                               core::plainText(value) + "; it must be " + range);
}
} // namespace

void RenderQuality::validate() const
{
  // Drivers terminate a loop, and with it the ray, after about 65000 iterations.
  require(step >= 0.05 && step <= 100.0, "step", step, "0.05 to 100 voxels");
  require(bisections >= 0 && bisections <= 24, "bisections", bisections, "0 to 24");
  require(brick == 4 || brick == 8 || brick == 16, "brick", brick, "4, 8 or 16 voxels");
  require(termination >= 0.0 && termination <= 1.0, "termination", termination, "0 to 1");
  require(tableSize >= 16 && tableSize <= 4096, "tableSize", tableSize, "16 to 4096");
  require(maskBits == 8 || maskBits == 16, "maskBits", maskBits, "8 or 16");
  require(imageScale >= 0.1 && imageScale <= 1.0, "imageScale", imageScale, "0.1 to 1");
  require(largestTexture == 0 || largestTexture >= 16, "largestTexture", largestTexture,
          "0 (what the driver takes) or at least 16 texels");
  require(filterBits == 0 || (filterBits >= 4 && filterBits <= kExactFilterBits), "filterBits",
          filterBits, "0 (what the card has) or 4 to 16");
}

namespace
{
// Fraction of the frame time due to steps; the rest is setup, refinement and shading.
constexpr double kStepShare = 0.5;
constexpr double kStepsFromScale = 0.5; // below this scale the step length increases as well
constexpr double kReserve = 0.85;       // of the frame time; the rest is for all but the volume

double stepCost(double step)
{
  return (1.0 - kStepShare) + kStepShare * InteractionQuality::kMaxStep / step;
}
} // namespace

InteractionQuality::InteractionQuality(double hz)
  : m_hz(hz)
{
  if (!(hz >= 1.0 && hz <= 240.0))
    throw core::InvalidParameter("interaction: the rate must lie within 1 to 240 Hz");
}

RenderQuality InteractionQuality::coarser(const RenderQuality& full) const noexcept
{
  RenderQuality quality = full;
  quality.exactSamples = false;
  if (m_cost == 0.0)
  {
    quality.imageScale = std::min(full.imageScale, 0.5);
    return quality;
  }
  return fitted(full, kReserve * 1000.0 / m_hz);
}

RenderQuality InteractionQuality::fitted(const RenderQuality& full, double budget) const noexcept
{
  RenderQuality quality = full;
  quality.exactSamples = false;
  double scale = std::sqrt(budget / (m_cost * stepCost(full.step)));
  if (scale < kStepsFromScale)
  {
    quality.step = std::max(full.step, kMaxStep);
    scale = std::min(kStepsFromScale, std::sqrt(budget / (m_cost * stepCost(quality.step))));
  }
  // Quantized to 1/20, so that the picture's size does not change with every frame.
  scale = std::floor(20.0 * scale) / 20.0;
  quality.imageScale = std::min(std::max(scale, kSmallestScale), full.imageScale);
  return quality;
}

std::optional<InteractionQuality::Foveated> InteractionQuality::foveated(const RenderQuality& full,
                                                                         double area) const noexcept
{
  constexpr double kLeastArea = 0.25; // of what is wanted
  if (m_cost == 0.0 || !(area > 0.0 && area <= 1.0))
    return std::nullopt;
  Foveated frame;
  frame.rest = coarser(full);
  if (frame.rest.imageScale >= full.imageScale)
    return std::nullopt;
  const double budget = kReserve * 1000.0 / m_hz;
  const double whole = m_cost * stepCost(full.step); // ms, of the full picture
  const double least = std::min(kFoveaScale, full.imageScale);
  double scale = std::floor(20.0 * std::sqrt(kFoveaShare * budget / (whole * area))) / 20.0;
  scale = std::clamp(scale, least, full.imageScale);
  frame.area = std::clamp(kFoveaShare * budget / (whole * scale * scale), kLeastArea * area, area);
  frame.fovea = full;
  frame.fovea.exactSamples = false;
  frame.fovea.imageScale = scale;
  const double left = budget - frame.area * scale * scale * whole;
  frame.rest = fitted(full, std::max(left, (1.0 - kFoveaShare) * budget));
  return frame.rest.imageScale < scale ? std::optional(frame) : std::nullopt;
}

double InteractionQuality::workOf(const RenderQuality& quality) noexcept
{
  return quality.imageScale * quality.imageScale * stepCost(quality.step);
}

double InteractionQuality::workOf(const Foveated& frame) noexcept
{
  return workOf(frame.rest) + frame.area * workOf(frame.fovea);
}

void InteractionQuality::frameTook(double milliseconds, const RenderQuality& quality) noexcept
{
  frameTook(milliseconds, workOf(quality));
}

void InteractionQuality::frameTook(double milliseconds, double work) noexcept
{
  if (!(milliseconds > 0.0) || !std::isfinite(milliseconds) || !(work > 0.0))
    return;
  const double cost = milliseconds / work;
  m_cost = m_cost == 0.0 ? cost : 0.6 * m_cost + 0.4 * cost;
}

} // namespace petrous::rendering
