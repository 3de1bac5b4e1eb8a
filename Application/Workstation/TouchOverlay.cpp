#include "TouchOverlay.h"

#include <cmath>

#include <vtkRenderer.h>

namespace petrous::workstation
{

namespace
{
// Less is not seen; a tool that rests must let the picture come to rest.
constexpr double kPlace = 0.02;   // mm
constexpr double kHeading = 1e-3; // rad
constexpr double kForce = 0.03;   // N
} // namespace

TouchOverlay::TouchOverlay(vtkRenderer& renderer, double burrRadius)
  : m_renderer(&renderer)
  , m_burrRadius(burrRadius)
  , m_view(burrRadius)
{
  m_view.addTo(&renderer);
  m_force.addTo(&renderer);
}

TouchOverlay::~TouchOverlay()
{
  m_view.removeFrom(m_renderer);
  m_force.removeFrom(m_renderer);
}

bool TouchOverlay::update(const simulation::TickRecord& record)
{
  const auto tool = m_view.update(record);
  m_force.update(record);
  const auto same = [](double a, double b, double tolerance)
  { return std::abs(a - b) < tolerance; };
  const bool rests = m_tool && tool && (m_tool->center - tool->center).norm() < kPlace &&
                     (m_tool->axisToHand - tool->axisToHand).norm() < kHeading &&
                     m_tool->drilling == tool->drilling &&
                     same(m_shownForce, m_force.force(), kForce) &&
                     same(m_shownLag, m_view.lag(), kPlace);
  if (rests || !tool)
    return false;
  m_tool = tool;
  m_shownForce = m_force.force();
  m_shownLag = m_view.lag();
  return true;
}

} // namespace petrous::workstation
