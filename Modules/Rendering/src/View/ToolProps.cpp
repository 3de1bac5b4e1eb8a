#include "ToolProps.h"

#include <array>

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkCylinderSource.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include "petrous/Rendering/ToolShape.h"

namespace petrous::rendering
{

using namespace tool;

ToolProps::ToolProps()
{
  m_burr->SetThetaResolution(48);
  m_burr->SetPhiResolution(32);
  m_shaft->SetResolution(32);
  m_handpiece->SetResolution(48);
  vtkAlgorithm* const sources[3] = {m_burr, m_shaft, m_handpiece};
  const std::array<std::array<double, 3>, 3> colors{kBurrColor, kShaftColor, kHandpieceColor};
  for (std::size_t part = 0; part < m_actors.size(); ++part)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sources[part]->GetOutputPort());
    m_actors[part] = vtkSmartPointer<vtkActor>::New();
    m_actors[part]->SetMapper(mapper);
    m_actors[part]->SetVisibility(0);
    m_actors[part]->PickableOff();
    vtkProperty* property = m_actors[part]->GetProperty();
    property->SetColor(colors[part][0], colors[part][1], colors[part][2]);
    property->SetInterpolationToPhong();
    property->SetAmbient(kAmbient);
    property->SetDiffuse(1.0 - kAmbient);
    property->SetSpecular(kSpecular);
    property->SetSpecularPower(0.25 * kShininess); // see SurfaceActor.cpp
  }
}

ToolProps::~ToolProps() = default;

void ToolProps::addTo(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->AddActor(actor);
}

void ToolProps::removeFrom(vtkRenderer* renderer) const
{
  for (const auto& actor : m_actors)
    renderer->RemoveActor(actor);
}

void ToolProps::setPose(const std::optional<ToolPose>& tool)
{
  const bool shown = tool && isShown(*tool);
  for (const auto& actor : m_actors)
    actor->SetVisibility(shown ? 1 : 0);
  if (shown && !tool->handpiece)
    m_actors[2]->SetVisibility(0);
  if (!shown)
    return;
  m_burr->SetRadius(tool->radius);
  // VTK's cylinders are centred and along y.
  m_shaft->SetRadius(shaftRadius(*tool));
  m_shaft->SetHeight(kShaftLength);
  m_shaft->SetCenter(0.0, 0.5 * kShaftLength, 0.0);
  m_handpiece->SetRadius(kHandpieceRadius);
  m_handpiece->SetHeight(kHandpieceLength);
  m_handpiece->SetCenter(0.0, kShaftLength + 0.5 * kHandpieceLength, 0.0);
  const auto& burr = tool->drilling ? kDrillingColor : kBurrColor;
  m_actors[0]->GetProperty()->SetColor(burr[0], burr[1], burr[2]);

  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), tool->axisToHand)
          .toRotationMatrix();
  vtkNew<vtkMatrix4x4> pose;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose->SetElement(row, column, turn(row, column));
    pose->SetElement(row, 3, tool->center[row]);
  }
  for (const auto& actor : m_actors)
    actor->SetUserMatrix(pose);
}

} // namespace petrous::rendering
