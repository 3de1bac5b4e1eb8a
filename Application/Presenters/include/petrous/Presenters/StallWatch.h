#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "petrous/Simulation/TickRecord.h"

namespace petrous::presenters
{

/// Whether a burr that drills makes no way, and what holds it, for as long as that is so. By the
/// records' own clock; one record a picture is enough.
class StallWatch
{
public:
  static constexpr double kAfter = 2.0;  ///< s in which it made no way
  static constexpr double kWay = 0.05;   ///< mm: a diamond burr at 0.1 N makes 0.03 mm/s
  static constexpr double kForce = 0.05; ///< N: with less it is not pressed
  static constexpr double kLinger = 1.5; ///< s that shaft or handpiece are told of after the last
                                         ///< tick in which they held it, while it makes way

  void see(const simulation::TickRecord& record);
  void forget() noexcept { *this = StallWatch(); } ///< another tool

  /// Of TickRecord::kShaft, kHandpiece: what holds the burr off the bone; 0: nothing does.
  std::uint8_t heldBy() const noexcept { return m_told; }
  bool stalls() const noexcept { return m_stalls; } ///< it is pressed and makes no way

private:
  std::optional<Eigen::Vector3d> m_from; // where it has stood
  double m_since = 0.0;                  // s, since when
  double m_pressed = 0.0;                // s, when it had force last
  std::optional<double> m_heldAt;        // s, last
  std::uint8_t m_held = 0;               // at that time
  std::uint8_t m_told = 0;
  bool m_stalls = false;
};

} // namespace petrous::presenters
