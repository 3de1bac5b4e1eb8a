#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Devices/HidLibrary.h"

namespace petrous::devices
{

class HidReader;

/// Position of switches and pressure in a pedal's report. Offsets count from the report's first
/// byte, which is the report ID if the device uses IDs.
struct PedalLayout
{
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::uint8_t reportId = 0; ///< 0: the device uses no IDs
  std::size_t size = 1;      ///< minimum length of a report, bytes
  std::size_t buttonByte = 0;
  std::uint8_t buttonMask = 0;   ///< bits that are switches
  std::size_t pressureByte = 0;  ///< little-endian
  std::size_t pressureBytes = 0; ///< 1 or 2; 0: switches only
  std::uint16_t pressureMin = 0; ///< released
  std::uint16_t pressureMax = 0; ///< fully pressed, above pressureMin
};

/// The VEC Infinity pedal 05f3:00ff: bit 0 left, bit 1 middle, bit 2 right, no report ID. No pedal
/// that reports pressure is known; supply a layout of your own for one.
std::vector<PedalLayout> knownPedals();

struct PedalState
{
  std::uint32_t buttons = 0; ///< bit n: switch n is pressed
  double pressure = 0.0;     ///< 0 to 1; always 0 for a pedal with switches only
  bool hasPressure = false;
};

/// Decodes one report into `state`; false and `state` unchanged for another ID or a short report.
bool decodePedal(const PedalLayout& layout, const unsigned char* bytes, std::size_t size,
                 PedalState& state) noexcept;

/// The first connected pedal. Hot-pluggable; a pedal that is not connected counts as released.
class Pedal
{
public:
  struct Options
  {
    std::vector<PedalLayout> layouts = knownPedals();
    std::uint32_t drillButtons = ~0U; ///< switches that start the drill; by default any
    double lookEvery = 1.0;           ///< s between two searches for a missing pedal, > 0
  };
  struct Reading
  {
    double drill = 0.0;        ///< pressure 0 to 1; a switch yields 0 or 1
    std::uint32_t buttons = 0; ///< all switches
    bool connected = false;
  };

  /// Throws InvalidParameter.
  Pedal(std::shared_ptr<const HidLibrary> library, const Options& options);
  ~Pedal();

  /// From the servo thread: does not wait.
  Reading read() noexcept;

private:
  struct Sample
  {
    PedalState state;
    bool connected = false;
  };

  Options m_options;
  Sample m_incoming;    // reader thread only
  PedalLayout m_layout; // reader thread only
  core::SnapshotBuffer<Sample> m_buffer;
  Sample m_sample;                     // servo thread only
  std::unique_ptr<HidReader> m_reader; // last: its thread uses the members above
};

} // namespace petrous::devices
