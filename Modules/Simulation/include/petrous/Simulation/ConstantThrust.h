#pragma once

#include <cstddef>

#include "petrous/Haptics/ProxyTick.h"

namespace petrous::simulation
{

/// Presses the tool onto the surface with a given force, for hands that give place and heading but
/// cannot press (mouse, SpaceMouse, a written path).
///
/// In contact the goal lies F/k beyond the tool, against the burr's mean contact normal, so the
/// coupling's force there is F, what it pulls sideways included; across that direction it is the
/// given place. The direction follows the contacts as the tool goes along the surface; a burr that
/// stays in its hollow presses on as it did. Before contact the tool comes along the approach,
/// which is the way from the given place to the nearest surface, at a set speed and no farther from
/// its place than that is long; without an approach it waits there. Where the tool stands in tissue
/// it backs out the same way.
///
/// What gives way under the burr may take some ticks to be fallen through; a fall that makes no way
/// for `kIdleTicks` is over, and the tool approaches again. While shaft or handpiece hold it, it
/// pulls with no more than F.
///
/// Nothing here allocates or throws.
class ConstantThrust
{
public:
  static constexpr int kIdleTicks = 10;

  /// The coupling for a thrust of so many newtons, from the usual one at 0.04 N to 10 N/mm and
  /// 100 N mm/rad at 0.4 N and above. The ripples of a hollow, some 10 degrees steep at 0.4 mm
  /// voxels, push the burr aside by a part of the thrust, and as far as the coupling lets it: half
  /// a millimetre at 5 N and 1 N/mm. Not for hands that press by their way, nor for devices, which
  /// have a limit of their own.
  static haptics::ProxyParameters coupling(double thrust) noexcept;

  /// stiffness   k of the proxy's coupling, N/mm, > 0
  /// burrPoints  shell points that lie on the burr (PointShell::burrCount)
  ConstantThrust(double stiffness, std::size_t burrPoints) noexcept;

  /// What the proxy did in the last tick of `dt` seconds.
  void see(const haptics::ProxyTick& tick, double speed, double dt) noexcept;

  /// The goal of the next tick.
  /// place     X_PT as given
  /// proxy     where the tool is
  /// approach  from `place` to the nearest surface, patient mm; zero: none is known
  /// thrust    F, N
  /// speed     mm/s, dt s
  haptics::Pose goal(const haptics::Pose& place, const haptics::Pose& proxy,
                     const Eigen::Vector3d& approach, double thrust, double speed,
                     double dt) noexcept;

private:
  void turn(const Eigen::Vector3d& wanted, const Eigen::Vector3d& position) noexcept;

  double m_stiffness;
  std::size_t m_burrPoints;
  bool m_pressed = false; // to the goal of this tick
  bool m_contact = false;
  bool m_touches = false; // with anything: burr, shaft, handpiece
  bool m_inside = false;
  bool m_hasProxy = false;
  bool m_falling = false; // no contact, but the goal that was pressed to is not reached either
  int m_idle = 0;         // ticks of the fall that made no way
  Eigen::Vector3d m_direction{0.0, 0.0, 0.0}; // unit, into the tissue
  Eigen::Vector3d m_from{0.0, 0.0, 0.0};      // whence the way along the surface counts
  Eigen::Vector3d m_heading{0.0, 0.0, 0.0};   // of the last goal: that direction, or the approach
  Eigen::Vector3d m_proxy{0.0, 0.0, 0.0};
  Eigen::Vector3d m_goal{0.0, 0.0, 0.0};
  double m_turning = 1.0; // of the force, by what comes from its pull to the side
  double m_press = 0.0;   // mm beyond the tool, along the direction, but for the advance
  double m_advance = 0.0; // mm, what the force would lack else
  double m_pull = 0.0;    // mm, of the burr's contacts across the direction, over k
  double m_glide = 0.0;   // mm across the heading in the last tick
  double m_sank = 0.0;    // mm along it
};

} // namespace petrous::simulation
