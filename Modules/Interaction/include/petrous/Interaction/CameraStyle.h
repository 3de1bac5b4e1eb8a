#pragma once

#include <array>

#include <vtkInteractorStyle.h>

#include "petrous/Core/CameraPose.h"

/// Camera control through a VTK interactor: what is under the pointer follows it (OrbitCamera.h).
///
///   drag           rotates about the focal point, with any button; with Shift pans
///   wheel, + and - dolly; a notch counts MouseWheelMotionFactor
///   arrows         rotate
///
/// A drag lasts until the last button is released. Invokes InteractionEvent after each change of
/// the camera and then renders, unless an observer aborts the event because it renders itself.
/// Grabs no focus, so a vtkPetrousToolInteraction sees all events first.
class vtkPetrousCameraStyle : public vtkInteractorStyle
{
public:
  static vtkPetrousCameraStyle* New();
  vtkTypeMacro(vtkPetrousCameraStyle, vtkInteractorStyle);

  vtkPetrousCameraStyle(const vtkPetrousCameraStyle&) = delete;
  void operator=(const vtkPetrousCameraStyle&) = delete;

  void OnMouseMove() override;
  void OnLeftButtonDown() override { this->Hold(1); }
  void OnLeftButtonUp() override { this->LetGo(1); }
  void OnMiddleButtonDown() override { this->Hold(2); }
  void OnMiddleButtonUp() override { this->LetGo(2); }
  void OnRightButtonDown() override { this->Hold(4); }
  void OnRightButtonUp() override { this->LetGo(4); }
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  void OnKeyPress() override;
  void OnChar() override {} ///< none of the base class's keys: exit, wireframe, stereo …

protected:
  vtkPetrousCameraStyle() = default;
  ~vtkPetrousCameraStyle() override = default;

private:
  void Hold(unsigned button);
  void LetGo(unsigned button);
  template <class Change>
  void Move(const Change& change);

  unsigned Held = 0;            // buttons
  std::array<int, 2> Dragged{}; // display coordinates
};
