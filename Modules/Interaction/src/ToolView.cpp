#include "petrous/Interaction/ToolView.h"

#include <cmath>

#include <vtkActor.h>
#include <vtkLineSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "petrous/Core/Error.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::interaction
{

namespace
{
constexpr double kLeastPlace = 0.01;                // mm; less is not visible
constexpr double kGoldenTurn = 2.39996322972865332; // rad; no two pictures in a row are alike
} // namespace

ToolView::ToolView(double burrRadius, rendering::BurrFinish finish)
  : m_burrRadius(burrRadius)
  , m_finish(finish)
{
  if (!(burrRadius > 0.0 && burrRadius <= 100.0))
    throw core::InvalidParameter("tool view: the burr's radius must lie within 0 to 100 mm");
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(m_line->GetOutputPort());
  m_actor->SetMapper(mapper);
  m_actor->PickableOff();
  m_actor->SetVisibility(0);
  m_actor->GetProperty()->SetColor(0.75, 0.80, 0.88);
  m_actor->GetProperty()->LightingOff();
  m_actor->GetProperty()->SetLineWidth(2.0F);
}

ToolView::~ToolView() = default;

void ToolView::addTo(vtkRenderer* renderer) const
{
  renderer->AddViewProp(m_actor);
}

void ToolView::removeFrom(vtkRenderer* renderer) const
{
  renderer->RemoveViewProp(m_actor);
}

std::optional<rendering::ToolPose> ToolView::update(const session::TickRecord& record)
{
  m_placed = m_placed || session::hasToolPose(record);
  if (!m_placed)
    return std::nullopt;
  const haptics::Pose tool = record.proxy.pose();
  const Eigen::Vector3d hand = record.mapped.pose().position;
  m_lag = (hand - tool.position).norm();
  const bool shown = m_lag > kLag;
  const auto isNear = [](const double* drawn, const Eigen::Vector3d& point)
  { return (Eigen::Vector3d::Map(drawn) - point).norm() < kLeastPlace; };
  // A hand at rest trembles: a prop that was changed would begin the picture at rest anew.
  const bool isDrawn = m_actor->GetVisibility() && isNear(m_line->GetPoint1(), tool.position) &&
                       isNear(m_line->GetPoint2(), hand);
  m_actor->SetVisibility(shown ? 1 : 0);
  if (shown && !isDrawn)
  {
    m_line->SetPoint1(tool.position.x(), tool.position.y(), tool.position.z());
    m_line->SetPoint2(hand.x(), hand.y(), hand.z());
  }
  rendering::ToolPose pose;
  pose.center = tool.position;
  pose.axisToHand = tool.rotation * Eigen::Vector3d::UnitZ();
  pose.rotation = tool.rotation;
  pose.radius = m_burrRadius;
  pose.drilling = record.drill != 0;
  pose.finish = m_finish;
  if (pose.drilling)
    m_turn = std::fmod(m_turn + kGoldenTurn, 2.0 * 3.14159265358979323846);
  pose.turn = m_turn;
  return pose;
}

// Its near end is nearest to the line of sight: the axis goes out from the burr.
bool hidesField(const rendering::ToolPose& tool, const Eigen::Vector3d& eye)
{
  using namespace rendering::tool;
  if (!tool.handpiece || !rendering::tool::isShown(tool))
    return false;
  const Eigen::Vector3d sight = eye - tool.center;
  const Eigen::Vector3d end = kShaftLength * tool.axisToHand.normalized();
  const double along = end.dot(sight) / sight.squaredNorm(); // fraction of the way to the eye
  return along > 0.0 && along < 1.0 &&
         (end - along * sight).norm() < kHandpieceRadius + kFieldRadius * (1.0 - along);
}

} // namespace petrous::interaction
