#pragma once

#include <string>

#include <vtkInteractorObserver.h>
#include <vtkNew.h>

#include "petrous/Session/ServoParameters.h"

class vtkCallbackCommand;
namespace petrous::interaction
{
class PointerToolController;
class PointerDevice;
enum class ToolKey;
} // namespace petrous::interaction
namespace petrous::session
{
struct TickRecord;
}

/// Tool control through a VTK interactor, by pointer or by device.
///
/// With the pointer (SetPointer), in drill mode:
///   move                   moves the tool, unless the style is moving the camera
///   left button            presses and drills; with Ctrl presses only (touch)
///   space                  drills while held; c: holds the tool still while held
///   wheel                  depth, in depth mode; Shift: fine
///   arrows or WASD         nudge on the screen; page up, page down: depth; home: reset nudge
///   q e, r f               turn and tilt the shaft
///   m                      toggles surface and depth mode
/// Events handled here are aborted before they reach the interactor's style (higher priority); all
/// others go to the style, so the wheel zooms and the right button turns as before.
///
/// With a device (PointerHandOff) mouse events go to the style only: the device uses the axes of
/// the renderer's camera, space drills, c is the clutch, Ctrl with the wheel changes the scale.
///
/// Invokes InteractionEvent after each change: pass GetParameters to ServoThread::setParameters.
/// Call See() once per frame. Objects set here must outlive this object, or be reset to null. Main
/// thread only.
class vtkPetrousToolInteraction : public vtkInteractorObserver
{
public:
  static vtkPetrousToolInteraction* New();
  vtkTypeMacro(vtkPetrousToolInteraction, vtkInteractorObserver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkPetrousToolInteraction(const vtkPetrousToolInteraction&) = delete;
  void operator=(const vtkPetrousToolInteraction&) = delete;

  void SetPointer(petrous::interaction::PointerToolController* aim,
                  petrous::interaction::PointerDevice* device);

  /// Default on; a change releases button and keys.
  void SetPointerHand(bool pointer);
  vtkGetMacro(PointerHand, bool);
  vtkBooleanMacro(PointerHand, bool);

  /// Default off; turning it off releases button and keys.
  void SetDrillMode(bool drill);
  vtkGetMacro(DrillMode, bool);
  vtkBooleanMacro(DrillMode, bool);

  /// Whether button or key requests drilling.
  bool GetDrilling() const;

  /// Sets the application's own parameters (gains, buttons, pause); throws InvalidParameter.
  void SetParameters(const petrous::session::ServoParameters& parameters);

  /// The application's parameters combined with pointer, keys and camera.
  const petrous::session::ServoParameters& GetParameters() const { return this->Parameters; }

  /// Takes the servo's latest record: the tool follows as tissue is removed.
  void See(const petrous::session::TickRecord& record);

  /// Releases button and keys, e.g. when the window loses the focus.
  void Release();

  void SetEnabled(int enabling) override;

protected:
  vtkPetrousToolInteraction();
  ~vtkPetrousToolInteraction() override;

private:
  static void ProcessEvents(vtkObject* caller, unsigned long event, void* self, void* data);
  static void ProcessReleases(vtkObject* caller, unsigned long event, void* self, void* data);
  bool Handle(unsigned long event);
  bool HandleWheel(double notches);
  bool HandleKey();
  bool IsOwnKey() const;
  void LetGo(petrous::interaction::ToolKey key, bool button);
  std::string Key() const;
  void Point();
  void Press();
  void Send();
  bool PointerHolds() const;

  petrous::interaction::PointerToolController* Aim = nullptr;
  petrous::interaction::PointerDevice* Device = nullptr;
  petrous::session::ServoParameters Base;
  petrous::session::ServoParameters Parameters;
  bool PointerHand = true;
  bool DrillMode = false;
  bool ButtonHeld = false; // left
  bool TouchOnly = false;  // pressed with Ctrl
  bool DrillKeyHeld = false;
  bool FreezeKeyHeld = false;
  vtkNew<vtkCallbackCommand> ReleaseCommand;
};
