#include "ForceBar.h"

#include <algorithm>
#include <cmath>

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "petrous/Core/NumberText.h"

namespace petrous::interaction
{

namespace
{

// Pixels from the lower left corner.
constexpr double kLeft = 16.0;
constexpr double kBottom = 16.0;
constexpr double kWidth = 10.0;
constexpr double kHeight = 120.0;
constexpr double kMarkGap = 2.0;
constexpr double kMarkLength = 6.0;
constexpr double kTextGap = 6.0;
constexpr double kTextSize = 14.0;

constexpr double kEmptyColor[3] = {0.22, 0.24, 0.27};
constexpr double kMarkColor[3] = {0.85, 0.87, 0.90};

} // namespace

ForceBar::ForceBar()
{
  for (std::size_t part = 0; part < kParts; ++part)
  {
    m_corners[part]->SetNumberOfPoints(4);
    vtkNew<vtkCellArray> quad;
    quad->InsertNextCell({0, 1, 2, 3});
    vtkNew<vtkPolyData> data;
    data->SetPoints(m_corners[part]);
    data->SetPolys(quad);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    m_actors[part]->SetMapper(mapper);
    m_actors[part]->PickableOff();
  }
  m_actors[Empty]->GetProperty()->SetColor(kEmptyColor);
  m_actors[Mark]->GetProperty()->SetColor(kMarkColor);
  m_text->GetTextProperty()->SetColor(kMarkColor);
  m_text->GetTextProperty()->SetFontFamilyToArial();
  m_text->PickableOff();
  show(0.0, 1.0, 1.0, {0.0, 0.0, 0.0});
}

ForceBar::~ForceBar() = default;

void ForceBar::addTo(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->AddViewProp(actor);
  renderer->AddViewProp(m_text);
}

void ForceBar::removeFrom(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->RemoveViewProp(actor);
  renderer->RemoveViewProp(m_text);
}

void ForceBar::setShown(bool shown)
{
  for (const auto& actor : m_actors)
    actor->SetVisibility(shown ? 1 : 0);
  m_text->SetVisibility(shown ? 1 : 0);
}

void ForceBar::place(Part part, double left, double bottom, double right, double top)
{
  const auto& corners = m_corners[part];
  corners->SetPoint(0, left, bottom, 0.0);
  corners->SetPoint(1, right, bottom, 0.0);
  corners->SetPoint(2, right, top, 0.0);
  corners->SetPoint(3, left, top, 0.0);
  corners->Modified();
}

void ForceBar::show(double force, double fullScale, double pixels, const Eigen::Vector3d& color)
{
  const auto heightOf = [&](double newtons)
  { return pixels * (kBottom + kHeight * std::clamp(newtons / fullScale, 0.0, 1.0)); };
  const double left = pixels * kLeft;
  const double right = left + pixels * kWidth;
  const double top = heightOf(fullScale);
  place(Filled, left, pixels * kBottom, right, heightOf(force));
  place(Empty, left, heightOf(force), right, top);
  const double mark = heightOf(1.0);
  place(Mark, right + pixels * kMarkGap, mark - 0.5 * pixels,
        right + pixels * (kMarkGap + kMarkLength), mark + 0.5 * pixels);
  m_actors[Filled]->GetProperty()->SetColor(color.x(), color.y(), color.z());

  const std::string words = core::fixedText(force, 1) + " N";
  if (m_words != words) // text rendering is expensive
  {
    m_words = words;
    m_text->SetInput(words.c_str());
  }
  m_text->GetTextProperty()->SetFontSize(static_cast<int>(std::lround(pixels * kTextSize)));
  m_text->SetPosition(left, top + pixels * kTextGap);
}

} // namespace petrous::interaction
