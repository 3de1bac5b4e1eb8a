#include "ForceArrow.h"

#include <algorithm>

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

namespace petrous::interaction
{

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

} // namespace petrous::interaction
