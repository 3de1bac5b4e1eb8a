#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Devices/HidLibrary.h"
#include "petrous/Devices/Pedal.h"
#include "petrous/Haptics/Device.h"

namespace petrous::presenters
{

/// An input device that can control the tool.
struct InputDevice
{
  enum class Kind : std::uint8_t
  {
    Mouse, ///< the window's pointer; always available
    SpaceMouse,
    Server ///< a vendor's device behind a device server
  };
  Kind kind = Kind::Mouse;
  std::string id = "mouse";      ///< for settings: letters, digits, '.', '-', '_'
  std::string name;              ///< display name; empty for the mouse
  std::string advice;            ///< why it cannot be used, one sentence; empty if it can
  std::filesystem::path program; ///< of the server
};

inline bool operator==(const InputDevice& a, const InputDevice& b)
{
  return a.id == b.id && a.name == b.name && a.advice == b.advice && a.program == b.program;
}

struct DeviceList
{
  std::vector<InputDevice> devices{InputDevice()}; ///< the mouse first
  bool pedal = false;                              ///< one is connected and can be opened
  std::string pedalAdvice; ///< what to do about an unusable one; usually empty
  std::string hidProblem;  ///< why neither SpaceMouse nor pedal can be looked for; usually empty
};

inline bool operator==(const DeviceList& a, const DeviceList& b)
{
  return a.devices == b.devices && a.pedal == b.pedal && a.pedalAdvice == b.pedalAdvice &&
         a.hidProblem == b.hidProblem;
}

/// Where input devices are searched for.
struct DeviceSources
{
  std::shared_ptr<const devices::HidLibrary> hid; ///< null: no SpaceMouse, no pedal
  std::vector<std::filesystem::path> serverFolders = {};
  std::filesystem::path limits = {}; ///< of DeviceLimits.h; empty: none are kept
};

/// The devices available now. Queries the system (some tenths of a second); starts no server.
DeviceList findDevices(const DeviceSources& sources);

/// The device that controls the tool, as read by the servo. A device without orientation sensing
/// (SpaceMouse, 3-DOF device) starts with the orientation of the mouse's tool, so that the shaft
/// does not hide the burr.
class ActiveDevice final : public haptics::Device
{
public:
  static constexpr std::uint32_t kDrill = 1;  ///< the device's first button drills
  static constexpr std::uint32_t kClutch = 2; ///< its second button holds the tool still

  /// Waits until a server is ready (up to 10 s, two minutes while the user has to calibrate the
  /// device, as `waits` says) or `wanted` returns false. Throws devices::ServerError,
  /// InvalidParameter.
  ActiveDevice(const DeviceSources& sources, const InputDevice& input,
               std::function<bool()> wanted = {},
               std::function<void(const std::string&)> waits = {});
  ~ActiveDevice() override; ///< stops the server: up to 0.7 s

  const InputDevice& input() const noexcept { return m_input; }

  /// Attaches a pedal; not while a servo reads the device. Idempotent.
  void setPedal(const std::shared_ptr<devices::Pedal>& pedal);

  /// Why no readings arrive, one sentence; empty if none is known. Not from the servo thread.
  std::string problem() const;

  /// Rate-controlled, so its workspace is unbounded.
  bool endless() const noexcept { return m_input.kind == InputDevice::Kind::SpaceMouse; }

  const haptics::DeviceDescription& description() const noexcept override;
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench& wrench) noexcept override;

private:
  InputDevice m_input;
  std::function<std::string()> m_problem;
  std::unique_ptr<haptics::Device> m_device;
  haptics::DeviceDescription m_description;
  Eigen::Quaterniond m_grip = Eigen::Quaterniond::Identity();
  bool m_pedalled = false;
};

} // namespace petrous::presenters
