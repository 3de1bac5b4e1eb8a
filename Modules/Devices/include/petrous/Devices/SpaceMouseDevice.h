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

/// The first connected SpaceMouse: the cap's deflection is the tool's velocity. No force feedback.
/// Hot-pluggable; the pose then continues from where it was.
class SpaceMouseDevice final : public haptics::Device
{
public:
  struct Options
  {
    RateControl::Parameters rate;
    double lookEvery = 1.0; ///< s between two searches for a missing device, > 0
  };

  /// Throws InvalidParameter. Waits for a SpaceMouse if none is connected.
  SpaceMouseDevice(std::shared_ptr<const HidLibrary> library, const Options& options);
  ~SpaceMouseDevice() override;

  const haptics::DeviceDescription& description() const noexcept override { return m_description; }

  /// Health: Good, also at rest, when there are no reports; Stale if reports stop while the cap is
  /// deflected (the tool then stands still); Disconnected.
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench&) noexcept override {}

  /// Why no device is read, for display; empty while one is. Not from the servo thread.
  std::string problem() const;

  /// Number of invalid reports so far.
  std::uint64_t refused() const noexcept;

private:
  // Passed from the reader thread to the servo thread.
  struct Sample
  {
    SpaceMouseState state;
    std::uint64_t reports = 0; // of motion or buttons; a new connection counts as one
    std::uint64_t refused = 0;
    bool connected = false;
  };
  void take(const unsigned char* bytes, std::size_t size) noexcept;

  haptics::DeviceDescription m_description;
  Sample m_incoming; // reader thread only
  core::SnapshotBuffer<Sample> m_buffer;

  // Servo thread only.
  Sample m_sample;
  std::uint64_t m_reports = 0;
  RateControl m_rate;

  std::unique_ptr<HidReader> m_reader; // last: its thread uses the members above
};

} // namespace petrous::devices
