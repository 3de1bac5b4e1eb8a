#pragma once

#include <memory>

#include "petrous/Devices/Pedal.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

/// A device in the hand and a pedal under the foot, as one device. Everything is the hand's, but
///
///   pedal    the greater of the hand device's and the foot's
///   buttons  the pedal's switch n is bit kFirstPedalButton + n
///
/// A pedal that is not there changes nothing, not even health.
class PedalledDevice final : public haptics::Device
{
public:
  static constexpr unsigned kFirstPedalButton = 24;

  /// Neither may be null. A pedal may be passed from hand to hand, but one reads it at a time.
  PedalledDevice(std::unique_ptr<haptics::Device> hand, std::shared_ptr<Pedal> pedal);

  const haptics::DeviceDescription& description() const noexcept override;
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench& wrench) noexcept override;

private:
  std::unique_ptr<haptics::Device> m_hand;
  std::shared_ptr<Pedal> m_pedal;
};

} // namespace petrous::devices
