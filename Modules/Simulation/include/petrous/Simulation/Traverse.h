#pragma once

#include "petrous/Haptics/ProxyTick.h"

namespace petrous::simulation
{

/// Leads a tool that is not pressed to its place, as a machine tool goes from cut to cut: it
/// retracts along the line of sight, traverses, comes down. For hands that point (mouse) and feel
/// nothing.
///
/// It retracts at least to the height of its place, a millimetre more where tissue is in the way,
/// and where that does not help (an undercut) along its shaft. Where it comes down on tissue before
/// it is at its place, it stays there. What holds it is pushed with a share of the thrust, so that
/// no move of the pointer makes a force to speak of.
///
/// Nothing here allocates or throws.
class Traverse
{
public:
  static constexpr double kShare = 0.3;   ///< of the thrust
  static constexpr double kLift = 1.0;    ///< mm more, where tissue is in the way
  static constexpr double kSpeed = 500.0; ///< mm/s in the air
  static constexpr int kIdleTicks = 100;  ///< without way: what it tried does not help
  static constexpr int kMaxTicks = 2000;

  /// stiffness  k of the proxy's coupling, N/mm, > 0
  explicit Traverse(double stiffness) noexcept
    : m_stiffness(stiffness)
  {
  }

  /// What the proxy did in the last tick.
  void see(const haptics::ProxyTick& tick) noexcept;

  /// The goal of the next tick.
  /// place   X_PT as given
  /// proxy   where the tool is
  /// sight   away from the eye, patient axes, of any length; zero: along the shaft of `place`
  /// thrust  N, dt s
  haptics::Pose goal(const haptics::Pose& place, const haptics::Pose& proxy,
                     const Eigen::Vector3d& sight, double thrust, double dt) noexcept;

  /// It does not come out of the tissue that holds it.
  bool stuck() const noexcept
  {
    return (m_byShaft && m_idle > kIdleTicks) || m_trying > kMaxTicks;
  }

  /// The tool was put elsewhere.
  void forget() noexcept;

private:
  double m_stiffness;
  bool m_asked = false; // a goal, for this tick
  bool m_touches = false;
  bool m_hasProxy = false;
  bool m_down = false; // it came down on tissue
  bool m_byShaft = false;
  int m_idle = 0;      // ticks in which it made no way, but was to
  int m_trying = 0;    // ticks since it was last free
  double m_lift = 0.0; // mm that it still has to retract
  Eigen::Vector3d m_proxy{0.0, 0.0, 0.0};
  Eigen::Vector3d m_place{0.0, 0.0, 0.0}; // for which it came down
  Eigen::Vector3d m_up{0.0, 0.0, 0.0};    // of the last goal
};

} // namespace petrous::simulation
