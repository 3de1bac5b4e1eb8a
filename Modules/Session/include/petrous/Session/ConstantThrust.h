#pragma once

#include <cstddef>

#include "petrous/Haptics/ProxyTick.h"

namespace petrous::session
{

/// Presses the tool onto the surface with a given force, for devices that provide a pose but cannot
/// press (mouse, SpaceMouse, scripted path).
///
/// In contact the goal is F/k beyond the tool, opposite to the burr's mean contact normal, so that
/// the coupling's force is F, including its lateral component; perpendicular to that direction the
/// goal is the given position. The direction follows the contacts as the tool moves along the
/// surface; a burr that stays in its hollow keeps its direction. Before contact the tool moves
/// along the approach, the vector from the given position to the nearest surface, at a set speed
/// and no farther from the position than its length; without an approach it waits there. Inside
/// tissue it backs out the same way.
///
/// A tool may take some ticks to fall through tissue that gave way under the burr; a fall without
/// progress for `kIdleTicks` ends, and the tool approaches again. While held by shaft or handpiece,
/// it pulls with at most F.
///
/// Does not allocate or throw.
class ConstantThrust
{
public:
  static constexpr int kIdleTicks = 10;

  /// Coupling for a given thrust, N: from the default at 0.04 N to 10 N/mm and 100 N mm/rad at 0.4
  /// N and above. Ripples of a hollow, about 10 degrees steep at 0.4 mm voxels, push the burr aside
  /// with part of the thrust, by a distance that depends on the coupling: half a millimetre at 5 N
  /// and 1 N/mm. Not for input that presses by displacement, nor for haptic devices, which have
  /// limits of their own.
  static haptics::ProxyParameters coupling(double thrust) noexcept;

  /// stiffness   k of the proxy's coupling, N/mm, > 0
  /// burrPoints  shell points on the burr (PointShell::burrCount)
  ConstantThrust(double stiffness, std::size_t burrPoints) noexcept;

  /// Takes the proxy's result of the last tick of `dt` seconds.
  void see(const haptics::ProxyTick& tick, double speed, double dt) noexcept;

  /// The goal of the next tick.
  /// place     X_PT as given
  /// proxy     present pose of the tool
  /// approach  from `place` to the nearest surface, patient mm; zero: unknown
  /// thrust    F, N
  /// speed     mm/s, dt s
  haptics::Pose goal(const haptics::Pose& place, const haptics::Pose& proxy,
                     const Eigen::Vector3d& approach, double thrust, double speed,
                     double dt) noexcept;

private:
  void turn(const Eigen::Vector3d& wanted, const Eigen::Vector3d& position) noexcept;

  double m_stiffness;
  std::size_t m_burrPoints;
  bool m_pressed = false; // towards the goal of this tick
  bool m_contact = false;
  bool m_touches = false; // anything: burr, shaft, handpiece
  bool m_inside = false;
  bool m_hasProxy = false;
  bool m_falling = false; // no contact, but the pressed goal is not reached either
  int m_idle = 0;         // ticks of the fall without progress
  Eigen::Vector3d m_direction{0.0, 0.0, 0.0}; // unit, into the tissue
  Eigen::Vector3d m_from{0.0, 0.0, 0.0};      // origin of the distance moved along the surface
  Eigen::Vector3d m_heading{0.0, 0.0, 0.0};   // of the last goal: m_direction or the approach
  Eigen::Vector3d m_proxy{0.0, 0.0, 0.0};
  Eigen::Vector3d m_goal{0.0, 0.0, 0.0};
  double m_turning = 1.0; // limit on turning, as the lateral pull feeds back
  double m_press = 0.0;   // mm beyond the tool, along the direction, without the advance
  double m_advance = 0.0; // mm, compensates for missing force
  double m_pull = 0.0;    // mm, lateral force of the burr's contacts over k
  double m_glide = 0.0;   // mm across the heading in the last tick
  double m_sank = 0.0;    // mm along it
};

} // namespace petrous::session
