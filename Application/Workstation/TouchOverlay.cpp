#include "TouchOverlay.h"

#include <cmath>

#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace petrous::workstation
{

namespace
{
// Less is not seen; a tool that rests must let the picture come to rest.
constexpr double kPlace = 0.02;   // mm
constexpr double kHeading = 1e-3; // rad
constexpr double kForce = 0.03;   // N
// Pixels: right of the force's bar and its number, above the letter of the lower edge.
constexpr double kReadingLeft = 76.0;
constexpr double kReadingBottom = 48.0;
constexpr int kReadingSize = 17;
} // namespace

TouchOverlay::TouchOverlay(vtkRenderer& renderer, double burrRadius, bool handpiece)
  : m_renderer(&renderer)
  , m_burrRadius(burrRadius)
  , m_handpiece(handpiece)
  , m_view(burrRadius)
{
  m_view.addTo(&renderer);
  m_force.addTo(&renderer);
  vtkTextProperty* look = m_reading->GetTextProperty();
  look->SetFontFamilyToArial();
  look->SetFontSize(kReadingSize);
  look->SetColor(0.93, 0.95, 0.98);
  look->SetBackgroundColor(0.06, 0.07, 0.09);
  look->SetBackgroundOpacity(0.55);
  look->SetLineSpacing(1.2);
  m_reading->SetPosition(kReadingLeft, kReadingBottom);
  m_reading->PickableOff();
  m_reading->SetVisibility(0);
  renderer.AddViewProp(m_reading);
}

TouchOverlay::~TouchOverlay()
{
  m_view.removeFrom(m_renderer);
  m_force.removeFrom(m_renderer);
  m_renderer->RemoveViewProp(m_reading);
}

bool TouchOverlay::setReading(const std::string& text)
{
  if (text == m_text)
    return false;
  m_text = text;
  m_reading->SetInput(text.c_str());
  m_reading->SetVisibility(text.empty() ? 0 : 1);
  return true;
}

bool TouchOverlay::update(const simulation::TickRecord& record)
{
  auto tool = m_view.update(record);
  if (tool)
    tool->handpiece = m_handpiece;
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
