#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Devices/HidLibrary.h"

namespace petrous::devices
{

/// What a device of the catalogue is for.
enum class DeviceKind : std::uint8_t
{
  SpaceMouse,
  Pedal,        ///< read through hidapi
  KeyboardPedal ///< types a key; nothing to open
};

struct KnownDevice
{
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  DeviceKind kind = DeviceKind::SpaceMouse;
  const char* name = "";
};

/// Every HID device that Petrous knows. Packaging/70-petrous-devices.rules names those of kind
/// SpaceMouse and Pedal, too; a test holds the one against the other.
const std::vector<KnownDevice>& knownDevices();

/// The entry of a device's interface; nothing for other devices, and for those interfaces of a
/// SpaceMouse that are not its cap (usage 1:8, where the usage is known).
std::optional<KnownDevice> known(const HidInterface& interface);

enum class Access : std::uint8_t
{
  Allowed,
  Denied, ///< no permission
  Gone,   ///< no such file, or the device behind it has gone
  Unknown ///< not a path in the file system, or another error
};

/// Whether this user may open a hidraw node for reading and writing; tries it.
Access accessTo(const std::string& path);

/// What to do about it, in plain words; empty where nothing needs to be done.
std::string adviceFor(const HidInterface& interface, Access access);

struct FoundDevice
{
  KnownDevice device;
  HidInterface interface;
  Access access = Access::Unknown;
  std::string advice; ///< empty where all is well

  /// "SpaceMouse Pro (046d:c62b)"
  std::string title() const;
};

/// The known devices that are plugged in now.
std::vector<FoundDevice> findDevices(const HidLibrary& library);

} // namespace petrous::devices
