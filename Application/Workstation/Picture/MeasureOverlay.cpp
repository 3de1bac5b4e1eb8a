#include "MeasureOverlay.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "PixelsPerPoint.h"
#include "Theme.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::workstation
{

namespace
{

// Where a point is one pixel.
constexpr int kLabelSize = 15;     // px
constexpr double kAway = 9.0;      // px, of a label from its handle
constexpr double kLine = 22.0;     // px, from label to label
constexpr double kPerLetter = 8.0; // px, about
constexpr double kLineWidth = 2.0; // px
constexpr double kDot = 7.0;       // px, of a handle
constexpr double kHalo = 1.5;      // px, around it
constexpr double kPlate = 0.8;     // opacity behind letters, which are legible on white, too
constexpr double kFaint = 0.2;     // opacity of a label where the tool is

bool same(const DrawnMeasure& a, const DrawnMeasure& b)
{
  return std::tie(a.index, a.points, a.closed, a.handles, a.label, a.chosen, a.draft, a.form) ==
             std::tie(b.index, b.points, b.closed, b.handles, b.label, b.chosen, b.draft, b.form) &&
         a.color == b.color;
}

// The corners of a handle about the point that is dragged, for a radius of 1. `along`: unit, of the
// line that ends there.
std::vector<Eigen::Vector2d> cornersOf(DrawnMeasure::Form form, const Eigen::Vector2d& along)
{
  constexpr int kRound = 16;
  constexpr double kTurn = 2.0 * 3.14159265358979323846 / kRound;
  switch (form)
  {
  case DrawnMeasure::Form::Square:
    return {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
  case DrawnMeasure::Form::Diamond:
    return {{0.0, -1.8}, {1.8, 0.0}, {0.0, 1.8}, {-1.8, 0.0}};
  case DrawnMeasure::Form::Arrow:
  {
    const Eigen::Vector2d across(-along[1], along[0]);
    return {1.5 * along, 1.5 * across - 1.5 * along, -1.5 * across - 1.5 * along};
  }
  case DrawnMeasure::Form::Dot:
    break;
  }
  std::vector<Eigen::Vector2d> corners;
  for (int n = 0; n < kRound; ++n)
    corners.emplace_back(std::cos(n * kTurn), std::sin(n * kTurn));
  return corners;
}

void setColor(vtkActor2D& actor, const QColor& color, double opacity)
{
  actor.GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  actor.GetProperty()->SetOpacity(opacity);
}

} // namespace

struct MeasureOverlay::Drawn
{
  vtkNew<vtkPolyData> line;
  std::array<vtkNew<vtkPolyData>, 2> handles;        // halo and handles, of placeHandles
  std::array<vtkSmartPointer<vtkActor2D>, 4> actors; // halo and line, halo and handles
  vtkNew<vtkTextActor> label;
  vtkNew<vtkCoordinate> anchor;
  Eigen::Vector3d at = Eigen::Vector3d::Zero(); // of the label
};

MeasureOverlay::MeasureOverlay(vtkRenderer& renderer)
  : m_renderer(&renderer)
{
}

MeasureOverlay::~MeasureOverlay()
{
  set({});
}

bool MeasureOverlay::set(const std::vector<DrawnMeasure>& measures)
{
  if (std::equal(measures.begin(), measures.end(), m_measures.begin(), m_measures.end(), same))
    return false;
  removeProps();
  m_drawn.clear();
  m_measures = measures;
  for (const DrawnMeasure& measure : m_measures)
  {
    auto one = std::make_unique<Drawn>();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Eigen::Vector3d& point : measure.points)
      points->InsertNextPoint(point.data());
    vtkNew<vtkCellArray> edges;
    const auto count = static_cast<vtkIdType>(measure.points.size());
    if (count > 1)
    {
      edges->InsertNextCell(static_cast<int>(count + (measure.closed ? 1 : 0)));
      for (vtkIdType n = 0; n < count + (measure.closed ? 1 : 0); ++n)
        edges->InsertCellPoint(n % count);
    }
    one->line->SetPoints(points);
    one->line->SetLines(edges);
    for (std::size_t n = 0; n < one->actors.size(); ++n)
    {
      const bool isHalo = n % 2 == 0;
      vtkNew<vtkPolyDataMapper2D> mapper;
      mapper->SetInputData(n < 2 ? one->line : one->handles[n - 2]);
      mapper->TransformCoordinateUseDoubleOn();
      vtkNew<vtkCoordinate> world;
      world->SetCoordinateSystemToWorld();
      mapper->SetTransformCoordinate(world);
      auto actor = vtkSmartPointer<vtkActor2D>::New();
      actor->SetMapper(mapper);
      setColor(*actor, isHalo ? QColor(0, 0, 0) : measure.color, isHalo ? 0.75 : 1.0);
      actor->PickableOff();
      one->actors[n] = actor;
    }
    if (!measure.points.empty())
      one->at =
          measure
              .points[measure.handles.empty() ? measure.points.size() - 1 : measure.handles.back()];
    one->anchor->SetCoordinateSystemToWorld();
    one->anchor->SetValue(one->at.x(), one->at.y(), one->at.z());
    one->label->SetInput(bytes(measure.label).c_str());
    vtkTextProperty* look = one->label->GetTextProperty();
    look->SetFontFamilyToArial();
    look->SetFontSize(kLabelSize);
    const QColor color = measure.color.lighter(115);
    look->SetColor(color.redF(), color.greenF(), color.blueF());
    look->SetBackgroundColor(0.04, 0.05, 0.06);
    look->SetBackgroundOpacity(kPlate);
    look->SetVerticalJustificationToBottom();
    if (measure.chosen)
    {
      look->FrameOn();
      look->SetFrameColor(color.redF(), color.greenF(), color.blueF());
    }
    vtkCoordinate* place = one->label->GetPositionCoordinate();
    place->SetCoordinateSystemToViewport();
    place->SetReferenceCoordinate(one->anchor);
    place->SetValue(kAway, kAway);
    one->label->PickableOff();
    m_drawn.push_back(std::move(one));
  }
  addProps();
  return true;
}

void MeasureOverlay::addProps()
{
  for (const auto& one : m_drawn)
    for (const auto& actor : one->actors)
      m_renderer->AddViewProp(actor);
  for (const auto& one : m_drawn) // over all lines and handles
    m_renderer->AddViewProp(one->label);
}

void MeasureOverlay::removeProps()
{
  for (const auto& one : m_drawn)
  {
    for (const auto& actor : one->actors)
      m_renderer->RemoveViewProp(actor);
    m_renderer->RemoveViewProp(one->label);
  }
}

void MeasureOverlay::raise()
{
  removeProps();
  addProps();
}

std::vector<Eigen::Vector3d> MeasureOverlay::handles() const
{
  std::vector<Eigen::Vector3d> all;
  for (const DrawnMeasure& measure : m_measures)
    for (const std::size_t handle : measure.handles)
      all.push_back(measure.points[handle]);
  return all;
}

// In the world, across the line of sight: each eye sees them where the point is.
void MeasureOverlay::placeHandles(const DrawnMeasure& measure, Drawn& drawn, double scale)
{
  if (measure.handles.empty())
    return;
  vtkCamera* camera = m_renderer->GetActiveCamera();
  const Eigen::Vector3d position(camera->GetPosition());
  const Eigen::Vector3d ahead(camera->GetDirectionOfProjection());
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d(camera->GetViewUp())).normalized();
  const Eigen::Vector3d up = right.cross(ahead);
  const double height = std::max(m_renderer->GetSize()[1], 1);
  const double radius = scale * (0.5 * kDot + (measure.chosen ? 1.0 : 0.0));
  for (std::size_t part = 0; part < drawn.handles.size(); ++part)
  {
    const double reach = radius + (part == 0 ? scale * kHalo : 0.0);
    vtkNew<vtkPoints> corners;
    corners->SetDataTypeToDouble();
    vtkNew<vtkCellArray> faces;
    for (const std::size_t handle : measure.handles)
    {
      const Eigen::Vector3d& at = measure.points[handle];
      const double mmPerPixel =
          2.0 *
          (camera->GetParallelProjection()
               ? camera->GetParallelScale()
               : ahead.dot(at - position) *
                     std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()))) /
          height;
      Eigen::Vector2d along = Eigen::Vector2d::UnitY();
      if (handle > 0)
      {
        const Eigen::Vector3d line = at - measure.points[handle - 1];
        const Eigen::Vector2d seen(right.dot(line), up.dot(line));
        along = seen.norm() > 1e-9 ? Eigen::Vector2d(seen.normalized()) : along;
      }
      const std::vector<Eigen::Vector2d> form = cornersOf(measure.form, along);
      faces->InsertNextCell(static_cast<int>(form.size()));
      for (const Eigen::Vector2d& corner : form)
      {
        const Eigen::Vector3d place =
            at + reach * mmPerPixel * (corner[0] * right + corner[1] * up);
        faces->InsertCellPoint(corners->InsertNextPoint(place.data()));
      }
    }
    drawn.handles[part]->SetPoints(corners);
    drawn.handles[part]->SetPolys(faces);
  }
}

std::optional<std::array<double, 2>> MeasureOverlay::pixelOf(const Eigen::Vector3d& patient) const
{
  vtkCamera* camera = m_renderer->GetActiveCamera();
  const Eigen::Vector3d position(camera->GetPosition());
  const Eigen::Vector3d ahead(camera->GetDirectionOfProjection());
  if (!camera->GetParallelProjection() && ahead.dot(patient - position) <= 0.0)
    return std::nullopt;
  m_renderer->SetWorldPoint(patient.x(), patient.y(), patient.z(), 1.0);
  m_renderer->WorldToDisplay();
  const double* const at = m_renderer->GetDisplayPoint();
  const int* const size = m_renderer->GetSize();
  return std::array<double, 2>{at[0], size[1] - at[1]};
}

// Of which the tool's outline consists, pixels from the upper left.
struct MeasureOverlay::Disc
{
  double x, y, radius;
};

std::vector<MeasureOverlay::Disc> MeasureOverlay::discsOf(const rendering::ToolPose& tool) const
{
  namespace shape = rendering::tool;
  std::vector<Disc> discs;
  if (!shape::isShown(tool))
    return discs;
  vtkCamera* camera = m_renderer->GetActiveCamera();
  const Eigen::Vector3d sideways = Eigen::Vector3d(camera->GetDirectionOfProjection())
                                       .cross(Eigen::Vector3d(camera->GetViewUp()))
                                       .normalized();
  const Eigen::Vector3d axis = tool.axisToHand.normalized();
  const auto add = [&](double along, double radius)
  {
    const Eigen::Vector3d center = tool.center + along * axis;
    const auto at = pixelOf(center);
    const auto rim = pixelOf(center + radius * sideways);
    if (at && rim)
      discs.push_back({(*at)[0], (*at)[1], std::hypot((*rim)[0] - (*at)[0], (*rim)[1] - (*at)[1])});
  };
  add(0.0, tool.radius);
  constexpr double kStep = 1.0; // mm
  const double length = shape::kShaftLength + (tool.handpiece ? shape::kHandpieceLength : 0.0);
  for (double along = kStep; along <= length; along += kStep)
    add(along, along <= shape::kShaftLength ? shape::shaftRadius(tool) : shape::kHandpieceRadius);
  return discs;
}

void MeasureOverlay::place(const std::optional<rendering::ToolPose>& tool,
                           const std::vector<Eigen::Vector3d>& others)
{
  if (m_drawn.empty())
    return;
  const std::vector<Disc> covered = tool ? discsOf(*tool) : std::vector<Disc>();
  struct Box
  {
    double left, right, low, high;
  };
  std::vector<Box> taken;
  const double scale = pixelsPerPoint(*m_renderer); // another one on another screen
  const double away = scale * kAway;
  const double line = scale * kLine;
  // A label lies on no handle, of its own or another's.
  const double reach = scale * (0.5 * kDot + 3.0);
  std::vector<Eigen::Vector3d> avoided = handles();
  avoided.insert(avoided.end(), others.begin(), others.end());
  for (const Eigen::Vector3d& handle : avoided)
    if (const auto at = pixelOf(handle))
      taken.push_back({(*at)[0] - reach, (*at)[0] + reach, (*at)[1] - reach, (*at)[1] + reach});
  for (std::size_t n = 0; n < m_drawn.size(); ++n)
  {
    Drawn& one = *m_drawn[n];
    const double wide = m_measures[n].chosen ? 1.0 : 0.0;
    for (std::size_t part = 0; part < one.actors.size(); ++part)
    {
      const double halo = part % 2 == 0 ? 1.0 : 0.0;
      vtkProperty2D* look = one.actors[part]->GetProperty();
      look->SetLineWidth(static_cast<float>(scale * (kLineWidth + 2.0 * halo + wide)));
    }
    const bool seen =
        std::all_of(m_measures[n].points.begin(), m_measures[n].points.end(),
                    [this](const Eigen::Vector3d& point) { return pixelOf(point).has_value(); });
    for (const auto& actor : one.actors)
      actor->SetVisibility(seen ? 1 : 0);
    one.label->SetVisibility(seen && !m_measures[n].label.isEmpty() ? 1 : 0);
    if (!seen)
      continue;
    placeHandles(m_measures[n], one, scale);
    const auto at = *pixelOf(one.at);
    const double width = scale * kPerLetter * m_measures[n].label.size();
    // At the right of its handle, but within the view.
    const double left = std::min(at[0] + away, std::max(m_renderer->GetSize()[0] - width, 0.0));
    double up = away;
    const auto boxOf = [&](double raised) {
      return Box{left, left + width, at[1] - raised - line, at[1] - raised};
    };
    for (std::size_t other = 0; other < taken.size(); ++other)
    {
      const Box box = boxOf(up);
      const Box& there = taken[other];
      if (box.left < there.right && box.right > there.left && box.low < there.high &&
          box.high > there.low)
      {
        up = at[1] - there.low + 1.0;
        other = static_cast<std::size_t>(-1);
      }
    }
    const Box box = boxOf(up);
    taken.push_back(box);
    const bool isOverTool = std::any_of(
        covered.begin(), covered.end(),
        [&box](const Disc& disc)
        {
          return std::hypot(disc.x - std::clamp(disc.x, box.left, box.right),
                            disc.y - std::clamp(disc.y, box.low, box.high)) < disc.radius;
        });
    vtkTextProperty* look = one.label->GetTextProperty();
    look->SetOpacity(isOverTool ? kFaint : 1.0);
    look->SetBackgroundOpacity(isOverTool ? kFaint * kPlate : kPlate);
    look->SetFrame(m_measures[n].chosen && !isOverTool ? 1 : 0);
    one.label->GetPositionCoordinate()->SetValue(left - at[0], up);
  }
}

} // namespace petrous::workstation
