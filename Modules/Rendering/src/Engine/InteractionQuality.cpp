#include "petrous/Rendering/InteractionQuality.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

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
  if (m_cost == 0.0)
  {
    quality.imageScale = std::min(full.imageScale, 0.5);
    return quality;
  }
  const double budget = kReserve * 1000.0 / m_hz;
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

void InteractionQuality::frameTook(double milliseconds, const RenderQuality& quality) noexcept
{
  if (!(milliseconds > 0.0) || !std::isfinite(milliseconds))
    return;
  const double pixels = quality.imageScale * quality.imageScale;
  const double cost = milliseconds / (pixels * stepCost(quality.step));
  m_cost = m_cost == 0.0 ? cost : 0.6 * m_cost + 0.4 * cost;
}

} // namespace petrous::rendering
