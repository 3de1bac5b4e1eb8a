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

/// What may hold the tool.
struct InputDevice
{
  enum class Kind : std::uint8_t
  {
    Mouse, ///< the pointer in the window; always there
    SpaceMouse,
    Server ///< a vendor's device behind a device server
  };
  Kind kind = Kind::Mouse;
  std::string id = "mouse";      ///< for settings: letters, digits, '.', '-', '_'
  std::string name;              ///< for people; empty for the mouse
  std::string advice;            ///< why it cannot be used, one sentence; empty when it can
  std::filesystem::path program; ///< of a server
};

inline bool operator==(const InputDevice& a, const InputDevice& b)
{
  return a.id == b.id && a.name == b.name && a.advice == b.advice && a.program == b.program;
}

struct DeviceList
{
  std::vector<InputDevice> devices{InputDevice()}; ///< the mouse first
  bool pedal = false;              ///< one is plugged in and may be opened
  std::string pedalAdvice;         ///< what to do about one that is plugged in; mostly empty
};

inline bool operator==(const DeviceList& a, const DeviceList& b)
{
  return a.devices == b.devices && a.pedal == b.pedal && a.pedalAdvice == b.pedalAdvice;
}

/// Where hands are looked for.
struct DeviceSources
{
  std::shared_ptr<const devices::HidLibrary> hid; ///< null: no SpaceMouse, no pedal
  std::vector<std::filesystem::path> serverFolders;
};

/// What is there now. Asks the system, so it may take some tenths of a second; starts no server.
DeviceList findDevices(const DeviceSources& sources);

/// A device that was taken into the hand, as the servo sees it. What senses no heading of its own
/// (a SpaceMouse, a device of three axes) begins with the heading that the mouse's tool has, so
/// that the shaft does not hide the burr.
class ActiveDevice final : public haptics::Device
{
public:
  static constexpr std::uint32_t kDrill = 1;  ///< the device's first button drills
  static constexpr std::uint32_t kClutch = 2; ///< its second one holds the tool still

  /// Waits until a server is ready (up to 10 s), or `wanted` says false. Throws
  /// devices::ServerError, InvalidParameter.
  ActiveDevice(const DeviceSources& sources, const InputDevice& input, std::function<bool()> wanted = {});
  ~ActiveDevice() override; ///< a server is ended: up to 0.7 s

  const InputDevice& input() const noexcept { return m_input; }

  /// Puts a pedal under it; not while a servo reads it. Again is as once.
  void setPedal(const std::shared_ptr<devices::Pedal>& pedal);

  /// Why nothing comes, one sentence; empty while all is well. Not from the servo's thread.
  std::string problem() const;

  /// A speed leads it, so that there is no end to its way.
  bool endless() const noexcept { return m_input.kind == InputDevice::Kind::SpaceMouse; }

  const haptics::DeviceDescription& description() const noexcept override;
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench& wrench) noexcept override;

private:
  InputDevice m_input;
  std::function<std::string()> m_problem;
  std::unique_ptr<haptics::Device> m_device;
  Eigen::Quaterniond m_grip = Eigen::Quaterniond::Identity();
  bool m_pedalled = false;
};

} // namespace petrous::presenters
