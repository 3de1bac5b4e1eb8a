#include "petrous/Presenters/ActiveDevice.h"

#include <cmath>
#include <optional>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Devices/DeviceCatalogue.h"
#include "petrous/Devices/PedalledDevice.h"
#include "petrous/Devices/ServedDevice.h"
#include "petrous/Devices/ServerCatalogue.h"
#include "petrous/Devices/SpaceMouseDevice.h"
#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Presenters/DeviceLimits.h"

namespace petrous::presenters
{

namespace
{

using devices::DeviceKind;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kLookEvery = 0.3; // s, poll interval for an unplugged SpaceMouse
// Rate control is unbounded: 7 hours at full deflection.
constexpr double kEndless = 1e6; // mm

InputDevice spaceMouse(const devices::FoundDevice& found)
{
  InputDevice input;
  input.kind = InputDevice::Kind::SpaceMouse;
  input.id = "spacemouse";
  input.name = found.device.name;
  input.advice = found.advice;
  return input;
}

// Whether opening it may succeed; for some nodes only an attempt shows.
bool usable(const devices::FoundDevice& found)
{
  return found.access == devices::Access::Allowed || found.access == devices::Access::Unknown;
}

Eigen::Quaterniond mousesHeading()
{
  const interaction::AimSettings aim;
  const double turn = aim.turn * kDegree;
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(aim.tilt * kDegree, Eigen::Vector3d(-std::sin(turn), std::cos(turn), 0.0)));
}

} // namespace

DeviceList findDevices(const DeviceSources& sources)
{
  DeviceList found;
  std::vector<devices::FoundDevice> plugged;
  try
  {
    if (sources.hid)
      plugged = devices::findDevices(*sources.hid);
  }
  catch (const devices::HidError& error) // servers and mouse remain
  {
    found.hidProblem = error.what();
  }
  std::optional<InputDevice> cap; // the first that can be opened, as in SpaceMouseDevice
  for (const devices::FoundDevice& device : plugged)
  {
    const bool open = usable(device);
    if (device.device.kind == DeviceKind::SpaceMouse && (!cap || (!cap->advice.empty() && open)))
    {
      cap = spaceMouse(device);
      if (open)
        cap->advice.clear();
    }
    else if (device.device.kind == DeviceKind::Pedal && open)
      found.pedal = true;
    else if (device.device.kind == DeviceKind::Pedal)
      found.pedalAdvice = device.advice;
  }
  if (cap)
    found.devices.push_back(*cap);
  for (const devices::FoundServer& server : devices::findServers(sources.serverFolders))
  {
    InputDevice input;
    input.kind = InputDevice::Kind::Server;
    input.id = "server-" + server.name;
    input.name = server.name;
    input.program = server.program;
    found.devices.push_back(std::move(input));
  }
  return found;
}

ActiveDevice::ActiveDevice(const DeviceSources& sources, const InputDevice& input,
                           std::function<bool()> wanted,
                           std::function<void(const std::string&)> waits)
  : m_input(input)
{
  if (input.kind == InputDevice::Kind::SpaceMouse)
  {
    if (!sources.hid)
      throw core::InvalidParameter("there is no hidapi to read a SpaceMouse with");
    devices::SpaceMouseDevice::Options options;
    options.rate.reach = kEndless;
    options.lookEvery = kLookEvery;
    auto device = std::make_unique<devices::SpaceMouseDevice>(sources.hid, options);
    m_problem = [cap = device.get()] { return cap->problem(); };
    m_device = std::move(device);
  }
  else if (input.kind == InputDevice::Kind::Server)
  {
    devices::ServedDevice::Options options;
    options.name = input.name;
    options.command = {input.program.string()};
    options.wanted = std::move(wanted);
    options.waits = std::move(waits);
    auto device = std::make_unique<devices::ServedDevice>(options);
    m_problem = [served = device.get()]
    {
      const auto status = served->status();
      return status.fault.empty() ? status.lastFault : status.fault;
    };
    m_device = std::move(device);
  }
  else
    throw core::InvalidParameter("the mouse is not a device that can be opened");
  m_description = m_device->description();
  // What was measured on this device goes before what its server assumes.
  const double described = m_description.maxStiffness;
  if (const auto kept = sources.limits.empty() ? std::nullopt
                                               : keptStiffness(sources.limits, input.name,
                                                               m_description.name, described);
      m_description.givesForce)
    m_description.maxStiffness = kept.value_or(untestedStiffness(described));
  if (endless() || !m_device->description().sensesRotation)
    m_grip = mousesHeading();
}

ActiveDevice::~ActiveDevice() = default;

void ActiveDevice::setPedal(const std::shared_ptr<devices::Pedal>& pedal)
{
  if (m_pedalled || !pedal)
    return;
  m_device = std::make_unique<devices::PedalledDevice>(std::move(m_device), pedal);
  m_pedalled = true;
}

std::string ActiveDevice::problem() const
{
  return m_problem();
}

const haptics::DeviceDescription& ActiveDevice::description() const noexcept
{
  return m_description;
}

haptics::DeviceReading ActiveDevice::read(double now) noexcept
{
  haptics::DeviceReading reading = m_device->read(now);
  reading.pose.rotation = reading.pose.rotation * m_grip;
  return reading;
}

void ActiveDevice::send(const haptics::Wrench& wrench) noexcept
{
  m_device->send(wrench);
}

} // namespace petrous::presenters
