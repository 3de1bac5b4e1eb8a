#include "petrous/Devices/SpaceMouseDevice.h"

#include "HidReader.h"
#include "petrous/Core/Error.h"
#include "petrous/Devices/DeviceCatalogue.h"

namespace petrous::devices
{

SpaceMouseDevice::SpaceMouseDevice(std::shared_ptr<const HidLibrary> library,
                                   const Options& options)
  : m_rate(options.rate)
{
  if (!(options.lookEvery > 0.0))
    throw core::InvalidParameter("SpaceMouse: the time between two looks must be above 0 s");
  m_description.name = "3Dconnexion SpaceMouse";

  HidReader::Calls calls;
  calls.matches = [](const HidInterface& interface)
  {
    const auto device = known(interface);
    return device && device->kind == DeviceKind::SpaceMouse;
  };
  calls.connected = [this](const HidInterface&)
  {
    m_incoming.state = {};
    m_incoming.connected = true;
    ++m_incoming.reports; // so that the servo sees the zero deflection even after a quick replug
    m_buffer.write(m_incoming);
  };
  calls.report = [this](const unsigned char* bytes, std::size_t size) { take(bytes, size); };
  calls.disconnected = [this]
  {
    m_incoming.state = {};
    m_incoming.connected = false;
    m_buffer.write(m_incoming);
  };
  m_reader = std::make_unique<HidReader>(std::move(library), "SpaceMouse", options.lookEvery,
                                         std::move(calls));
}

SpaceMouseDevice::~SpaceMouseDevice() = default;

void SpaceMouseDevice::take(const unsigned char* bytes, std::size_t size) noexcept
{
  switch (decodeSpaceMouse(bytes, size, m_incoming.state))
  {
  case SpaceMouseReport::Motion:
  case SpaceMouseReport::Buttons:
    ++m_incoming.reports;
    break;
  case SpaceMouseReport::Refused:
    ++m_incoming.refused;
    break;
  case SpaceMouseReport::Ignored:
    return;
  }
  m_buffer.write(m_incoming);
}

haptics::DeviceReading SpaceMouseDevice::read(double now) noexcept
{
  m_buffer.read(m_sample);
  if (!m_sample.connected)
    m_rate.stop();
  else if (m_sample.reports != m_reports)
    m_rate.setDeflection(m_sample.state, now);
  m_reports = m_sample.reports;

  haptics::DeviceReading reading;
  reading.time = now;
  reading.pose = m_rate.advance(now);
  reading.buttons = m_sample.state.buttons;
  reading.health = !m_sample.connected  ? haptics::DeviceHealth::Disconnected
                   : m_rate.silent(now) ? haptics::DeviceHealth::Stale
                                        : haptics::DeviceHealth::Good;
  return reading;
}

std::string SpaceMouseDevice::problem() const
{
  return m_reader->problem();
}

std::uint64_t SpaceMouseDevice::refused() const noexcept
{
  Sample sample;
  m_buffer.read(sample);
  return sample.refused;
}

} // namespace petrous::devices
