#pragma once

#include <array>
#include <optional>
#include <string>

#include <vtkInteractorObserver.h>
#include <vtkNew.h>
#include <vtkWeakPointer.h>

#include "petrous/Interaction/PickRay.h"
#include "petrous/Session/ServoParameters.h"

class vtkCallbackCommand;
namespace petrous::interaction
{
class PointerToolController;
class PointerDevice;
} // namespace petrous::interaction
namespace petrous::rendering
{
class StereoPicture;
}
namespace petrous::session
{
struct TickRecord;
}

/// Tool control through a VTK interactor, by pointer or by device.
///
/// With the pointer (SetPointer), in drill mode:
///   move                   moves the tool, unless the style is moving the camera
///   left button            presses and drills; with Ctrl presses only (touch)
///   space                  drills while held; c (SetFreezeKey): holds the tool still while held
///   wheel                  depth, in depth mode; Shift: fine
/// and with Shortcuts
///   arrows or WASD         nudge on the screen; page up, page down: depth; home: reset nudge
///   q e, r f               turn and tilt the shaft
///   m                      toggles surface and depth mode
/// Events handled here are aborted before they reach the interactor's style (higher priority); all
/// others go to the style, so the wheel zooms and the right button turns as before. While the
/// pointer drills, no button reaches the style. In probe mode the tool only follows the pointer.
///
/// The drill stops when the pointer leaves the window by any edge, where the tool's target is
/// invisible; a button still held when it comes back does not restart it. Space drills at the
/// window's centre while the pointer is elsewhere. A foot pedal in the servo's records presses,
/// too.
///
/// With a device (PointerHandOff) mouse events go to the style only: the device uses the axes of
/// the renderer's camera, space drills, c is the clutch, and with Shortcuts Ctrl with the wheel
/// changes the scale.
///
/// Invokes
///   HoverEvent             the pointer moved with nothing pressed, in any mode: see GetPickRay.
///                          Before the tool follows, so that an observer may call SetPointer
///   LeaveEvent             it left the window
///   PickEvent              double click, unless the left button drills: see GetPickRay
///   StartInteractionEvent  before a press, so that an observer may call SetPointer
///   InteractionEvent       after each change: pass GetParameters to ServoThread::setParameters
///   ModifiedEvent          a mode changed
///
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

  /// Without a device, input is taken and no tool follows it. Stops the drill, unless it is the
  /// first tool that comes while the button is held, which PointAgain presses; the freeze key stays
  /// held.
  void SetPointer(petrous::interaction::PointerToolController* aim,
                  petrous::interaction::PointerDevice* device);

  /// Of the scene in the window, if it can be in stereo: see pickRayThrough.
  void SetStereo(const petrous::rendering::StereoPicture* stereo) { this->Stereo = stereo; }

  /// Input here acts on the leader, with the leader's modes, device and events: a second window on
  /// the same scene.
  void SetLeader(vtkPetrousToolInteraction* leader);

  /// Default on; a change releases button and keys.
  void SetPointerHand(bool pointer);
  vtkGetMacro(PointerHand, bool);
  vtkBooleanMacro(PointerHand, bool);

  /// Default off: nothing drills; turning it off releases button and keys.
  void SetDrillMode(bool drill);
  vtkGetMacro(DrillMode, bool);
  vtkBooleanMacro(DrillMode, bool);

  /// Default off. A tool that follows the pointer and is not pressed; the left button is the
  /// style's.
  void SetProbeMode(bool probe);
  vtkGetMacro(ProbeMode, bool);
  vtkBooleanMacro(ProbeMode, bool);

  /// Default on; off for a program with controls of its own for depth mode, shaft and scale.
  vtkSetMacro(Shortcuts, bool);
  vtkGetMacro(Shortcuts, bool);
  vtkBooleanMacro(Shortcuts, bool);

  /// VTK's key symbol in lower case; default "c".
  void SetFreezeKey(const std::string& sym) { this->FreezeKey = sym; }

  /// Whether button or key requests drilling.
  bool GetDrilling() const;

  /// The last ray: through the pointer, or through the window's centre for a key pressed while the
  /// pointer is elsewhere.
  const petrous::interaction::PickRay& GetPickRay() const { return this->Ray; }

  /// Aims the tool at the pointer, if it is over the window, without waiting for its next move, and
  /// presses it if button or key are held.
  void PointAgain();

  /// Sets the application's own parameters (gains, buttons, pause); throws InvalidParameter.
  void SetParameters(const petrous::session::ServoParameters& parameters);

  /// The application's parameters combined with pointer, keys and camera.
  const petrous::session::ServoParameters& GetParameters() const { return this->Parameters; }

  /// Takes the servo's latest record: the tool follows as tissue is removed.
  void See(const petrous::session::TickRecord& record);

  /// Releases button and keys, e.g. when the window loses the focus.
  void Release();
  /// As Release, but a key that freezes the tool stays held.
  void ReleaseDrill();

  void SetEnabled(int enabling) override;

protected:
  vtkPetrousToolInteraction();
  ~vtkPetrousToolInteraction() override;

private:
  static void ProcessEvents(vtkObject* caller, unsigned long event, void* self, void* data);
  static void ProcessReleases(vtkObject* caller, unsigned long event, void* self, void* data);
  vtkPetrousToolInteraction& Target() { return this->Leader ? *this->Leader : *this; }

  // Of the window that this object observes.
  bool Track();
  petrous::interaction::PickRay Sight() const;
  std::string Key() const;
  double Notches() const;
  void ShowCursor();

  // Of the tool; `from`: the window of the event.
  using Self = vtkPetrousToolInteraction;
  bool Handle(unsigned long event, Self& from);
  bool HandleMove(Self& from);
  bool HandlePress(Self& from);
  bool HandleWheel(double notches, const Self& from);
  bool HandleKey(Self& from);
  bool IsOwnKey(const Self& from);
  bool* HeldKey(const std::string& key);
  void HandleRelease(unsigned long event, Self& from);
  const Self& From() const { return this->Source ? *this->Source : *this; }
  bool Start(Self& from);
  void PointTool();
  void Point();
  void Press();
  void Lift();
  void Unpress();
  void Send();
  void SetMode(bool& mode, bool on);
  bool Pressed() const { return this->ButtonHeld || this->DrillKeyHeld; }
  bool TakesPointer() const { return this->PointerHand && (this->DrillMode || this->ProbeMode); }
  bool PointerHolds() const { return this->TakesPointer() && this->Aim && this->Device; }

  petrous::interaction::PointerToolController* Aim = nullptr;
  petrous::interaction::PointerDevice* Device = nullptr;
  const petrous::rendering::StereoPicture* Stereo = nullptr;
  vtkWeakPointer<vtkPetrousToolInteraction> Leader;
  unsigned long LeaderObserver = 0;
  vtkWeakPointer<vtkPetrousToolInteraction> Source; // window of the last event
  std::optional<std::array<int, 2>> Pointer; // display coordinates; none: not over the window
  petrous::interaction::PickRay Ray;
  petrous::session::ServoParameters Base;
  petrous::session::ServoParameters Parameters;
  std::string FreezeKey = "c";
  bool PointerHand = true;
  bool DrillMode = false;
  bool ProbeMode = false;
  bool Shortcuts = true;
  bool ButtonHeld = false; // left
  bool TouchOnly = false;  // pressed with Ctrl
  bool DrillKeyHeld = false;
  bool FreezeKeyHeld = false;
  bool PedalHeld = false;
  vtkNew<vtkCallbackCommand> ReleaseCommand;
};
