#include "petrous/Interaction/ToolInteraction.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <vtkCallbackCommand.h>
#include <vtkInteractorStyle.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "ToolKeys.h"
#include "petrous/Core/Error.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Interaction/RendererPickRay.h"

using petrous::interaction::PointerDevice;
using petrous::interaction::PointerToolController;
using petrous::interaction::ToolKey;

vtkStandardNewMacro(vtkPetrousToolInteraction);

namespace
{

constexpr float kBeforeTheStyle = 0.5F; // the style's priority is 0
constexpr double kScalePerNotch = 1.25;

constexpr unsigned long kEvents[] = {
    vtkCommand::MouseMoveEvent,          vtkCommand::LeftButtonPressEvent,
    vtkCommand::LeftButtonReleaseEvent,  vtkCommand::MouseWheelForwardEvent,
    vtkCommand::MouseWheelBackwardEvent, vtkCommand::KeyPressEvent,
    vtkCommand::KeyReleaseEvent,         vtkCommand::CharEvent};

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
    this->InvokeEvent(vtkCommand::EnableEvent);
    return;
  }
  this->Release();
  this->Enabled = 0;
  this->Interactor->RemoveObserver(this->EventCallbackCommand);
  this->Interactor->RemoveObserver(this->ReleaseCommand);
  this->InvokeEvent(vtkCommand::DisableEvent);
  this->SetCurrentRenderer(nullptr);
}

void vtkPetrousToolInteraction::SetPointer(PointerToolController* aim, PointerDevice* device)
{
  this->Release();
  this->Aim = aim;
  this->Device = device;
  this->Modified();
}

void vtkPetrousToolInteraction::SetPointerHand(bool pointer)
{
  if (pointer == this->PointerHand)
    return;
  this->Release();
  this->PointerHand = pointer;
  this->Modified();
  this->Send();
}

void vtkPetrousToolInteraction::SetDrillMode(bool drill)
{
  if (drill == this->DrillMode)
    return;
  this->Release();
  this->DrillMode = drill;
  this->Modified();
  this->Send();
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
    this->Aim->update();
  }
  this->Send();
}

void vtkPetrousToolInteraction::Release()
{
  const bool held = this->ButtonHeld || this->DrillKeyHeld || this->FreezeKeyHeld;
  this->ButtonHeld = this->TouchOnly = this->DrillKeyHeld = this->FreezeKeyHeld = false;
  if (held)
    this->Press();
}

bool vtkPetrousToolInteraction::PointerHolds() const
{
  return this->DrillMode && this->PointerHand && this->Aim && this->Device;
}

void vtkPetrousToolInteraction::ProcessEvents(vtkObject*, unsigned long event, void* self, void*)
{
  auto* me = static_cast<vtkPetrousToolInteraction*>(self);
  try
  {
    if (me->Handle(event))
      me->EventCallbackCommand->SetAbortFlag(1);
  }
  catch (const petrous::core::Error& error) // VTK's event loops do not handle exceptions
  {
    vtkErrorWithObjectMacro(me, << error.what());
  }
}

void vtkPetrousToolInteraction::ProcessReleases(vtkObject*, unsigned long event, void* self, void*)
{
  auto* me = static_cast<vtkPetrousToolInteraction*>(self);
  try
  {
    me->LetGo(event == vtkCommand::KeyReleaseEvent ? petrous::interaction::heldKey(me->Key())
                                                   : ToolKey::None,
              event == vtkCommand::LeftButtonReleaseEvent);
  }
  catch (const petrous::core::Error& error)
  {
    vtkErrorWithObjectMacro(me, << error.what());
  }
}

bool vtkPetrousToolInteraction::Handle(unsigned long event)
{
  switch (event)
  {
  case vtkCommand::MouseMoveEvent:
    this->Point();
    return false; // the style ignores it, or is moving the camera
  case vtkCommand::LeftButtonPressEvent:
    if (!this->PointerHolds())
      return false;
    this->ButtonHeld = true;
    this->TouchOnly = this->Interactor->GetControlKey() != 0;
    this->Point();
    this->Press();
    return true;
  case vtkCommand::LeftButtonReleaseEvent:
    return this->PointerHolds();
  case vtkCommand::MouseWheelForwardEvent:
    return this->HandleWheel(1.0);
  case vtkCommand::MouseWheelBackwardEvent:
    return this->HandleWheel(-1.0);
  case vtkCommand::KeyPressEvent:
    return this->HandleKey();
  case vtkCommand::KeyReleaseEvent:
  case vtkCommand::CharEvent: // keeps the style's shortcuts (w: wireframe, e: exit) from acting too
    return this->IsOwnKey();
  default:
    return false;
  }
}

void vtkPetrousToolInteraction::LetGo(ToolKey key, bool button)
{
  bool& held = key == ToolKey::Freeze ? this->FreezeKeyHeld : this->DrillKeyHeld;
  if (button && this->ButtonHeld)
  {
    this->ButtonHeld = this->TouchOnly = false;
    this->Point();
    this->Press();
  }
  else if (key != ToolKey::None && held)
  {
    held = false;
    this->Press();
  }
}

bool vtkPetrousToolInteraction::HandleWheel(double notches)
{
  using Mode = petrous::interaction::AimSettings::Mode;
  const bool control = this->Interactor->GetControlKey() != 0;
  if (this->DrillMode && !this->PointerHand && control)
  {
    this->Base.scale = std::clamp(this->Base.scale * std::pow(kScalePerNotch, notches), 0.01, 10.0);
    this->Send();
    return true;
  }
  if (!this->PointerHolds() || control || this->Aim->settings().mode != Mode::Depth)
    return false;
  this->Aim->wheel(notches, this->Interactor->GetShiftKey() != 0);
  this->Send();
  return true;
}

// VTK's key symbol in lower case.
std::string vtkPetrousToolInteraction::Key() const
{
  const char* sym = this->Interactor->GetKeySym();
  std::string key = sym ? sym : "";
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return key;
}

bool vtkPetrousToolInteraction::IsOwnKey() const
{
  const std::string key = this->Key();
  if (petrous::interaction::heldKey(key) != ToolKey::None)
    return this->DrillMode;
  const bool others = this->Interactor->GetControlKey() != 0 || this->Interactor->GetAltKey() != 0;
  return this->PointerHolds() && !others && petrous::interaction::isToolKey(key);
}

bool vtkPetrousToolInteraction::HandleKey()
{
  if (!this->IsOwnKey())
    return false;
  const std::string key = this->Key();
  const ToolKey held = petrous::interaction::heldKey(key);
  if (held != ToolKey::None)
  {
    (held == ToolKey::Drill ? this->DrillKeyHeld : this->FreezeKeyHeld) = true;
    this->Press();
    return true;
  }
  petrous::interaction::pressKey(*this->Aim, key, this->Interactor->GetShiftKey() != 0);
  this->Send();
  return true;
}

void vtkPetrousToolInteraction::Point()
{
  if (!this->PointerHolds() || turnsCamera(*this->Interactor))
    return;
  const int* at = this->Interactor->GetEventPosition();
  this->Aim->setCamera(petrous::interaction::cameraOf(*this->CurrentRenderer));
  this->Aim->point(petrous::interaction::pickRayThrough(*this->CurrentRenderer, at[0], at[1]));
  this->Send();
}

void vtkPetrousToolInteraction::Press()
{
  using Press = PointerToolController::Press;
  if (this->Aim && this->PointerHand)
  {
    const bool touching = this->ButtonHeld || this->DrillKeyHeld;
    const Press touch = touching ? Press::Touch : Press::None;
    this->Aim->press(this->GetDrilling() ? Press::Drill : touch);
  }
  this->Send();
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
  }
  else if (!this->PointerHand)
  {
    if (this->CurrentRenderer)
      petrous::session::setCamera(this->Parameters,
                                  petrous::interaction::cameraOf(*this->CurrentRenderer));
    this->Parameters.drill = this->Base.drill || this->GetDrilling() ? 1 : 0;
    this->Parameters.clutch = this->Base.clutch || this->FreezeKeyHeld ? 1 : 0;
  }
  this->InvokeEvent(vtkCommand::InteractionEvent);
}

void vtkPetrousToolInteraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PointerHand: " << this->PointerHand << "\n"
     << indent << "DrillMode: " << this->DrillMode << "\n"
     << indent << "Drilling: " << this->GetDrilling() << "\n"
     << indent << "Scale: " << this->Base.scale << "\n";
}
