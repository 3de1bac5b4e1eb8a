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

/// Where in a pedal's report its switches and its pressure are. Offsets count from the report's
/// first byte, which is the report id where the device uses ids.
struct PedalLayout
{
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::uint8_t reportId = 0; ///< 0: the device uses no ids
  std::size_t size = 1;      ///< bytes that a report has at least
  std::size_t buttonByte = 0;
  std::uint8_t buttonMask = 0;   ///< the bits that are switches
  std::size_t pressureByte = 0;  ///< little-endian
  std::size_t pressureBytes = 0; ///< 1 or 2; 0: the pedal has switches only
  std::uint16_t pressureMin = 0; ///< released
  std::uint16_t pressureMax = 0; ///< full, above pressureMin
};

/// The VEC Infinity pedal 05f3:00ff: bit 0 left, bit 1 middle, bit 2 right, no report id. No pedal
/// that reports pressure is known here; a layout of one's own can say where it lies.
std::vector<PedalLayout> knownPedals();

struct PedalState
{
  std::uint32_t buttons = 0; ///< bit n: switch n is pressed
  double pressure = 0.0;     ///< 0 to 1; stays 0 for a pedal with switches only
  bool hasPressure = false;
};

/// Takes one report into `state`; false, with the state as it was, for another id or a short one.
bool decodePedal(const PedalLayout& layout, const unsigned char* bytes, std::size_t size,
                 PedalState& state) noexcept;

/// The first pedal that is plugged in. It may be plugged in and pulled at any time; a pedal that is
/// not there is not pressed.
class Pedal
{
public:
  struct Options
  {
    std::vector<PedalLayout> layouts = knownPedals();
    std::uint32_t drillButtons = ~0U; ///< the switches that are the drill's; any, to begin with
    double lookEvery = 1.0;           ///< s between two looks for a pedal that is not there, > 0
  };
  struct Reading
  {
    double drill = 0.0;        ///< pressure 0 to 1; a switch gives 0 or 1
    std::uint32_t buttons = 0; ///< all switches
    bool connected = false;
  };

  /// Throws InvalidParameter.
  Pedal(std::shared_ptr<const HidLibrary> library, const Options& options);
  ~Pedal();

  /// From the servo's thread: waits for nothing.
  Reading read() noexcept;

  /// Why nothing comes, in words; empty while a pedal is read. Not from the servo's thread.
  std::string problem() const;

private:
  struct Sample
  {
    PedalState state;
    bool connected = false;
  };

  Options m_options;
  Sample m_incoming;    // of the reader's thread
  PedalLayout m_layout; // likewise
  core::SnapshotBuffer<Sample> m_buffer;
  Sample m_sample;                     // of the servo's thread
  std::unique_ptr<HidReader> m_reader; // last: its thread uses what stands above
};

} // namespace petrous::devices
