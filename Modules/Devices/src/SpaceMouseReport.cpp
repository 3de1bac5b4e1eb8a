#include "petrous/Devices/SpaceMouseReport.h"

#include <algorithm>
#include <cstdlib>

namespace petrous::devices
{

namespace
{

constexpr int kFarthest = 1024; // counts; larger values are invalid

// `count` axes from `bytes` into `axes`; false and unchanged if invalid.
bool readAxes(const unsigned char* bytes, std::size_t count, std::int16_t* axes) noexcept
{
  std::array<std::int16_t, 6> read{};
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto word = static_cast<std::uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8));
    const int value = static_cast<std::int16_t>(word);
    if (std::abs(value) > kFarthest)
      return false;
    read[i] = static_cast<std::int16_t>(
        std::clamp(value, -SpaceMouseState::kFullDeflection, SpaceMouseState::kFullDeflection));
  }
  std::copy_n(read.begin(), count, axes);
  return true;
}

SpaceMouseReport motion(bool taken) noexcept
{
  return taken ? SpaceMouseReport::Motion : SpaceMouseReport::Refused;
}

} // namespace

SpaceMouseReport decodeSpaceMouse(const unsigned char* bytes, std::size_t size,
                                  SpaceMouseState& state) noexcept
{
  if (size == 0)
    return SpaceMouseReport::Refused;
  const unsigned char* const values = bytes + 1;
  switch (bytes[0])
  {
  case 1:
    if (size == 13)
      return motion(readAxes(values, 6, state.axes.data()));
    return motion(size == 7 && readAxes(values, 3, state.axes.data()));
  case 2:
    return motion(size == 7 && readAxes(values, 3, state.axes.data() + 3));
  case 3:
    if (size < 2 || size > 9)
      return SpaceMouseReport::Refused;
    state.buttons = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(size - 1, 4); ++i)
      state.buttons |= static_cast<std::uint32_t>(values[i]) << (8 * i);
    return SpaceMouseReport::Buttons;
  default:
    return SpaceMouseReport::Ignored;
  }
}

} // namespace petrous::devices
