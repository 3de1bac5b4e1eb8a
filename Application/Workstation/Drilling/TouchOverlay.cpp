#include "TouchOverlay.h"

#include <algorithm>
#include <cmath>

#include <vtkCamera.h>
#include <vtkCoordinate.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "PixelsPerPoint.h"

namespace petrous::workstation
{

namespace
{
// Smaller changes are not visible; with a resting tool, rendering must stop.
constexpr double kPlace = 0.02;   // mm
constexpr double kHeading = 1e-3; // rad
constexpr double kForce = 0.03;   // N
// Points: right of the force bar and its number, above the letter at the lower edge.
constexpr double kReadingLeft = 76.0;
constexpr double kReadingBottom = 48.0;
constexpr int kReadingSize = 17;
// Fractions of the view: below the letter at the upper edge.
constexpr double kWarningAcross = 0.5;
constexpr double kWarningUp = 0.93;

void setLook(vtkTextActor& actor)
{
  vtkTextProperty* look = actor.GetTextProperty();
  look->SetFontFamilyToArial();
  look->SetFontSize(kReadingSize);
  look->SetColor(0.93, 0.95, 0.98);
  look->SetBackgroundColor(0.06, 0.07, 0.09);
  look->SetBackgroundOpacity(0.8); // legible on a white background, too
  look->SetLineSpacing(1.2);
}

interaction::ForceLook forceLook(vtkRenderer& renderer)
{
  interaction::ForceLook look;
  look.pixels = std::clamp(pixelsPerPoint(renderer), 0.25, 8.0);
  return look;
}

bool say(vtkTextActor& actor, std::string& present, const std::string& text)
{
  if (text == present)
    return false;
  present = text;
  actor.SetInput(text.c_str());
  actor.SetVisibility(text.empty() ? 0 : 1);
  return true;
}
} // namespace

TouchOverlay::TouchOverlay(vtkRenderer& renderer, const rendering::ToolPose& form)
  : m_renderer(&renderer)
  , m_form(form)
  , m_view(form.radius, form.finish)
  , m_force(forceLook(renderer))
{
  m_view.addTo(&renderer);
  m_force.addTo(&renderer);
  setLook(*m_reading);
  const double scale = pixelsPerPoint(renderer);
  m_reading->SetPosition(scale * kReadingLeft, scale * kReadingBottom);
  setLook(*m_warning);
  vtkTextProperty* warning = m_warning->GetTextProperty();
  warning->SetColor(1.0, 0.78, 0.35);
  warning->BoldOn();
  warning->SetJustificationToCentered();
  warning->SetVerticalJustificationToTop();
  m_warning->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  m_warning->SetPosition(kWarningAcross, kWarningUp);
  for (vtkTextActor* actor : {m_reading.Get(), m_warning.Get()})
  {
    actor->PickableOff();
    actor->SetVisibility(0);
    renderer.AddViewProp(actor);
  }
}

TouchOverlay::~TouchOverlay()
{
  m_view.removeFrom(m_renderer);
  m_force.removeFrom(m_renderer);
  m_renderer->RemoveViewProp(m_reading);
  m_renderer->RemoveViewProp(m_warning);
}

bool TouchOverlay::shows(const rendering::ToolPose& form) const noexcept
{
  return m_form.radius == form.radius && m_form.handpiece == form.handpiece &&
         m_form.finish == form.finish && m_form.instrument == form.instrument;
}

bool TouchOverlay::setReading(const std::string& text)
{
  return say(*m_reading, m_text, text);
}

bool TouchOverlay::setWarning(const std::string& text)
{
  return say(*m_warning, m_warningText, text);
}

void TouchOverlay::setCovered(double share)
{
  m_warning->SetPosition(kWarningAcross, kWarningUp - share);
}

bool TouchOverlay::update(const session::TickRecord& record)
{
  auto tool = m_view.update(record);
  if (tool)
  {
    const double* eye = m_renderer->GetActiveCamera()->GetPosition();
    // It gives way to what is drilled.
    tool->instrument = m_form.instrument;
    tool->drilling = tool->drilling && !tool->instrument;
    tool->handpiece = m_form.handpiece && !interaction::hidesField(*tool, {eye[0], eye[1], eye[2]});
  }
  m_force.update(record);
  const auto same = [](double a, double b, double tolerance)
  { return std::abs(a - b) < tolerance; };
  const bool isTurned = m_tool && tool && tool->instrument &&
                        m_tool->rotation.angularDistance(tool->rotation) >= kHeading;
  const bool rests =
      m_tool && tool && !isTurned && (m_tool->center - tool->center).norm() < kPlace &&
      (m_tool->axisToHand - tool->axisToHand).norm() < kHeading &&
      m_tool->drilling == tool->drilling && m_tool->handpiece == tool->handpiece &&
      same(m_shownForce, m_force.force(), kForce) && same(m_shownLag, m_view.lag(), kPlace);
  if (rests || !tool)
    return false;
  m_tool = tool;
  m_shownForce = m_force.force();
  m_shownLag = m_view.lag();
  return true;
}

} // namespace petrous::workstation
