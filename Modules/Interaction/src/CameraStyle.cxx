#include "petrous/Interaction/CameraStyle.h"

#include <cmath>
#include <string>

#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "petrous/Interaction/OrbitCamera.h"
#include "petrous/Interaction/RendererPickRay.h"

using petrous::core::CameraPose;

vtkStandardNewMacro(vtkPetrousCameraStyle);

namespace
{

constexpr double kDegreesPerPoint = 0.4; // of 1/72 inch: a pixel where the screen is not high-DPI
constexpr double kPointsPerInch = 72.0;
constexpr double kDegreesPerKey = 7.5;
constexpr double kZoomPerNotch = 1.15;

} // namespace

template <class Change>
void vtkPetrousCameraStyle::Move(const Change& change)
{
  const int* at = this->Interactor->GetEventPosition();
  this->FindPokedRenderer(at[0], at[1]);
  if (!this->CurrentRenderer)
    return;
  const CameraPose pose = change(petrous::interaction::cameraOf(*this->CurrentRenderer));
  vtkCamera* camera = this->CurrentRenderer->GetActiveCamera();
  camera->SetPosition(pose.position.data());
  camera->SetFocalPoint(pose.focalPoint.data());
  camera->SetViewUp(pose.viewUp.data());
  if (pose.parallelScale)
    camera->SetParallelScale(*pose.parallelScale);
  if (this->InvokeEvent(vtkCommand::InteractionEvent))
    return;
  this->CurrentRenderer->ResetCameraClippingRange();
  this->Interactor->Render();
}

void vtkPetrousCameraStyle::Hold(unsigned button)
{
  this->Interactor->GetEventPosition(this->Dragged.data());
  this->Held |= button;
  this->State = VTKIS_ROTATE;
}

void vtkPetrousCameraStyle::LetGo(unsigned button)
{
  this->Held &= ~button;
  if (this->Held == 0)
    this->State = VTKIS_NONE;
}

void vtkPetrousCameraStyle::OnMouseMove()
{
  if (this->State == VTKIS_NONE)
    return;
  const int* at = this->Interactor->GetEventPosition();
  const double right = at[0] - this->Dragged[0];
  const double down = this->Dragged[1] - at[1];
  this->Dragged = {at[0], at[1]};
  vtkRenderWindow* window = this->Interactor->GetRenderWindow();
  if (this->Interactor->GetShiftKey())
  {
    const double height = std::max(window->GetSize()[1], 1);
    return this->Move(
        [&](const CameraPose& pose)
        { return petrous::interaction::shifted(pose, right / height, down / height); });
  }
  const double degrees = kDegreesPerPoint * kPointsPerInch / window->GetDPI();
  this->Move([&](const CameraPose& pose)
             { return petrous::interaction::turned(pose, degrees * right, degrees * down); });
}

void vtkPetrousCameraStyle::OnMouseWheelForward()
{
  this->Move(
      [this](const CameraPose& pose)
      {
        return petrous::interaction::zoomed(pose,
                                            std::pow(kZoomPerNotch, this->MouseWheelMotionFactor));
      });
}

void vtkPetrousCameraStyle::OnMouseWheelBackward()
{
  this->Move(
      [this](const CameraPose& pose)
      {
        return petrous::interaction::zoomed(pose,
                                            std::pow(kZoomPerNotch, -this->MouseWheelMotionFactor));
      });
}

void vtkPetrousCameraStyle::OnKeyPress()
{
  const char* sym = this->Interactor->GetKeySym();
  const std::string key = sym ? sym : "";
  const auto turn = [this](double right, double down)
  {
    this->Move([=](const CameraPose& pose)
               { return petrous::interaction::turned(pose, right, down); });
  };
  const auto zoom = [this](double factor) {
    this->Move([=](const CameraPose& pose) { return petrous::interaction::zoomed(pose, factor); });
  };
  if (key == "Left")
    turn(-kDegreesPerKey, 0.0);
  else if (key == "Right")
    turn(kDegreesPerKey, 0.0);
  else if (key == "Up")
    turn(0.0, -kDegreesPerKey);
  else if (key == "Down")
    turn(0.0, kDegreesPerKey);
  else if (key == "plus" || key == "equal" || key == "KP_Add")
    zoom(kZoomPerNotch);
  else if (key == "minus" || key == "KP_Subtract")
    zoom(1.0 / kZoomPerNotch);
}
