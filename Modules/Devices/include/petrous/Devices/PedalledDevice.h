#pragma once

#include <memory>

#include "petrous/Devices/Pedal.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

/// A hand-held device and a foot pedal as one device. Everything is the hand-held device's, except
///
///   pedal    the maximum of the two
///   buttons  the pedal's switch n is bit kFirstPedalButton + n
///
/// A missing pedal changes nothing, not even health.
class PedalledDevice final : public haptics::Device
{
public:
  static constexpr unsigned kFirstPedalButton = 24;

  /// Neither may be null. A pedal may be passed from device to device, but only one may read it at
  /// a time.
  PedalledDevice(std::unique_ptr<haptics::Device> hand, std::shared_ptr<Pedal> pedal);

  const haptics::DeviceDescription& description() const noexcept override;
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench& wrench) noexcept override;

private:
  std::unique_ptr<haptics::Device> m_hand;
  std::shared_ptr<Pedal> m_pedal;
};

} // namespace petrous::devices
