#include "petrous/Interaction/ToolInteraction.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>

#include <vtkCallbackCommand.h>
#include <vtkInteractorStyle.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/Error.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Interaction/RendererPickRay.h"

using petrous::interaction::AimSettings;
using petrous::interaction::PointerDevice;
using petrous::interaction::PointerToolController;
using petrous::session::ServoParameters;

vtkStandardNewMacro(vtkPetrousToolInteraction);

namespace
{

constexpr float kBeforeTheStyle = 0.5F; // the style's priority is 0
constexpr double kScalePerNotch = 1.25;
constexpr double kShiftThrust = 2.0; // of the set thrust, while Shift is held
constexpr double kMaxThrust = 20.0;  // N
constexpr double kTiltStep = 5.0;    // degrees
constexpr double kTurnStep = 15.0;   // degrees

using Action = std::function<void(PointerToolController&, bool fine)>;

Action nudge(double rightward, double upward)
{
  return [=](PointerToolController& aim, bool fine) { aim.nudge(rightward, upward, fine); };
}

Action deepen(double steps)
{
  return [=](PointerToolController& aim, bool fine) { aim.wheel(steps, fine); };
}

Action turn(double degrees)
{
  return [=](PointerToolController& aim, bool fine)
  { aim.turnBy(degrees * (fine ? aim.settings().fineFraction : 1.0)); };
}

Action tilt(double degrees)
{
  return [=](PointerToolController& aim, bool fine)
  { aim.tiltBy(degrees * (fine ? aim.settings().fineFraction : 1.0)); };
}

void changeMode(PointerToolController& aim, bool)
{
  using Mode = AimSettings::Mode;
  AimSettings settings = aim.settings();
  settings.mode = settings.mode == Mode::Surface ? Mode::Depth : Mode::Surface;
  aim.setSettings(settings);
}

const std::map<std::string, Action>& actions()
{
  static const std::map<std::string, Action> actions{
      {"left", nudge(-1.0, 0.0)}, {"a", nudge(-1.0, 0.0)},
      {"right", nudge(1.0, 0.0)}, {"d", nudge(1.0, 0.0)},
      {"up", nudge(0.0, 1.0)},    {"w", nudge(0.0, 1.0)},
      {"down", nudge(0.0, -1.0)}, {"s", nudge(0.0, -1.0)},
      {"prior", deepen(-1.0)},    {"next", deepen(1.0)},
      {"q", turn(kTurnStep)},     {"e", turn(-kTurnStep)},
      {"r", tilt(-kTiltStep)},    {"f", tilt(kTiltStep)},
      {"m", changeMode},          {"home", [](PointerToolController& aim, bool) { aim.home(); }},
  };
  return actions;
}

constexpr unsigned long kEvents[] = {vtkCommand::MouseMoveEvent,
                                     vtkCommand::EnterEvent,
                                     vtkCommand::LeaveEvent,
                                     vtkCommand::LeftButtonPressEvent,
                                     vtkCommand::LeftButtonReleaseEvent,
                                     vtkCommand::LeftButtonDoubleClickEvent,
                                     vtkCommand::MiddleButtonPressEvent,
                                     vtkCommand::RightButtonPressEvent,
                                     vtkCommand::MouseWheelForwardEvent,
                                     vtkCommand::MouseWheelBackwardEvent,
                                     vtkCommand::KeyPressEvent,
                                     vtkCommand::KeyReleaseEvent,
                                     vtkCommand::CharEvent};

// A style that moves the camera grabs all events until it is done, except for passive observers:
// drilling must stop if its key is released meanwhile.
constexpr unsigned long kReleases[] = {vtkCommand::LeftButtonReleaseEvent,
                                       vtkCommand::KeyReleaseEvent};

bool turnsCamera(vtkRenderWindowInteractor& interactor)
{
  auto* style = vtkInteractorStyle::SafeDownCast(interactor.GetInteractorStyle());
  return style && style->GetState() != VTKIS_NONE;
}

} // namespace

vtkPetrousToolInteraction::vtkPetrousToolInteraction()
{
  this->Priority = kBeforeTheStyle;
  this->KeyPressActivation = 0;
  this->EventCallbackCommand->SetCallback(vtkPetrousToolInteraction::ProcessEvents);
  this->ReleaseCommand->SetClientData(this);
  this->ReleaseCommand->SetCallback(vtkPetrousToolInteraction::ProcessReleases);
  this->ReleaseCommand->PassiveObserverOn();
}

vtkPetrousToolInteraction::~vtkPetrousToolInteraction()
{
  // Not in the base class, whose destructor calls another SetEnabled: the observers refer to this.
  this->SetInteractor(nullptr);
  this->SetLeader(nullptr);
}

void vtkPetrousToolInteraction::SetEnabled(int enabling)
{
  if (!this->Interactor)
  {
    vtkErrorMacro("an interactor must be set before the tool interaction is switched on or off");
    return;
  }
  if ((enabling != 0) == (this->Enabled != 0))
    return;
  if (enabling)
  {
    const int* at = this->Interactor->GetEventPosition();
    if (!this->CurrentRenderer)
      this->SetCurrentRenderer(this->Interactor->FindPokedRenderer(at[0], at[1]));
    if (!this->CurrentRenderer)
      return;
    this->Enabled = 1;
    for (const unsigned long event : kEvents)
      this->Interactor->AddObserver(event, this->EventCallbackCommand, this->Priority);
    for (const unsigned long event : kReleases)
      this->Interactor->AddObserver(event, this->ReleaseCommand, this->Priority);
    this->ShowCursor();
    this->InvokeEvent(vtkCommand::EnableEvent);
    return;
  }
  this->Release();
  this->Pointer.reset();
  this->Enabled = 0;
  this->Interactor->RemoveObserver(this->EventCallbackCommand);
  this->Interactor->RemoveObserver(this->ReleaseCommand);
  this->InvokeEvent(vtkCommand::DisableEvent);
  this->SetCurrentRenderer(nullptr);
}

void vtkPetrousToolInteraction::SetPointer(PointerToolController* aim, PointerDevice* device)
{
  if (this->Device) // else a button is held for the tool that comes: PointAgain
    this->Unpress();
  this->PedalHeld = false;
  this->Aim = aim;
  this->Device = device;
}

void vtkPetrousToolInteraction::SetLeader(vtkPetrousToolInteraction* leader)
{
  if (this->Leader == leader)
    return;
  this->Release();
  if (this->Leader)
    this->Leader->RemoveObserver(this->LeaderObserver);
  this->Leader = leader;
  if (leader)
    this->LeaderObserver = leader->AddObserver(vtkCommand::ModifiedEvent, this,
                                               &vtkPetrousToolInteraction::ShowCursor);
  this->ShowCursor();
}

void vtkPetrousToolInteraction::SetMode(bool& mode, bool on)
{
  if (on == mode)
    return;
  this->Release();
  mode = on;
  this->ShowCursor();
  this->Modified();
  this->Send();
}

void vtkPetrousToolInteraction::SetPointerHand(bool pointer)
{
  this->SetMode(this->PointerHand, pointer);
}

void vtkPetrousToolInteraction::SetDrillMode(bool drill)
{
  this->SetMode(this->DrillMode, drill);
}

void vtkPetrousToolInteraction::SetProbeMode(bool probe)
{
  this->SetMode(this->ProbeMode, probe);
}

bool vtkPetrousToolInteraction::GetDrilling() const
{
  return this->DrillMode && (this->DrillKeyHeld || (this->ButtonHeld && !this->TouchOnly));
}

void vtkPetrousToolInteraction::SetParameters(const petrous::session::ServoParameters& parameters)
{
  petrous::session::check(parameters);
  this->Base = parameters;
  this->Send();
}

void vtkPetrousToolInteraction::See(const petrous::session::TickRecord& record)
{
  if (this->PointerHand && this->Aim && this->Device)
  {
    this->Aim->see(record, this->Device->see(record));
    const bool pedal = this->DrillMode && record.input.pedalDown();
    if (pedal != this->PedalHeld)
    {
      this->PedalHeld = pedal;
      this->Press();
    }
    // Also under a camera that moves.
    this->Pressed() && this->PointerHolds() ? this->PointTool() : this->Aim->update();
  }
  this->Send();
}

void vtkPetrousToolInteraction::Release()
{
  if (this->Leader)
    return this->Leader->Release();
  if (this->FreezeKeyHeld)
  {
    this->FreezeKeyHeld = false;
    this->Send();
  }
  this->Unpress();
}

void vtkPetrousToolInteraction::ReleaseDrill()
{
  if (this->Leader)
    return this->Leader->ReleaseDrill();
  this->Unpress();
}

void vtkPetrousToolInteraction::Unpress()
{
  if (!this->Pressed())
    return;
  this->ButtonHeld = this->TouchOnly = this->DrillKeyHeld = false;
  this->Press();
}

void vtkPetrousToolInteraction::ProcessEvents(vtkObject*, unsigned long event, void* self, void*)
{
  auto* me = static_cast<vtkPetrousToolInteraction*>(self);
  bool handled = false;
  try
  {
    handled = me->Target().Handle(event, *me);
  }
  catch (const petrous::core::Error& error) // VTK's event loops do not handle exceptions
  {
    vtkErrorWithObjectMacro(me, << error.what());
  }
  me->EventCallbackCommand->SetAbortFlag(handled ? 1 : 0);
}

void vtkPetrousToolInteraction::ProcessReleases(vtkObject*, unsigned long event, void* self, void*)
{
  auto* me = static_cast<vtkPetrousToolInteraction*>(self);
  try
  {
    me->Target().HandleRelease(event, *me);
  }
  catch (const petrous::core::Error& error)
  {
    vtkErrorWithObjectMacro(me, << error.what());
  }
}

bool vtkPetrousToolInteraction::Handle(unsigned long event, Self& from)
{
  switch (event)
  {
  case vtkCommand::MouseMoveEvent:
    return this->HandleMove(from);
  case vtkCommand::EnterEvent:
    from.ShowCursor();
    return false;
  case vtkCommand::LeaveEvent:
    if (this->PointerHand && &this->From() == &from)
      this->Lift();
    from.Pointer.reset();
    this->InvokeEvent(vtkCommand::LeaveEvent);
    return false;
  case vtkCommand::LeftButtonPressEvent:
    return this->HandlePress(from);
  case vtkCommand::LeftButtonDoubleClickEvent:
    if (this->HandlePress(from))
      return true;
    from.Track();
    this->Ray = from.Sight();
    this->InvokeEvent(vtkCommand::PickEvent);
    return true;
  case vtkCommand::MiddleButtonPressEvent:
  case vtkCommand::RightButtonPressEvent:
    return this->PointerHand && this->Pressed();
  case vtkCommand::MouseWheelForwardEvent:
    return this->HandleWheel(from.Notches(), from);
  case vtkCommand::MouseWheelBackwardEvent:
    return this->HandleWheel(-from.Notches(), from);
  case vtkCommand::KeyPressEvent:
    return this->HandleKey(from);
  case vtkCommand::KeyReleaseEvent:
  case vtkCommand::CharEvent: // keeps the style's shortcuts (w: wireframe, e: exit) from acting too
    return this->IsOwnKey(from);
  default: // a release of the button is the style's, too: it may have seen the press
    return false;
  }
}

bool vtkPetrousToolInteraction::HandleMove(Self& from)
{
  const bool presses = this->PointerHand && this->Pressed();
  const bool inside = from.Track();
  if (turnsCamera(*from.Interactor) && !presses)
    return false;
  if (!inside)
  {
    if (presses)
      this->Lift();
    return presses;
  }
  this->Source = &from;
  if (!presses)
  {
    this->Ray = from.Sight();
    this->InvokeEvent(vtkCommand::HoverEvent);
  }
  this->Point();
  return presses;
}

// False: nobody may press any more.
bool vtkPetrousToolInteraction::Start(Self& from)
{
  this->Source = &from;
  this->Ray = from.Sight();
  if (!this->Pressed())
    this->InvokeEvent(vtkCommand::StartInteractionEvent);
  return this->DrillMode;
}

bool vtkPetrousToolInteraction::HandlePress(Self& from)
{
  if (!this->DrillMode || !this->PointerHand)
    return false;
  from.Track();
  if (this->Start(from) && this->PointerHand)
  {
    this->TouchOnly = from.Interactor->GetControlKey() != 0;
    this->ButtonHeld = true;
    this->Point();
    this->Press();
  }
  return true;
}

void vtkPetrousToolInteraction::HandleRelease(unsigned long event, Self& from)
{
  if (event == vtkCommand::LeftButtonReleaseEvent)
  {
    if (!this->ButtonHeld)
      return;
    from.Track();
    this->Point();
    this->ButtonHeld = this->TouchOnly = false;
    this->Press();
  }
  else if (bool* held = this->HeldKey(from.Key()); held && *held)
  {
    if (held == &this->DrillKeyHeld)
      this->Point();
    *held = false;
    this->Press();
  }
}

bool vtkPetrousToolInteraction::HandleWheel(double notches, const Self& from)
{
  const bool control = from.Interactor->GetControlKey() != 0;
  if (this->DrillMode && !this->PointerHand && this->Shortcuts && control)
  {
    this->Base.scale = std::clamp(this->Base.scale * std::pow(kScalePerNotch, notches), 0.01, 10.0);
    this->Send();
    return true;
  }
  if (!this->TakesPointer() || !this->Aim || control ||
      this->Aim->settings().mode != AimSettings::Mode::Depth)
    return false;
  this->Aim->wheel(notches, from.Interactor->GetShiftKey() != 0);
  this->Send();
  return true;
}

bool* vtkPetrousToolInteraction::HeldKey(const std::string& key)
{
  if (key == "space")
    return this->DrillMode ? &this->DrillKeyHeld : nullptr;
  return key == this->FreezeKey && (this->DrillMode || this->ProbeMode) ? &this->FreezeKeyHeld
                                                                        : nullptr;
}

bool vtkPetrousToolInteraction::IsOwnKey(const Self& from)
{
  const std::string key = from.Key();
  if (this->HeldKey(key))
    return true;
  const bool others = from.Interactor->GetControlKey() != 0 || from.Interactor->GetAltKey() != 0;
  return this->Shortcuts && this->PointerHolds() && !others && actions().count(key) > 0;
}

bool vtkPetrousToolInteraction::HandleKey(Self& from)
{
  if (!this->IsOwnKey(from))
    return false;
  const std::string key = from.Key();
  bool* held = this->HeldKey(key);
  if (!held)
  {
    actions().at(key)(*this->Aim, from.Interactor->GetShiftKey() != 0);
    this->Send();
    return true;
  }
  // A key held since before the drill was stopped at an edge does not restart it by its repeats.
  if (*held || from.Interactor->GetRepeatCount() > 1)
    return true;
  const bool drills = held == &this->DrillKeyHeld;
  if (drills && !this->Start(from))
    return true;
  *held = true;
  if (drills)
    this->Point();
  this->Press();
  return true;
}

// Takes the event's position. False: beyond the window's edges, the last position stays.
bool vtkPetrousToolInteraction::Track()
{
  const int* at = this->Interactor->GetEventPosition();
  const int* size = this->Interactor->GetRenderWindow()->GetSize();
  const bool inside = at[0] >= 0 && at[1] >= 0 && at[0] < size[0] && at[1] < size[1];
  if (inside)
    this->Pointer = {at[0], at[1]};
  return inside;
}

petrous::interaction::PickRay vtkPetrousToolInteraction::Sight() const
{
  if (!this->Pointer)
    return petrous::interaction::centralRay(*this->CurrentRenderer);
  return petrous::interaction::pickRayThrough(*this->CurrentRenderer, (*this->Pointer)[0],
                                              (*this->Pointer)[1], this->Stereo);
}

// VTK's key symbol in lower case.
std::string vtkPetrousToolInteraction::Key() const
{
  const char* sym = this->Interactor->GetKeySym();
  std::string key = sym ? sym : "";
  std::transform(key.begin(), key.end(), key.begin(), petrous::core::asciiLower);
  return key;
}

// Of a wheel event; fractions and several at once by the style's factor.
double vtkPetrousToolInteraction::Notches() const
{
  auto* style = vtkInteractorStyle::SafeDownCast(this->Interactor->GetInteractorStyle());
  return style ? style->GetMouseWheelMotionFactor() : 1.0;
}

void vtkPetrousToolInteraction::ShowCursor()
{
  if (this->Enabled && this->Interactor && this->Interactor->GetRenderWindow())
    this->Interactor->GetRenderWindow()->SetCurrentCursor(
        this->Target().TakesPointer() ? VTK_CURSOR_CROSSHAIR : VTK_CURSOR_DEFAULT);
}

void vtkPetrousToolInteraction::PointTool()
{
  const Self& from = this->From();
  if (!from.CurrentRenderer)
    return;
  this->Ray = from.Sight();
  this->Aim->setCamera(petrous::interaction::cameraOf(*from.CurrentRenderer));
  this->Aim->point(this->Ray);
}

void vtkPetrousToolInteraction::Point()
{
  if (!this->PointerHolds())
    return;
  this->PointTool();
  this->Send();
}

void vtkPetrousToolInteraction::PointAgain()
{
  if (this->From().Pointer || this->Pressed())
    this->Point();
  if (this->Pressed())
    this->Press();
}

void vtkPetrousToolInteraction::Press()
{
  using Press = PointerToolController::Press;
  if (this->Aim && this->Device && this->PointerHand)
  {
    // A pedal is in the readings by itself, and turns the spindle as fast as it is pressed.
    const Press touch = this->ButtonHeld || this->PedalHeld ? Press::Touch : Press::None;
    this->Aim->press(this->GetDrilling() ? Press::Drill : touch);
  }
  this->Send();
}

// The way up to here is drilled.
void vtkPetrousToolInteraction::Lift()
{
  if (this->Pressed())
    this->Point();
  this->Unpress();
}

void vtkPetrousToolInteraction::Send()
{
  this->Parameters = this->Base;
  if (this->PointerHand && this->Aim && this->Device)
  {
    if (this->Aim->wanted())
      this->Device->want(*this->Aim->wanted());
    this->Device->setButtons(this->Aim->buttons() |
                             (this->FreezeKeyHeld ? PointerDevice::kFreeze : 0U));
    this->Aim->apply(this->Parameters);
    vtkRenderWindowInteractor* interactor = this->From().Interactor;
    if (interactor && interactor->GetShiftKey() && this->Pressed())
      this->Parameters.thrust = std::min(kShiftThrust * this->Parameters.thrust,
                                         std::max(kMaxThrust, this->Parameters.thrust));
  }
  else if (!this->PointerHand)
  {
    if (this->CurrentRenderer)
      petrous::session::setCamera(this->Parameters,
                                  petrous::interaction::cameraOf(*this->CurrentRenderer));
    if (this->GetDrilling())
      this->Parameters.drill |= ServoParameters::kDrill;
    this->Parameters.clutch = this->Base.clutch || this->FreezeKeyHeld ? 1 : 0;
  }
  this->Parameters.drill |= ServoParameters::kPedalSpeed;
  if (!this->DrillMode)
  {
    this->Parameters.drill = 0;
    this->Parameters.drillButtons = 0;
  }
  this->InvokeEvent(vtkCommand::InteractionEvent);
}

void vtkPetrousToolInteraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PointerHand: " << this->PointerHand << "\n"
     << indent << "DrillMode: " << this->DrillMode << "\n"
     << indent << "ProbeMode: " << this->ProbeMode << "\n"
     << indent << "Shortcuts: " << this->Shortcuts << "\n"
     << indent << "Drilling: " << this->GetDrilling() << "\n"
     << indent << "Scale: " << this->Base.scale << "\n";
}
