#include "petrous/Devices/Pedal.h"

#include <algorithm>

#include "HidReader.h"
#include "petrous/Core/Error.h"

namespace petrous::devices
{

namespace
{

const PedalLayout* layoutOf(const std::vector<PedalLayout>& layouts, const HidInterface& interface)
{
  for (const PedalLayout& layout : layouts)
    if (layout.vendor == interface.vendor && layout.product == interface.product)
      return &layout;
  return nullptr;
}

void check(const PedalLayout& layout)
{
  if (layout.buttonByte >= layout.size ||
      layout.pressureByte + layout.pressureBytes > layout.size || layout.pressureBytes > 2 ||
      (layout.pressureBytes > 0 && layout.pressureMax <= layout.pressureMin))
    throw core::InvalidParameter("pedal: a layout's bytes must lie within its " +
                                 std::to_string(layout.size) +
                                 " bytes, and full pressure above none");
}

} // namespace

std::vector<PedalLayout> knownPedals()
{
  PedalLayout infinity;
  infinity.vendor = 0x05f3;
  infinity.product = 0x00ff;
  infinity.buttonMask = 0x07;
  return {infinity};
}

bool decodePedal(const PedalLayout& layout, const unsigned char* bytes, std::size_t size,
                 PedalState& state) noexcept
{
  if (size == 0 || size < layout.size || (layout.reportId != 0 && bytes[0] != layout.reportId))
    return false;
  state.buttons = bytes[layout.buttonByte] & layout.buttonMask;
  state.hasPressure = layout.pressureBytes > 0;
  if (state.hasPressure)
  {
    int value = bytes[layout.pressureByte];
    if (layout.pressureBytes == 2)
      value |= bytes[layout.pressureByte + 1] << 8;
    state.pressure = std::clamp(double(value - layout.pressureMin) /
                                    double(layout.pressureMax - layout.pressureMin),
                                0.0, 1.0);
  }
  return true;
}

Pedal::Pedal(std::shared_ptr<const HidLibrary> library, const Options& options)
  : m_options(options)
{
  if (!(options.lookEvery > 0.0))
    throw core::InvalidParameter("pedal: the time between two looks must be above 0 s");
  for (const PedalLayout& layout : options.layouts)
    check(layout);

  HidReader::Calls calls;
  calls.matches = [this](const HidInterface& interface)
  { return layoutOf(m_options.layouts, interface) != nullptr; };
  calls.connected = [this](const HidInterface& interface)
  {
    m_layout = *layoutOf(m_options.layouts, interface);
    m_incoming = {{}, true};
    m_buffer.write(m_incoming);
  };
  calls.report = [this](const unsigned char* bytes, std::size_t size)
  {
    if (decodePedal(m_layout, bytes, size, m_incoming.state))
      m_buffer.write(m_incoming);
  };
  calls.disconnected = [this]
  {
    m_incoming = {};
    m_buffer.write(m_incoming);
  };
  m_reader = std::make_unique<HidReader>(std::move(library), "foot pedal", options.lookEvery,
                                         std::move(calls));
}

Pedal::~Pedal() = default;

Pedal::Reading Pedal::read() noexcept
{
  m_buffer.read(m_sample);
  const PedalState& state = m_sample.state;
  const bool pressed = (state.buttons & m_options.drillButtons) != 0;
  return {state.hasPressure ? state.pressure : (pressed ? 1.0 : 0.0), state.buttons,
          m_sample.connected};
}

} // namespace petrous::devices
