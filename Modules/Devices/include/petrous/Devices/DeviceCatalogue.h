#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Devices/HidLibrary.h"

namespace petrous::devices
{

/// Purpose of a known device.
enum class DeviceKind : std::uint8_t
{
  SpaceMouse,
  Pedal,        ///< read through hidapi
  KeyboardPedal ///< acts as a keyboard; nothing to open
};

struct KnownDevice
{
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  DeviceKind kind = DeviceKind::SpaceMouse;
  const char* name = "";
};

/// All HID devices known to Petrous. Packaging/70-petrous-devices.rules must list those of kind
/// SpaceMouse and Pedal as well; checked by a test.
const std::vector<KnownDevice>& knownDevices();

/// The entry for a device's interface; nullopt for other devices, and for interfaces of a
/// SpaceMouse other than the cap (usage 1:8, if the usage is known).
std::optional<KnownDevice> known(const HidInterface& interface);

/// Whether the kernel lists a SpaceMouse or pedal that is known, by the hidraw nodes below
/// `nodes`. Reads a few files of sysfs; loads no library and opens no device.
bool isKnownPluggedIn(const std::filesystem::path& nodes = "/sys/class/hidraw");

enum class Access : std::uint8_t
{
  Allowed,
  Denied, ///< no permission
  Gone,   ///< no such file, or its device was unplugged
  Unknown ///< not a path in the file system, or another error
};

/// Whether this user may open a hidraw node for reading and writing; determined by opening it.
Access accessTo(const std::string& path);

/// What the user should do about it; empty if nothing.
std::string adviceFor(const HidInterface& interface, Access access);

struct FoundDevice
{
  KnownDevice device;
  HidInterface interface;
  Access access = Access::Unknown;
  std::string advice; ///< empty if none is needed

  /// "SpaceMouse Pro (046d:c62b)"
  std::string title() const;
};

/// The known devices that are plugged in now.
std::vector<FoundDevice> findDevices(const HidLibrary& library);

} // namespace petrous::devices
