#pragma once

#include <memory>
#include <optional>

#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Presenters/DeviceMapping.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

class ActiveDeviceController;
class ThreeDView;

/// What leads the tool, from view and hand to the servo: the mouse, whose pointer leads a device of
/// its own, or a device that was chosen, whose axes are the view's.
class ToolDriver
{
public:
  ToolDriver(presenters::WorkstationModel& model, ThreeDView& view, ActiveDeviceController& devices);

  /// How the mouse leads a tool of that radius; the thrust is of every hand without force. `cuts`:
  /// false for a pointer, for which no switch is the drill's.
  void set(const interaction::AimSettings& settings, bool cuts);

  /// The device for a touch that begins, and what it makes of the setup; the tool is set there.
  haptics::Device& prepare(presenters::TouchSession::Setup& setup);
  bool byMouse() const noexcept { return m_pointer != nullptr; } ///< since `prepare`

  /// The mouse's tool is tied to it otherwise than it would be now.
  bool outgrown() const;

  /// Where a device's tool begins: a hand that comes, at its origin, before what the middle of the
  /// view shows; anew there, wherever the hand is; otherwise it goes on from where it was.
  void beginThere() noexcept;
  void beginHere();

  // What the view says; all goes to the servo at once.
  void point(const interaction::PickRay& line);
  void wheel(double notches, bool fine);
  void drill(bool held);
  void clutch(bool held);
  void letGo(); ///< of drill and pedal
  /// The mouse is pressed, and the burr has lifted (interaction::PointerToolController).
  bool lifted() const noexcept { return m_pointer && m_aim.lifted(); }

  void see(const simulation::TickRecord& record); ///< of a touch that runs
  void send();                                    ///< camera, switches and settings as they are now

private:
  Eigen::Vector3d placeLookedAt();
  presenters::DeviceMapping lead() const;
  std::optional<double> setThrust() const; // N
  void press();
  void seeByMouse(const simulation::TickRecord& record);

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  ActiveDeviceController& m_devices;
  interaction::PointerToolController m_aim;
  std::unique_ptr<haptics::Device> m_mouse;        // of the touch that runs
  interaction::PointerDevice* m_pointer = nullptr; // in it
  presenters::TouchTool::Mode m_mode = presenters::TouchTool::Mode::SixDof; // of the mouse's tool
  double m_stiffness = 0.0;                                                 // N/mm, of the same
  std::optional<Eigen::Vector3d> m_place;     // of a device's tool, patient mm
  Eigen::Vector3d m_handPlace{0.0, 0.0, 0.0}; // frame D, at the same time
  presenters::DeviceSwitches m_held;          // by button and keys
  bool m_foot = false;                        // the pedal is down
  bool m_cuts = true;
};

/// Whether a record's poses mean something.
bool isPlaced(const simulation::TickRecord& record);

} // namespace petrous::workstation
