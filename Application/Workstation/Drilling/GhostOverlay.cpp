#include "GhostOverlay.h"

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkCylinderSource.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include "petrous/Rendering/ToolShape.h"

namespace petrous::workstation
{

namespace
{
constexpr std::array<double, 3> kColor{0.35, 0.85, 1.0};
constexpr std::array<double, 3> kDrilling{1.0, 0.45, 0.85};
} // namespace

GhostOverlay::GhostOverlay(vtkRenderer& renderer)
  : m_renderer(&renderer)
{
  using namespace rendering::tool;
  m_burr->SetThetaResolution(16);
  m_burr->SetPhiResolution(12);
  m_shaft->SetResolution(10);
  m_shaft->SetHeight(kShaftLength);
  // VTK's cylinders are centred and along y.
  m_shaft->SetCenter(0.0, 0.5 * kShaftLength, 0.0);
  m_handpiece->SetResolution(12);
  m_handpiece->SetRadius(kHandpieceRadius);
  m_handpiece->SetHeight(kHandpieceLength);
  m_handpiece->SetCenter(0.0, kShaftLength + 0.5 * kHandpieceLength, 0.0);
  vtkAlgorithm* const sources[3] = {m_burr, m_shaft, m_handpiece};
  for (std::size_t part = 0; part < m_actors.size(); ++part)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sources[part]->GetOutputPort());
    m_actors[part] = vtkSmartPointer<vtkActor>::New();
    m_actors[part]->SetMapper(mapper);
    m_actors[part]->PickableOff();
    vtkProperty* property = m_actors[part]->GetProperty();
    property->SetRepresentationToWireframe();
    property->LightingOff();
    property->SetLineWidth(1.5F);
    property->SetColor(kColor[0], kColor[1], kColor[2]);
    renderer.AddViewProp(m_actors[part]);
  }
}

GhostOverlay::~GhostOverlay()
{
  for (const auto& actor : m_actors)
    m_renderer->RemoveViewProp(actor);
}

void GhostOverlay::set(const rendering::ToolPose& tool)
{
  const bool isShown = rendering::tool::isShown(tool);
  for (const auto& actor : m_actors)
    actor->SetVisibility(isShown ? 1 : 0);
  if (!isShown)
    return;
  m_burr->SetRadius(tool.radius);
  m_shaft->SetRadius(rendering::tool::shaftRadius(tool));
  const auto& color = tool.drilling ? kDrilling : kColor;
  m_actors[0]->GetProperty()->SetColor(color[0], color[1], color[2]);
  m_actors[2]->SetVisibility(tool.handpiece ? 1 : 0);
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), tool.axisToHand)
          .toRotationMatrix();
  vtkNew<vtkMatrix4x4> pose;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose->SetElement(row, column, turn(row, column));
    pose->SetElement(row, 3, tool.center[row]);
  }
  for (const auto& actor : m_actors)
    actor->SetUserMatrix(pose);
}

} // namespace petrous::workstation
