#pragma once

#include <string>

#include <vtkInteractorObserver.h>
#include <vtkNew.h>

#include "petrous/Simulation/ServoParameters.h"

class vtkCallbackCommand;
namespace petrous::interaction
{
class PointerToolController;
class PointerDevice;
enum class ToolKey;
} // namespace petrous::interaction
namespace petrous::simulation
{
struct TickRecord;
}

/// Lets the surgeon hold the tool through a VTK interactor, with the pointer or with a device.
///
/// With the pointer (SetPointer), in drill mode:
///   move                   the tool follows; not while the style turns the camera
///   left button            presses and drills; with Ctrl presses only (feels)
///   space                  drills, while held; c: the tool stays where it is, while held
///   wheel                  depth, in the mode of that name; Shift: fine
///   arrows or WASD         nudge on the screen; page up, page down: depth; home: no nudge
///   q e, r f               turn and tilt the shaft
///   m                      surface following or depth by wheel
/// What it takes it keeps from the interactor's style (it comes first, and aborts the event); all
/// else is the style's, so the wheel zooms and the right button turns as before.
///
/// With a device (PointerHandOff) the mouse is the style's alone: the axes of the renderer's camera
/// are the hand's, space drills, c is the clutch, Ctrl with the wheel changes the scale.
///
/// After each change InteractionEvent is invoked: GetParameters is for ServoThread::setParameters.
/// See() once a frame. What is set here must outlive this, or be set to null. Main thread only.
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

  /// On unless set; releases what is held.
  void SetPointerHand(bool pointer);
  vtkGetMacro(PointerHand, bool);
  vtkBooleanMacro(PointerHand, bool);

  /// Off unless set; off releases what is held.
  void SetDrillMode(bool drill);
  vtkGetMacro(DrillMode, bool);
  vtkBooleanMacro(DrillMode, bool);

  /// Whether button or key asks for the drill now.
  bool GetDrilling() const;

  /// What the program sets itself (gains, buttons, pause); throws InvalidParameter.
  void SetParameters(const petrous::simulation::ServoParameters& parameters);

  /// Those, with what pointer, keys and camera say.
  const petrous::simulation::ServoParameters& GetParameters() const { return this->Parameters; }

  /// The servo's latest record: the tool follows the tissue that gives way.
  void See(const petrous::simulation::TickRecord& record);

  /// Button and keys as if let go: for a window that loses the focus.
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
  petrous::simulation::ServoParameters Base;
  petrous::simulation::ServoParameters Parameters;
  bool PointerHand = true;
  bool DrillMode = false;
  bool ButtonHeld = false; // left
  bool TouchOnly = false;  // it went down with Ctrl
  bool DrillKeyHeld = false;
  bool FreezeKeyHeld = false;
  vtkNew<vtkCallbackCommand> ReleaseCommand;
};
