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

namespace petrous::presenters
{

namespace
{

using devices::DeviceKind;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kLookEvery = 0.3; // s, for a SpaceMouse that was pulled
// A way that is led by a speed has no end: 7 hours at full deflection.
constexpr double kEndless = 1e6; // mm

Hand spaceMouse(const devices::FoundDevice& found)
{
  Hand hand;
  hand.kind = Hand::Kind::SpaceMouse;
  hand.id = "spacemouse";
  hand.name = found.device.name;
  hand.advice = found.advice;
  return hand;
}

// Whether opening it may work; of some nodes only the attempt tells.
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

DeviceList findHands(const DeviceSources& sources)
{
  DeviceList found;
  std::vector<devices::FoundDevice> plugged;
  if (sources.hid)
    plugged = devices::findDevices(*sources.hid);
  std::optional<Hand> cap; // the first that may be opened, as SpaceMouseDevice takes it
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
    found.hands.push_back(*cap);
  for (const devices::FoundServer& server : devices::findServers(sources.serverFolders))
  {
    Hand hand;
    hand.kind = Hand::Kind::Server;
    hand.id = "server-" + server.name;
    hand.name = server.name;
    hand.program = server.program;
    found.hands.push_back(std::move(hand));
  }
  return found;
}

ActiveDevice::ActiveDevice(const DeviceSources& sources, const Hand& hand, std::function<bool()> wanted)
  : m_hand(hand)
{
  if (hand.kind == Hand::Kind::SpaceMouse)
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
  else if (hand.kind == Hand::Kind::Server)
  {
    devices::ServedDevice::Options options;
    options.name = hand.name;
    options.command = {hand.program.string()};
    options.wanted = std::move(wanted);
    auto device = std::make_unique<devices::ServedDevice>(options);
    m_problem = [served = device.get()]
    {
      const auto status = served->status();
      return status.fault.empty() ? status.lastFault : status.fault;
    };
    m_device = std::move(device);
  }
  else
    throw core::InvalidParameter("the mouse is no device to be opened");
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
  return m_device->description();
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
