#include "petrous/Devices/PedalledDevice.h"

#include <algorithm>

#include "petrous/Core/Error.h"

namespace petrous::devices
{

PedalledDevice::PedalledDevice(std::unique_ptr<haptics::Device> hand, std::shared_ptr<Pedal> pedal)
  : m_hand(std::move(hand))
  , m_pedal(std::move(pedal))
{
  if (!m_hand || !m_pedal)
    throw core::InvalidParameter("a pedalled device needs a device for the hand and a pedal");
}

const haptics::DeviceDescription& PedalledDevice::description() const noexcept
{
  return m_hand->description();
}

haptics::DeviceReading PedalledDevice::read(double now) noexcept
{
  haptics::DeviceReading reading = m_hand->read(now);
  const Pedal::Reading foot = m_pedal->read();
  reading.pedal = std::max(reading.pedal, foot.drill);
  reading.buttons |= foot.buttons << kFirstPedalButton;
  return reading;
}

void PedalledDevice::send(const haptics::Wrench& wrench) noexcept
{
  m_hand->send(wrench);
}

} // namespace petrous::devices
