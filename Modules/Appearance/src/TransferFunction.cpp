#include "petrous/Appearance/TransferFunction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::appearance
{

namespace
{

void check(const std::vector<ControlPoint>& points)
{
  const auto refuse = [](std::size_t i, const char* what)
  {
    throw core::InvalidParameter("transfer function: point " + std::to_string(i + 1) + ": " + what);
  };
  if (points.empty())
    throw core::InvalidParameter("transfer function: at least one point is needed");
  const auto outside = [](float x) { return !(x >= 0.0F && x <= 1.0F); };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const ControlPoint& point = points[i];
    if (!std::isfinite(point.value))
      refuse(i, "the value must be a finite number");
    if (i > 0 && !(point.value > points[i - 1].value))
      refuse(i, "values must rise from point to point");
    if (std::any_of(point.color.begin(), point.color.end(), outside))
      refuse(i, "colour must lie in 0 to 1");
    if (outside(point.opacity))
      refuse(i, "opacity (of 1 mm) must lie in 0 to 1");
    if (outside(point.specular))
      refuse(i, "specular must lie in 0 to 1");
  }
}

double extinctionOf(double opacity)
{
  return -std::log1p(-std::min(opacity, TransferFunction::kLargestOpacity));
}

} // namespace

TransferFunction::TransferFunction(std::vector<ControlPoint> points)
  : m_points(std::move(points))
{
  check(m_points);
}

TransferFunction TransferFunction::constant(const std::array<float, 3>& color, float opacity,
                                            float specular)
{
  return TransferFunction({ControlPoint{0.0, color, opacity, specular}});
}

TransferFunction::Optics TransferFunction::at(double value) const noexcept
{
  const auto after = std::upper_bound(m_points.begin(), m_points.end(), value,
                                      [](double v, const ControlPoint& p) { return v < p.value; });
  const bool first = after == m_points.begin() || std::isnan(value);
  const ControlPoint& a = first ? m_points.front() : *(after - 1);
  const ControlPoint& b = first ? a : (after == m_points.end() ? a : *after);
  const double w = b.value > a.value ? (value - a.value) / (b.value - a.value) : 0.0;
  const auto mix = [w](double x, double y) { return x + (y - x) * w; };
  Optics optics;
  for (std::size_t c = 0; c < 3; ++c)
    optics.color[c] = mix(a.color[c], b.color[c]);
  optics.extinction = extinctionOf(mix(a.opacity, b.opacity));
  optics.specular = mix(a.specular, b.specular);
  return optics;
}

bool TransferFunction::transparent() const noexcept
{
  return std::all_of(m_points.begin(), m_points.end(),
                     [](const ControlPoint& point) { return point.opacity == 0.0F; });
}

bool operator==(const ControlPoint& a, const ControlPoint& b) noexcept
{
  return a.value == b.value && a.color == b.color && a.opacity == b.opacity &&
         a.specular == b.specular;
}

bool operator==(const TransferFunction& a, const TransferFunction& b) noexcept
{
  return a.points() == b.points();
}

} // namespace petrous::appearance
