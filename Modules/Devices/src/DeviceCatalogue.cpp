#include "petrous/Devices/DeviceCatalogue.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace petrous::devices
{

namespace
{

constexpr std::uint16_t kLogitech = 0x046d;
constexpr std::uint16_t k3Dconnexion = 0x256f;

std::string titleOf(const std::string& name, std::uint16_t vendor, std::uint16_t product)
{
  char numbers[16];
  std::snprintf(numbers, sizeof numbers, " (%04x:%04x)", vendor, product);
  return name + numbers;
}

// 1:8 is the usage "multi-axis controller" of HID's generic desktop page.
bool isCap(const HidInterface& interface)
{
  return interface.usagePage == 0 || (interface.usagePage == 1 && interface.usage == 8);
}

} // namespace

const std::vector<KnownDevice>& knownDevices()
{
  using Kind = DeviceKind;
  static const std::vector<KnownDevice> devices = {
      {kLogitech, 0xc603, Kind::SpaceMouse, "SpaceMouse Plus XT"},
      {kLogitech, 0xc605, Kind::SpaceMouse, "CadMan"},
      {kLogitech, 0xc606, Kind::SpaceMouse, "SpaceMouse Classic"},
      {kLogitech, 0xc621, Kind::SpaceMouse, "SpaceBall 5000"},
      {kLogitech, 0xc623, Kind::SpaceMouse, "SpaceTraveler"},
      {kLogitech, 0xc625, Kind::SpaceMouse, "SpacePilot"},
      {kLogitech, 0xc626, Kind::SpaceMouse, "SpaceNavigator"},
      {kLogitech, 0xc627, Kind::SpaceMouse, "SpaceExplorer"},
      {kLogitech, 0xc628, Kind::SpaceMouse, "SpaceNavigator for Notebooks"},
      {kLogitech, 0xc629, Kind::SpaceMouse, "SpacePilot Pro"},
      {kLogitech, 0xc62b, Kind::SpaceMouse, "SpaceMouse Pro"},
      {kLogitech, 0xc640, Kind::SpaceMouse, "NuLOOQ"},
      {k3Dconnexion, 0xc62e, Kind::SpaceMouse, "SpaceMouse Wireless, on its cable"},
      {k3Dconnexion, 0xc62f, Kind::SpaceMouse, "SpaceMouse Wireless"},
      {k3Dconnexion, 0xc631, Kind::SpaceMouse, "SpaceMouse Pro Wireless, on its cable"},
      {k3Dconnexion, 0xc632, Kind::SpaceMouse, "SpaceMouse Pro Wireless"},
      {k3Dconnexion, 0xc633, Kind::SpaceMouse, "SpaceMouse Enterprise"},
      {k3Dconnexion, 0xc635, Kind::SpaceMouse, "SpaceMouse Compact"},
      {k3Dconnexion, 0xc636, Kind::SpaceMouse, "SpaceMouse Module"},
      {k3Dconnexion, 0xc638, Kind::SpaceMouse, "SpaceMouse Pro Wireless, Bluetooth edition"},
      {k3Dconnexion, 0xc63a, Kind::SpaceMouse, "SpaceMouse Wireless, Bluetooth edition"},
      {k3Dconnexion, 0xc652, Kind::SpaceMouse, "3Dconnexion Universal Receiver"},
      {0x05f3, 0x00ff, Kind::Pedal, "VEC Infinity foot pedal"},
      {0x0c45, 0x7403, Kind::KeyboardPedal, "PCsensor foot switch"},
      {0x0c45, 0x7404, Kind::KeyboardPedal, "PCsensor foot switch"},
      {0x413d, 0x2107, Kind::KeyboardPedal, "PCsensor foot switch"},
      {0x1a86, 0xe026, Kind::KeyboardPedal, "PCsensor foot switch"}};
  return devices;
}

std::optional<KnownDevice> known(const HidInterface& interface)
{
  for (const KnownDevice& device : knownDevices())
    if (device.vendor == interface.vendor && device.product == interface.product)
    {
      if (device.kind == DeviceKind::SpaceMouse && !isCap(interface))
        return std::nullopt;
      return device;
    }
  return std::nullopt;
}

bool isKnownPluggedIn(const std::filesystem::path& nodes)
{
  namespace fs = std::filesystem;
  std::error_code error;
  for (fs::directory_iterator node(nodes, error), end; !error && node != end; node.increment(error))
  {
    std::ifstream file(node->path() / "device" / "uevent");
    for (std::string line; std::getline(file, line);)
    {
      // Bus, vendor and product, in hexadecimal: HID_ID=0003:0000046D:0000C62B
      unsigned bus = 0;
      unsigned vendor = 0;
      unsigned product = 0;
      if (std::sscanf(line.c_str(), "HID_ID=%x:%x:%x", &bus, &vendor, &product) != 3)
        continue;
      const auto& devices = knownDevices();
      if (std::any_of(devices.begin(), devices.end(),
                      [&](const KnownDevice& device)
                      {
                        return device.vendor == vendor && device.product == product &&
                               device.kind != DeviceKind::KeyboardPedal;
                      }))
        return true;
    }
  }
  return false;
}

Access accessTo(const std::string& path)
{
  if (path.empty() || path.front() != '/')
    return Access::Unknown;
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (file >= 0)
  {
    ::close(file);
    return Access::Allowed;
  }
  switch (errno)
  {
  case EACCES:
  case EPERM:
    return Access::Denied;
  case ENOENT:
  case ENODEV:
  case ENXIO:
    return Access::Gone;
  default:
    return Access::Unknown;
  }
}

std::string adviceFor(const HidInterface& interface, Access access)
{
  const std::optional<KnownDevice> device = known(interface);
  if (device && device->kind == DeviceKind::KeyboardPedal)
    return titleOf(device->name, interface.vendor, interface.product) +
           " types a key: choose that key for the drill";
  const std::string title =
      titleOf(device ? device->name : interface.name, interface.vendor, interface.product);
  switch (access)
  {
  case Access::Allowed:
    return "";
  case Access::Denied:
    return title + " is plugged in, but you may not open " + interface.path +
           ": copy 70-petrous-devices.rules to /etc/udev/rules.d, run 'udevadm control "
           "--reload-rules' as root, and plug it in again";
  case Access::Gone:
    return title + " was unplugged: " + interface.path + " has gone";
  case Access::Unknown:
    break;
  }
  return title + " is plugged in, but " + interface.path + " cannot be opened";
}

std::string FoundDevice::title() const
{
  return titleOf(device.name, device.vendor, device.product);
}

std::vector<FoundDevice> findDevices(const HidLibrary& library)
{
  std::vector<FoundDevice> found;
  for (const HidInterface& interface : library.list())
  {
    const std::optional<KnownDevice> device = known(interface);
    const bool listed = std::any_of(found.begin(), found.end(),
                                    [&interface](const FoundDevice& other)
                                    { return other.interface.path == interface.path; });
    if (!device || listed)
      continue;
    const bool opened = device->kind != DeviceKind::KeyboardPedal;
    const Access access = opened ? accessTo(interface.path) : Access::Allowed;
    found.push_back({*device, interface, access, adviceFor(interface, access)});
  }
  return found;
}

} // namespace petrous::devices
