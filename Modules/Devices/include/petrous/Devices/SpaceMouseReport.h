#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace petrous::devices
{

/// State of a SpaceMouse accumulated from its reports: deflection of the cap and buttons.
struct SpaceMouseState
{
  /// x y z, rx ry rz; counts, within +-kFullDeflection. In the device's own axes: x right, y to the
  /// user, z down, right-handed rotations about them.
  std::array<std::int16_t, 6> axes{};
  std::uint32_t buttons = 0; ///< bit n: button n is held

  static constexpr int kFullDeflection = 350;

  bool deflected() const noexcept { return axes != std::array<std::int16_t, 6>{}; }

  /// -1 to 1 per component, in frame D (right, up, towards the user).
  Eigen::Vector3d translation() const noexcept { return inD(0); }
  Eigen::Vector3d rotation() const noexcept { return inD(3); }

private:
  // A 90 degree rotation about x takes (x, y to the user, z down) to (x, -z, y); it applies to
  // rotations as well.
  Eigen::Vector3d inD(std::size_t first) const noexcept
  {
    return Eigen::Vector3d(axes[first], -axes[first + 2], axes[first + 1]) /
           double{kFullDeflection};
  }
};

/// Kind of a report.
enum class SpaceMouseReport : std::uint8_t
{
  Motion,
  Buttons,
  Ignored, ///< battery, or an unknown ID
  Refused  ///< too short, too long, or impossible values; the state is unchanged
};

/// Decodes one report as returned by hidapi, with the ID in the first byte, into `state`.
/// Little-endian int16.
///
/// id 1, 7 bytes   translation x y z
/// id 1, 13 bytes  all six axes (wireless models, Enterprise, Universal Receiver)
/// id 2, 7 bytes   rotation rx ry rz
/// id 3, 2 to 9    button bits, of which 32 are kept
/// id 0x17         battery, ignored
///
/// Deflections above full scale, up to 1024, are clamped to it (older models reach 500).
SpaceMouseReport decodeSpaceMouse(const unsigned char* bytes, std::size_t size,
                                  SpaceMouseState& state) noexcept;

} // namespace petrous::devices
