#pragma once

#include "petrous/Haptics/ProxyTick.h"

namespace petrous::session
{

/// Moves an unpressed tool to its target like a machine tool between cuts: it retracts along the
/// pick ray, traverses and plunges. For pointing devices (mouse) without force feedback.
///
/// It retracts at least to the height of its target, a millimetre more if tissue is in the way and,
/// if that does not help (an undercut), along its shaft. If it meets tissue before reaching its
/// target, it stays there. It pushes on obstacles with a fraction of the thrust, so that no pointer
/// motion causes a significant force.
///
/// Does not allocate or throw.
class Traverse
{
public:
  static constexpr double kShare = 0.3;   ///< of the thrust
  static constexpr double kLift = 1.0;    ///< mm more, if tissue is in the way
  static constexpr double kSpeed = 500.0; ///< mm/s in the air
  static constexpr int kIdleTicks = 100;  ///< without progress: the current strategy fails
  static constexpr int kMaxTicks = 2000;

  /// stiffness  k of the proxy's coupling, N/mm, > 0
  explicit Traverse(double stiffness) noexcept
    : m_stiffness(stiffness)
  {
  }

  /// Takes the proxy's result of the last tick.
  void see(const haptics::ProxyTick& tick) noexcept;

  /// The goal of the next tick.
  /// place   X_PT as given
  /// proxy   present pose of the tool
  /// sight   away from the camera, patient axes, of any length; zero: along the shaft of `place`
  /// thrust  N, dt s
  haptics::Pose goal(const haptics::Pose& place, const haptics::Pose& proxy,
                     const Eigen::Vector3d& sight, double thrust, double dt) noexcept;

  /// The tool cannot get out of the tissue that holds it.
  bool stuck() const noexcept { return (m_byShaft && m_idle > kIdleTicks) || m_trying > kMaxTicks; }

  /// Call when the tool was placed elsewhere.
  void forget() noexcept;

private:
  double m_stiffness;
  bool m_asked = false; // for a goal, in this tick
  bool m_touches = false;
  bool m_hasProxy = false;
  bool m_down = false; // plunged onto tissue
  bool m_byShaft = false;
  int m_idle = 0;      // ticks without intended progress
  int m_trying = 0;    // ticks since last free
  double m_lift = 0.0; // mm still to retract
  Eigen::Vector3d m_proxy{0.0, 0.0, 0.0};
  Eigen::Vector3d m_place{0.0, 0.0, 0.0}; // target of that plunge
  Eigen::Vector3d m_up{0.0, 0.0, 0.0};    // of the last goal
};

} // namespace petrous::session
