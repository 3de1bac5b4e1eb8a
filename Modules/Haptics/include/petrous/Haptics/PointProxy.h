#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Haptics/Proxy.h"
#include "petrous/Haptics/ProxyQp.h"
#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

class BurrVolume;
class PoseBacktracker;
class SoftContacts;

/// Burr of the 3-DOF mode.
struct CentreBurr
{
  double radius = 2.0;       ///< R, mm, in [0.25, 5]
  std::size_t points = 1000; ///< about N, in [100, 5000]

  /// sigma: force of the points when the burr is half sunk in rigid tissue with a plane surface, as
  /// a fraction of k R; in [0, 2]. At 2/3 they are nowhere stiffer than the coupling.
  double superficialShare = 2.0 / 3.0;
};

/// Three degrees of freedom, for devices without torque [Chan2013, 2.3]: the burr's centre is a
/// proxy point kept on the tissue's surface, and points filling the burr push it out beforehand.
///
/// W = k (p - x) + f_0 sum_i s_i (-u_i)      force on the hand, N; no torque
///   f_0 = 4 sigma k R / N
///
/// x    goal of the burr's centre, p the proxy's, mm; p = x until x is in tissue or the burr in a
///      soft structure
/// k    coupling, ProxyParameters::stiffness, N/mm
/// u_i  unit vector from p to point i of N; the points fill the ball of radius R evenly
/// s_i  1 in rigid tissue, 0 elsewhere
///
/// The points push at p, where the tool is, not at x: the force of a wall that the burr reaches
/// through never reverses. Half sunk in a plane, sum_i s_i (-u_i) = N / 4 along the normal, hence
/// f_0; at a depth d <= R the points yield
///
///   F(d) = sigma k R (3 q^2 - 2 q^3), q = d / R
///
/// with a slope of at most 3/2 sigma k. In the limit of many points their force has the potential
/// f_0 N / V * integral over tissue in the ball of (R - r), V the ball's volume.
///
/// Energy: conservative while the centre is free, and for planes and spheres also beyond. For other
/// surfaces it is not, as the points' force depends on p while the hand moves by x: sliding along a
/// surface at depth s and back in the open gains or loses up to s times the change of that force
/// along the surface. This is inherent in the model; PassivityGuard handles it. The unevenness of
/// the points contributes up to 1 % of k R^2 per loop.
///
/// Soft structures (HapticField::soft) are springs that hold p back as soon as the burr's surface
/// touches them: the same effect as on ConstrainedProxy's burr, without rotation.
///
/// Our choice, where the paper says "fixed amount of force": f_0, and that s_i rises from 0 to 1
/// over the width of a point's fraction of the volume rather than at once. The spring force is J^T
/// lambda: k (p - x) whenever the proxy has reached the position that its planes allow.
///
/// Only rigid tissue stops the centre: swept and bisected by ShellSweep, so it never crosses, thin
/// walls included. Within a tick it slides on up to three planes at a time (face, crease, corner).
/// By design the burr sinks in by up to R. Orientation is the device's.
///
/// ProxyTick: contacts are where the ball is deepest, at -R n from the centre, so they exert no
/// torque: one for each plane that holds the centre, those of soft structures, and one for the
/// points; thrusts times normals sum to the force. `thrust` is the sum of all but the points', plus
/// the points' component along that sum. All belong to the burr; `point` is 0.
///
/// `step` does not allocate, lock or throw. Not thread-safe.
class PointProxy : public Proxy
{
public:
  /// Throws InvalidParameter naming the first invalid value. The angular stiffness of `parameters`
  /// is not used.
  PointProxy(std::shared_ptr<const HapticField> field, const CentreBurr& burr,
             const ProxyParameters& parameters = {});
  ~PointProxy() override;

  double pointForce() const noexcept { return m_pointForce; }  ///< f_0, N
  const std::vector<Eigen::Vector3d>& points() const noexcept; ///< from the centre, patient axes
  const HapticField& field() const noexcept { return m_sweep.field(); }
  const Pose& pose() const noexcept override { return m_tick.pose; }

  void place(const Pose& pose) noexcept override;
  bool placeFree(const Pose& pose) noexcept override; ///< of its centre
  const ProxyTick& step(const Pose& goal) noexcept override;

private:
  struct Plane
  {
    Eigen::Vector3d normal{0.0, 0.0, 1.0}; // unit, out of the tissue, patient axes
    Eigen::Vector3d point{0.0, 0.0, 0.0};  // of the plane, mm
  };
  static constexpr std::size_t kMaxHits = 28;   // max rounds plus kMaxKept
  static constexpr std::size_t kMaxRows = 1024; // including soft structures

  Eigen::Vector3d solve(const Eigen::Vector3d& wanted, double lift) noexcept;
  void addRow(const Plane& plane, double lift, bool tight) noexcept;
  ShellSweep::Hit advance(const Eigen::Vector3d& motion) noexcept;
  void keepPlanes() noexcept;
  bool nearPlane(Plane& plane) const noexcept;
  Plane planeOf(const ShellSweep::Hit& hit) const noexcept;
  void follow(const Eigen::Vector3d& goal) noexcept;
  Eigen::Vector3d softPush() noexcept;
  void report() noexcept;
  void addContact(const Eigen::Vector3d& normal, double thrust, double gap) noexcept;

  ProxyParameters m_parameters;
  ShellSweep m_sweep; // of a single point, the burr's centre
  std::unique_ptr<const BurrVolume> m_volume;
  double m_radius;
  double m_pointForce;
  PointShell m_ball;                    // the burr for contact with soft structures
  std::unique_ptr<SoftContacts> m_soft; // refers to m_ball; null if all tissue is rigid
  ProxyQp m_qp;
  std::array<Plane, kMaxHits> m_hits; // where sweeps of this tick ended, and some kept planes
  std::size_t m_hitCount = 0;
  std::array<Plane, kMaxHits + 1> m_rows; // of the last problem
  std::size_t m_firstHit = 0;             // first row of m_hits
  std::size_t m_planes = 0;               // rows that are planes: all but those of soft structures
  std::unique_ptr<PoseBacktracker> m_backtracker; // moves m_sweep
  std::uint64_t m_number = 0;                     // of the mask state in the last tick
  ProxyTick m_tick;
};

} // namespace petrous::haptics
