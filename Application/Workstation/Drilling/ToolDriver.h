#pragma once

#include <memory>
#include <optional>

#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Presenters/DeviceMapping.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

class ActiveDeviceController;
class ThreeDView;

/// Maps view and device input to the servo: the mouse, through a PointerDevice, or a chosen device,
/// whose axes are the view's.
class ToolDriver
{
public:
  ToolDriver(presenters::WorkstationModel& model, ThreeDView& view,
             ActiveDeviceController& devices);

  /// How the mouse controls a tool of that radius; the thrust applies to every device without force
  /// feedback. `cuts`: false for a pointer, for which no input starts the drill.
  void set(const interaction::AimSettings& settings, bool cuts);

  /// The device for a new touch session; adapts the setup, in which the tool is set already.
  haptics::Device& prepare(session::TouchSession::Setup& setup);
  bool byMouse() const noexcept { return m_pointer != nullptr; } ///< since `prepare`

  /// The mouse tool's coupling differs from what the current settings require.
  bool outgrown() const;

  /// Start position of a device's tool. beginThere: with the device at its origin, in front of what
  /// the centre of the view shows; beginHere: there again, wherever the device is; otherwise it
  /// continues from where it was.
  void beginThere() noexcept;
  void beginHere();

  // Input from the view; forwarded to the servo at once.
  void point(const interaction::PickRay& line);
  void wheel(double notches, bool fine);
  void drill(bool held);
  void clutch(bool held);
  void letGo(); ///< of drill and pedal
  /// The mouse button is pressed, and the burr has lifted (interaction::PointerToolController).
  bool lifted() const noexcept { return m_pointer && m_aim.lifted(); }

  void see(const session::TickRecord& record); ///< of the running touch session
  void send();                                 ///< current camera, switches and settings

private:
  Eigen::Vector3d placeLookedAt();
  presenters::DeviceMapping lead() const;
  std::optional<double> setThrust() const; // N
  void press();
  void seeByMouse(const session::TickRecord& record);

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  ActiveDeviceController& m_devices;
  interaction::PointerToolController m_aim;
  std::unique_ptr<haptics::Device> m_mouse;        // of the running touch session
  interaction::PointerDevice* m_pointer = nullptr; // part of m_mouse
  session::TouchTool::Mode m_mode = session::TouchTool::Mode::SixDof; // of the mouse's tool
  double m_stiffness = 0.0;                                           // N/mm, likewise
  std::optional<Eigen::Vector3d> m_place;     // of a device's tool, patient mm
  Eigen::Vector3d m_handPlace{0.0, 0.0, 0.0}; // frame D, at the same time
  presenters::DeviceSwitches m_held;          // by button and keys
  bool m_foot = false;                        // the pedal is pressed
  bool m_cuts = true;
};

/// Whether a record's poses are valid.
bool isPlaced(const session::TickRecord& record);

} // namespace petrous::workstation
