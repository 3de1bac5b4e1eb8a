#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Devices/HidLibrary.h"
#include "petrous/Devices/RateControl.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

class HidReader;

/// The first SpaceMouse that is plugged in, as a hand: the cap's deflection is the tool's speed.
/// It gives no force. It may be plugged in, pulled and plugged in again at any time; the pose then
/// goes on from where it was.
class SpaceMouseDevice final : public haptics::Device
{
public:
  struct Options
  {
    RateControl::Parameters rate;
    double lookEvery = 1.0; ///< s between two looks for a device that is not there, > 0
  };

  /// Throws InvalidParameter. Without a SpaceMouse it waits for one.
  SpaceMouseDevice(std::shared_ptr<const HidLibrary> library, const Options& options);
  ~SpaceMouseDevice() override;

  const haptics::DeviceDescription& description() const noexcept override { return m_description; }

  /// Health: Good, also at rest, when no reports come; Stale when reports stop while the cap is
  /// deflected (the tool then stands still); Disconnected.
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench&) noexcept override {}

  /// Why nothing comes, in words; empty while a device is read. Not from the servo's thread.
  std::string problem() const;

  /// Reports refused as garbage, so far.
  std::uint64_t refused() const noexcept;

private:
  // What the reader's thread tells the servo's.
  struct Sample
  {
    SpaceMouseState state;
    std::uint64_t reports = 0; // of motion or buttons; a new connection counts as one
    std::uint64_t refused = 0;
    bool connected = false;
  };
  void take(const unsigned char* bytes, std::size_t size) noexcept;

  haptics::DeviceDescription m_description;
  Sample m_incoming; // of the reader's thread
  core::SnapshotBuffer<Sample> m_buffer;

  // Of the servo's thread.
  Sample m_sample;
  std::uint64_t m_reports = 0;
  RateControl m_rate;

  std::unique_ptr<HidReader> m_reader; // last: its thread uses what stands above
};

} // namespace petrous::devices
