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

/// Connects the view's tool to the servo: led by the mouse, through a PointerDevice, or by a chosen
/// device, whose axes are the view's.
class ToolDriver
{
public:
  ToolDriver(presenters::WorkstationModel& model, ThreeDView& view,
             ActiveDeviceController& devices);

  ~ToolDriver();

  /// How the mouse controls the tool; the thrust applies to every device without force feedback.
  void set(const interaction::AimSettings& settings);
  const interaction::AimSettings& settings() const noexcept { return m_aim.settings(); }

  /// The device for a new touch session; adapts the setup, in which the tool is set already.
  haptics::Device& prepare(session::TouchSession::Setup& setup);
  bool byMouse() const noexcept { return m_pointer != nullptr; } ///< since `prepare`

  /// The mouse tool's coupling differs from what the current settings require.
  bool outgrown() const;

  /// Start position of the next tool. beginThere: a device's with the device at its origin, in
  /// front of what the centre of the view shows, the mouse's under its pointer; beginHere: a
  /// device's there again, wherever the device is; otherwise it continues from where it was. The
  /// servo draws a tool that would lie in tissue there back along the line of sight until it is
  /// free.
  void beginThere() noexcept;
  void beginHere();

  /// The mouse's tool has no place yet: its pointer must come over the view.
  bool awaitsPointer() const noexcept { return m_pointer && !m_aim.wanted(); }

  void letGo(); ///< at the end of a touch session
  /// The mouse button is pressed, and the burr has lifted (interaction::PointerToolController).
  bool lifted() const noexcept { return m_pointer && m_aim.lifted(); }

  void see(const session::TickRecord& record); ///< of the running touch session
  void send();                                 ///< to it, also what the settings changed

private:
  Eigen::Vector3d placeLookedAt();
  presenters::DeviceMapping mapping() const;
  std::optional<double> setThrust() const; // N
  session::ServoParameters ownParameters() const;
  void forward();

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  ActiveDeviceController& m_devices;
  interaction::PointerToolController m_aim;
  std::unique_ptr<haptics::Device> m_mouse;        // of the running touch session
  interaction::PointerDevice* m_pointer = nullptr; // part of m_mouse
  session::TouchTool::Mode m_mode = session::TouchTool::Mode::SixDof; // of the mouse's tool
  double m_stiffness = 0.0;                                           // N/mm, likewise
  bool m_continues = false;                   // the mouse's next tool, where the last one was
  std::optional<Eigen::Vector3d> m_place;     // of a device's tool, patient mm
  Eigen::Vector3d m_handPlace{0.0, 0.0, 0.0}; // frame D, at the same time
  unsigned long m_observer = 0;               // of the view's tool
};

/// Whether a record's poses are valid.
bool isPlaced(const session::TickRecord& record);

} // namespace petrous::workstation
