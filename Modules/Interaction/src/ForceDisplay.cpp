#include "petrous/Interaction/ForceDisplay.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkArrowSource.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWeakPointer.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

class vtkActor2D;
class vtkPoints;
class vtkRenderer;
class vtkTextActor;

class vtkActor;
class vtkArrowSource;

namespace petrous::interaction
{

/// An arrow whose thickness is independent of its length. Drawn on top of all opaque geometry and
/// tissue.
class ForceArrow
{
public:
  ForceArrow();
  ~ForceArrow();

  vtkActor* actor() const { return m_actor; }

  void hide();

  /// from, along  patient mm; |along| > 0 is the arrow's length
  /// thickness    mm, of its shaft; less for a short arrow
  void show(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double thickness,
            const Eigen::Vector3d& color);

private:
  vtkNew<vtkArrowSource> m_source;
  vtkNew<vtkActor> m_actor;
};

namespace
{
// Relative to the shaft's thickness.
constexpr double kTipLength = 4.0;
constexpr double kTipRadius = 1.4;
// Tip of a short arrow, relative to its length.
constexpr double kMaxTip = 0.45;
} // namespace

ForceArrow::ForceArrow()
{
  m_source->SetShaftResolution(16);
  m_source->SetTipResolution(24);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(m_source->GetOutputPort());
  m_actor->SetMapper(mapper);
  m_actor->PickableOff();
  // Mostly ambient: the colour encodes the magnitude, whatever the direction.
  m_actor->GetProperty()->SetAmbient(0.5);
  m_actor->GetProperty()->SetDiffuse(0.5);
  m_actor->GetProperty()->SetSpecular(0.0);
  // In front of everything, keeping the depth order of its own parts: the force on the hand mostly
  // points into the handpiece, which would hide it.
  m_actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Depth::Impl", true, "//VTK::Depth::Impl\n  gl_FragDepth = 0.01 * gl_FragCoord.z;\n",
      false);
  hide();
}

ForceArrow::~ForceArrow() = default;

void ForceArrow::hide()
{
  m_actor->SetVisibility(0);
}

void ForceArrow::show(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double thickness,
                      const Eigen::Vector3d& color)
{
  // The source arrow has length 1 along x.
  const double length = along.norm();
  const double thin = std::min(thickness, kMaxTip * length / kTipLength);
  m_source->SetTipLength(kTipLength * thin / length);
  m_source->SetTipRadius(kTipRadius * thin / length);
  m_source->SetShaftRadius(0.5 * thin / length);
  const Eigen::Matrix3d turn =
      length *
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), along).toRotationMatrix();
  vtkNew<vtkMatrix4x4> pose;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose->SetElement(row, column, turn(row, column));
    pose->SetElement(row, 3, from[row]);
  }
  m_actor->SetUserMatrix(pose);
  m_actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
  m_actor->SetVisibility(1);
}

/// A vertical bar in the lower left corner, starting at 0, with a mark at 1 N and the force as text
/// above it.
class ForceBar
{
public:
  ForceBar();
  ~ForceBar();

  void addTo(vtkRenderer* renderer) const;
  void removeFrom(vtkRenderer* renderer) const;
  void setShown(bool shown);

  /// force      N
  /// fullScale  N at the top of the bar; larger forces fill it
  /// pixels     screen pixels per bar pixel
  void show(double force, double fullScale, double pixels, const Eigen::Vector3d& color);

private:
  enum Part
  {
    Plate,
    Filled,
    Empty,
    Mark,
    kParts
  };
  struct Quad
  {
    double left, bottom, right, top;
  };
  void place(Part part, const std::vector<Quad>& quads);

  std::array<vtkNew<vtkPolyData>, kParts> m_quads;
  std::array<vtkNew<vtkActor2D>, kParts> m_actors;
  vtkNew<vtkTextActor> m_text;
  mutable vtkWeakPointer<vtkRenderer> m_renderer;
  std::string m_words;
};

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
constexpr double kPointsPerInch = 72.0;

constexpr double kEmptyColor[3] = {0.22, 0.24, 0.27};
constexpr double kMarkColor[3] = {0.85, 0.87, 0.90};
constexpr double kPlateRim = 3.0;
// On bone and on a white background number and mark are read on it.
constexpr double kPlateColor[3] = {0.06, 0.07, 0.09};
constexpr double kPlateOpacity = 0.8;

} // namespace

ForceBar::ForceBar()
{
  for (std::size_t part = 0; part < kParts; ++part)
  {
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(m_quads[part]);
    m_actors[part]->SetMapper(mapper);
    m_actors[part]->PickableOff();
  }
  m_actors[Plate]->GetProperty()->SetColor(kPlateColor);
  m_actors[Plate]->GetProperty()->SetOpacity(kPlateOpacity);
  m_actors[Empty]->GetProperty()->SetColor(kEmptyColor);
  m_actors[Mark]->GetProperty()->SetColor(kMarkColor);
  m_text->GetTextProperty()->SetColor(kMarkColor);
  m_text->GetTextProperty()->SetFontFamilyToArial();
  m_text->GetTextProperty()->SetBackgroundColor(kPlateColor);
  m_text->GetTextProperty()->SetBackgroundOpacity(kPlateOpacity);
  m_text->PickableOff();
  show(0.0, 1.0, 1.0, {0.0, 0.0, 0.0});
}

ForceBar::~ForceBar() = default;

void ForceBar::addTo(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->AddViewProp(actor);
  renderer->AddViewProp(m_text);
  m_renderer = renderer;
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

void ForceBar::place(Part part, const std::vector<Quad>& quads)
{
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> cells;
  for (const Quad& quad : quads)
  {
    const vtkIdType first = corners->InsertNextPoint(quad.left, quad.bottom, 0.0);
    corners->InsertNextPoint(quad.right, quad.bottom, 0.0);
    corners->InsertNextPoint(quad.right, quad.top, 0.0);
    corners->InsertNextPoint(quad.left, quad.top, 0.0);
    cells->InsertNextCell({first, first + 1, first + 2, first + 3});
  }
  m_quads[part]->SetPoints(corners);
  m_quads[part]->SetPolys(cells);
}

void ForceBar::show(double force, double fullScale, double pixels, const Eigen::Vector3d& color)
{
  const auto heightOf = [&](double newtons)
  { return pixels * (kBottom + kHeight * std::clamp(newtons / fullScale, 0.0, 1.0)); };
  const double left = pixels * kLeft;
  const double right = left + pixels * kWidth;
  const double top = heightOf(fullScale);
  const double bottom = pixels * kBottom;
  const double filled = heightOf(force);
  place(Filled, {{left, bottom, right, filled}});
  place(Empty, {{left, filled, right, top}});
  const double markLeft = right + pixels * kMarkGap;
  const double markRight = markLeft + pixels * kMarkLength;
  const double markBottom = heightOf(1.0) - 0.5 * pixels;
  const double markTop = heightOf(1.0) + 0.5 * pixels;
  place(Mark, {{markLeft, markBottom, markRight, markTop}});
  // Around them and not below: which of two overlays at one place is seen depends on the window's
  // depth test.
  const double rim = pixels * kPlateRim;
  place(Plate, {{left - rim, bottom - rim, markRight + rim, bottom},
                {left - rim, bottom, left, top},
                {right, bottom, markLeft, top},
                {markLeft, bottom, markRight, std::min(markBottom, top)},
                {markLeft, std::min(markTop, top), markRight, top},
                {markRight, bottom, markRight + rim, top}});
  m_actors[Filled]->GetProperty()->SetColor(color.x(), color.y(), color.z());

  const std::string words = core::fixedText(force, 1) + " N";
  if (m_words != words) // text rendering is expensive
  {
    m_words = words;
    m_text->SetInput(words.c_str());
  }
  vtkRenderWindow* window = m_renderer ? m_renderer->GetRenderWindow() : nullptr;
  const double byVtk = window ? window->GetDPI() / kPointsPerInch : 1.0; // it scales letters itself
  m_text->GetTextProperty()->SetFontSize(
      std::max(1, static_cast<int>(std::lround(pixels * kTextSize / byVtk))));
  m_text->SetPosition(left, top + pixels * kTextGap);
}

namespace
{

using Eigen::Vector3d;

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("force display: ") + what);
}

bool within(double value, double least, double most)
{
  return value >= least && value <= most; // false for NaN
}

const ForceLook& checked(const ForceLook& look)
{
  check(look.millimetresPerNewton > 0.0 && look.millimetresPerNewton <= 1000.0,
        "the arrow's length must lie within 0 to 1000 mm/N");
  check(within(look.fullScale, 0.1, 1000.0), "the full scale must lie within 0.1 to 1000 N");
  check(within(look.least, 0.0, 1000.0), "the least force shown must not be below 0 N");
  check(look.thickness > 0.0 && look.thickness <= 20.0,
        "the arrow's thickness must lie within 0 to 20 mm");
  check(within(look.pixels, 0.25, 8.0), "the bar's pixels must lie within 0.25 to 8");
  return look;
}

// Light work, a surgeon's usual upper bound (2 N), too much (5 N). The three also differ in
// lightness, for red-green colour-blind users.
Vector3d colorOf(double force)
{
  const Vector3d light(0.45, 0.88, 0.92);
  const Vector3d usual(0.98, 0.74, 0.20);
  const Vector3d strong(0.86, 0.16, 0.12);
  if (force <= 2.0)
    return light + 0.5 * force * (usual - light);
  return usual + std::min((force - 2.0) / 3.0, 1.0) * (strong - usual);
}

// Smaller changes are not visible.
constexpr double kLeastForce = 0.01; // N
constexpr double kLeastPlace = 0.01; // mm

Vector3d forceIn(const session::TickRecord& record)
{
  using Parameters = session::ServoParameters;
  const auto& set = record.input.parameters;
  // Forces on a hovering pointer's tool are not forces on the hand.
  const bool hovers = (set.constantThrust & Parameters::kPointer) != 0 &&
                      (set.constantThrust & Parameters::kPressed) == 0;
  const bool given = record.fault == 0 && !set.pause && !hovers;
  const Vector3d force = record.wrench.wrench().linear;
  return given && force.allFinite() ? force : Vector3d(Vector3d::Zero());
}

} // namespace

class ForceDisplay::Implementation
{
public:
  void show()
  {
    const double size = force.norm();
    const Vector3d color = colorOf(size);
    bar.show(size, look.fullScale, look.pixels, color);
    if (!arrowShown || size < look.least || size == 0.0)
      return arrow.hide();
    const double length = look.millimetresPerNewton * std::min(size, look.fullScale);
    arrow.show(place, length / size * force, look.thickness, color);
  }

  ForceLook look;
  ForceArrow arrow;
  ForceBar bar;
  Vector3d force{0.0, 0.0, 0.0}; // N
  Vector3d place{0.0, 0.0, 0.0};
  bool arrowShown = true;
};

ForceDisplay::ForceDisplay(const ForceLook& look)
  : m_implementation(std::make_unique<Implementation>())
{
  setLook(look);
}

ForceDisplay::~ForceDisplay() = default;

void ForceDisplay::addTo(vtkRenderer* renderer) const
{
  renderer->AddViewProp(m_implementation->arrow.actor());
  m_implementation->bar.addTo(renderer);
}

void ForceDisplay::removeFrom(vtkRenderer* renderer) const
{
  renderer->RemoveViewProp(m_implementation->arrow.actor());
  m_implementation->bar.removeFrom(renderer);
}

void ForceDisplay::setLook(const ForceLook& look)
{
  m_implementation->look = checked(look);
  m_implementation->show();
}

void ForceDisplay::setArrowShown(bool shown)
{
  m_implementation->arrowShown = shown;
  m_implementation->show();
}

void ForceDisplay::setBarShown(bool shown)
{
  m_implementation->bar.setShown(shown);
}

void ForceDisplay::update(const session::TickRecord& record)
{
  const Vector3d force = forceIn(record);
  const Vector3d place = record.proxy.pose().position;
  const auto isShown = [this](const Vector3d& one)
  { return one.norm() >= m_implementation->look.least; };
  // A hand at rest trembles: props that were changed would begin the picture at rest anew.
  if ((force - m_implementation->force).norm() < kLeastForce &&
      (place - m_implementation->place).norm() < kLeastPlace &&
      isShown(force) == isShown(m_implementation->force))
    return;
  m_implementation->force = force;
  m_implementation->place = place;
  m_implementation->show();
}

double ForceDisplay::force() const noexcept
{
  return m_implementation->force.norm();
}

} // namespace petrous::interaction
