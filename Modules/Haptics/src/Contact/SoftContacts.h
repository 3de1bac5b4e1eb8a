#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/ProxyQp.h"
#include "petrous/Haptics/ProxyTick.h"

namespace petrous::haptics
{

/// What soft structures do to a tool. Each is one spring, pressed as deep as the tool's deepest
/// point lies in it:
///
///   U = sum over structures of 1/2 k D^2,   D = max over the tool's points of depth, 0 outside
///
/// k      the structure's stiffness, N/mm
/// depth  mm, from the structure's surface (volume::DistanceMap) or from what was cut of it
///
/// A structure's points share the spring s in the contact problem, s >= depth_i - J_i a, so that
/// where several are about as deep they share its force as they must for balance, and how many they
/// are does not matter. The burr is a ball here too: its contact is where the ball is deepest.
///
/// Depth has ridges in the middle of a structure, where a tool that is pushed through snaps to the
/// other side. Where U is convex the tool moves no farther than the hand (metric of the coupling);
/// what it moves beyond that in a tick is bounded, and the hand feels the coupling's force as it is
/// then. So force is continuous in time, and what a snap frees is lost, not given to the hand.
///
/// Only the constructor allocates; nothing locks or throws. One thread.
class SoftContacts
{
public:
  struct Contact
  {
    ProxyContact contact;
    ProxyQp::Vector6 row;   ///< by which a motion makes it less deep
    double depth = 0.0;     ///< mm
    std::size_t spring = 0; ///< below kMaxSprings
    double give = 0.0;      ///< 1 / sqrt(k)
    double slope = 0.0;     ///< |gradient of depth|
  };

  /// Field and shell must outlive this. `turns`: the tool has six degrees of freedom, else the
  /// three of translation.
  SoftContacts(const HapticField& field, const PointShell& shell, const ProxyParameters& coupling,
               bool turns);

  /// A tick towards this goal begins.
  void begin(const Pose& goal) noexcept;

  /// Finds the contacts of the tool at `pose`, those that a small motion can come to, and adds them
  /// to the problem, after the rows that it has.
  void find(const Pose& pose, const volume::MaskState& state, ProxyQp& qp) noexcept;

  /// Adds the contacts found last again.
  void addTo(ProxyQp& qp) noexcept;

  /// The contacts' thrusts from the problem's last solution.
  void takeForces(const ProxyQp& qp) noexcept;
  const std::vector<Contact>& contacts() const noexcept { return m_contacts; }

  /// How much of the motion that was found may be made before contacts are looked for again, and in
  /// this tick.
  double share(const Motion& motion) noexcept;

  /// The tool is held back for the rest of the tick: what the hand feels is the coupling's pull.
  bool spent() const noexcept { return m_spent; }
  Wrench pull(const Pose& pose) const noexcept;

private:
  struct Structure
  {
    const volume::DistanceMap* map;
    double give;
    Eigen::ArrayXf bound; // mm, on the depth of each point, from above
    double linear = 0.0;  // mm and rad of motion that bounds do not know of
    double angular = 0.0;
    double top;             // the greatest bound
    std::uint32_t last = 0; // deepest point
    double depth = 0.0;     // mm, of that
    double least = 0.0;     // mm: points less deep have no contact
    std::size_t first = 0;  // of its points that were looked at
    std::size_t count = 0;
  };
  struct Look
  {
    std::uint32_t point = 0;
    bool cut = false;                   // its depth counts from a cut
    Eigen::Vector3d arm{0.0, 0.0, 0.0}; // patient axes, mm
    volume::DistanceMap::Sample at;
  };

  double belowCut(double left) const noexcept;
  Eigen::Vector3d slopeBelowCut(const Eigen::Vector3d& voxel) const noexcept;
  Look lookAt(const volume::DistanceMap& map, const Eigen::Vector3d& arm,
              float& bound) const noexcept;
  void complete(Look& look) const noexcept;
  void look(Structure& structure) noexcept;
  double occupancyOf(const Structure& structure, double linear, double angular) const noexcept;
  void addContacts(const Structure& structure, std::size_t spring) noexcept;
  bool addBall(const Structure& structure, std::size_t spring) noexcept;
  void add(const Structure& structure, std::size_t spring, const Look& look) noexcept;

  const HapticField& m_field;
  const PointShell& m_shell;
  bool m_turns;
  double m_stiffness;
  double m_angularStiffness; // 0 for a tool that does not turn, as is m_lever
  double m_lever;            // mm: angular over linear stiffness, its root
  double m_step;             // mm, S: contacts are found for a way of so much
  double m_ramp;             // mm, from a cut's surface to where the mask is whole
  Eigen::ArrayXf m_arm;      // mm, of each point from the origin
  std::vector<Structure> m_structures;
  std::vector<Look> m_looks;
  std::vector<std::size_t> m_near;  // structures whose points were looked at
  std::vector<std::size_t> m_order; // of structures, those with contacts
  std::vector<Contact> m_contacts;
  Pose m_pose;
  Pose m_goal;
  const volume::MaskState* m_state = nullptr;
  std::size_t m_firstRow = 0; // of the problem
  bool m_pressed = false;     // in the last solution
  double m_away = 0.0;        // mm, to the nearest structure at least
  double m_left = 1.0;        // mm, of what the tool may still move in this tick
  int m_steps = 0;
  bool m_spent = false;
  bool m_behind = false; // held back at the end of the last tick
};

} // namespace petrous::haptics
