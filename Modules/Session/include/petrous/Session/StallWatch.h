#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "petrous/Session/TickRecord.h"

namespace petrous::session
{

/// Detects a pressed burr that should drill and makes no progress, and what holds it off. Uses the
/// records' timestamps; one record per frame is enough.
class StallWatch
{
public:
  static constexpr double kAfter = 2.0;  ///< s without progress
  static constexpr double kWay = 0.05;   ///< mm: a diamond burr at 0.1 N makes 0.03 mm/s
  static constexpr double kForce = 0.05; ///< N: with less it is not considered pressed
  static constexpr double kLinger = 1.5; ///< s, shaft or handpiece remain reported after they last
                                         ///< held it, while it progresses

  void see(const TickRecord& record);
  void forget() noexcept { *this = StallWatch(); } ///< another tool

  /// TickRecord::kShaft, kHandpiece: what holds the burr off the bone; 0: nothing.
  std::uint8_t heldBy() const noexcept { return m_told; }
  /// It drills and is pressed, and stands still or removes nothing (TickRecord::maskState).
  bool stalls() const noexcept { return m_stalls; }
  /// It is pressed, but does not drill, as it does not get to where it is pressed (isArriving).
  bool cannotArrive() const noexcept { return m_cannotArrive; }

private:
  struct Progress
  {
    Eigen::Vector3d place; // within kWay of where it has stood since `stood`
    double stood;          // s
    std::uint64_t mask;    // of the last tick
    double cut;            // s, last removal
    double arrived;        // s, last time it was not on its way
  };
  std::optional<Progress> m_last;
  double m_pressed = 0.0;         // s, last time with force
  std::optional<double> m_heldAt; // s, last
  std::uint8_t m_held = 0;        // at that time
  std::uint8_t m_told = 0;
  bool m_stalls = false;
  bool m_cannotArrive = false;
};

} // namespace petrous::session
