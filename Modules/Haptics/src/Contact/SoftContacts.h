#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/ProxyQp.h"
#include "petrous/Haptics/ProxyTick.h"

namespace petrous::haptics
{

/// Action of soft structures on a tool. Each is one spring, compressed by the depth of the tool's
/// deepest point in it:
///
///   U = sum over structures of 1/2 k D^2,   D = max over the tool's points of depth, 0 outside
///
/// k      the structure's stiffness, N/mm
/// mm, from the structure's surface (volume::DistanceMap) or from its cut surface
///
/// A structure's points share the spring s in the contact problem, s >= depth_i - J_i a: several
/// points of about equal depth share its force as balance requires, regardless of their number. The
/// burr is a ball here too: its contact is where the ball is deepest.
///
/// Depth has ridges in the middle of a structure, where a tool that is pushed through snaps to the
/// other side. Where U is convex the tool moves no farther than the device (metric of the
/// coupling); the additional motion per tick is bounded, and meanwhile the force is the coupling's.
/// Force is therefore continuous in time, and the energy of a snap is lost, not fed to the hand.
///
/// Only the constructor allocates; nothing locks or throws. Not thread-safe.
class SoftContacts
{
public:
  struct Contact
  {
    ProxyContact contact;
    ProxyQp::Vector6 row;   ///< by which a motion reduces the depth
    double depth = 0.0;     ///< mm
    std::size_t spring = 0; ///< below kMaxSprings
    double give = 0.0;      ///< 1 / sqrt(k)
    double slope = 0.0;     ///< |gradient of depth|
  };

  /// Field and shell must outlive this. `turns`: six degrees of freedom, otherwise the three of
  /// translation.
  SoftContacts(const HapticField& field, const PointShell& shell, const ProxyParameters& coupling,
               bool turns);

  /// Begins a tick towards `goal`.
  void begin(const Pose& goal) noexcept;

  /// Finds the contacts of the tool at `pose`, including those that a small motion can reach, and
  /// appends them to the problem.
  void find(const Pose& pose, const volume::MaskState& state, ProxyQp& qp) noexcept;

  /// Adds the contacts found last once more.
  void addTo(ProxyQp& qp) noexcept;

  /// Sets the contacts' thrusts from the problem's last solution.
  void takeForces(const ProxyQp& qp) noexcept;
  const std::vector<Contact>& contacts() const noexcept { return m_contacts; }

  /// Fraction of the motion found that may be made before contacts must be searched again, and in
  /// this tick.
  double share(const Motion& motion) noexcept;

  /// The tool is held back for the rest of the tick: the wrench is the coupling's pull.
  bool spent() const noexcept { return m_spent; }
  Wrench pull(const Pose& pose) const noexcept;

private:
  struct Structure
  {
    const volume::DistanceMap* map;
    double give;
    Eigen::ArrayXf bound; // mm, upper bound on the depth of each point
    double linear = 0.0;  // mm and rad of motion not yet in the bounds
    double angular = 0.0;
    double top;             // largest bound
    std::uint32_t last = 0; // deepest point
    double depth = 0.0;     // mm, of that point
    double least = 0.0;     // mm: shallower points have no contact
    std::size_t first = 0;  // of its examined points, in m_looks
    std::size_t count = 0;
  };
  struct Look
  {
    std::uint32_t point = 0;
    bool cut = false;                   // depth counts from a cut
    Eigen::Vector3d arm{0.0, 0.0, 0.0}; // patient axes, mm
    volume::DistanceMap::Sample at;
  };

  double belowCut(double left) const noexcept;
  Eigen::Vector3d slopeBelowCut(const Eigen::Vector3d& voxel) const noexcept;
  Look lookAt(const volume::DistanceMap& map, const Eigen::Vector3d& arm,
              float& bound) const noexcept;
  void complete(Look& look) const noexcept;
  void look(Structure& structure) noexcept;
  double fractionOf(const Structure& structure, double linear, double angular) const noexcept;
  void addContacts(const Structure& structure, std::size_t spring) noexcept;
  bool addBall(const Structure& structure, std::size_t spring) noexcept;
  void add(const Structure& structure, std::size_t spring, const Look& look) noexcept;

  const HapticField& m_field;
  const PointShell& m_shell;
  bool m_turns;
  double m_stiffness;
  double m_angularStiffness; // 0 for a tool without rotation, as is m_lever
  double m_lever;            // mm: sqrt(angular / linear stiffness)
  double m_step;             // mm, S: motion for which contacts are found
  double m_ramp;             // mm, from a cut's surface to where nothing is removed
  Eigen::ArrayXf m_arm;      // mm, of each point from the origin
  std::vector<Structure> m_structures;
  std::vector<Look> m_looks;
  std::vector<std::size_t> m_near;  // structures whose points were examined
  std::vector<std::size_t> m_order; // structures with contacts
  std::vector<Contact> m_contacts;
  Pose m_pose;
  Pose m_goal;
  const volume::MaskState* m_state = nullptr;
  std::size_t m_firstRow = 0; // in the problem
  bool m_pressed = false;     // by the last solution
  double m_away = 0.0;        // mm, lower bound on the distance to the nearest other structure
  double m_left = 1.0;        // mm, remaining motion of the tool in this tick
  int m_steps = 0;
  bool m_spent = false;
  bool m_behind = false; // held back at the end of the last tick
};

} // namespace petrous::haptics
