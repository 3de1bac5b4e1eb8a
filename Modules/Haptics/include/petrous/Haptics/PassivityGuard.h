#pragma once

#include <array>

#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// Keeps the rendered wrench from feeding energy into the hand: time-domain passivity observer and
/// controller for impedance devices (Hannaford and Ryu, IEEE Trans. Robotics and Automation 18(1),
/// 2002, doi 10.1109/70.988969: series controller).
///
/// E_n     = E_(n-1) - W_(n-1) . (x_n - x_(n-1)) + |dx|_b^2 / dt       energy put in by the hand
///   alpha_n = min(alpha_max, (-E_n - allowance) / (|v_n|^2 dt))  where E_n < -allowance, else 0
///   W_n     = wanted_n - alpha_n L^2 v_n
///
/// W       wrench on the hand about the grip, held between ticks, so that its work over the
///         grip's subsequent step is exact
/// x, v    pose of the grip, mm and rad; v_n = (x_n - x_(n-1)) / dt
/// |v|^2   |v_lin|^2 + lever^2 |omega|^2, L = diag(1, lever): combines mm and rad
/// |dx|_b^2 / dt  energy dissipated by the device's own damping, which allows a spring of up to
///         K = 2 b / dt (Colgate and Schenkel 1997) without the controller
///
/// The pose x is known to half an encoder's count q: of all motions along an axis that agree with
/// the readings p, x is the one that moves least (play of +-s about the reading),
///
///   s = min(q/2, f/k),  f = 0.05 N
///
/// So counts are no energy and no velocity where the hand moves slowly: with the reading itself,
/// each press on a spring would cost |F| q. What a motion within s hides is left to the friction
/// k s <= f of the joints, which is credited with k s |dx|; with that, no slow press leaves a debt
/// up to k = 4 f / q. q is the smallest change of a reading after 8 ticks without one, up to 0.1
/// mm; before the first, and where k is unknown, s = 0. Rotations have no play.
///
/// Differences from the paper, our choice: the energy is that of the actual output over the actual
/// step, not of wanted force times present velocity; the device's damping is credited; alpha is
/// limited and the remaining debt paid in later ticks; and E is capped at what the coupling's
/// springs can give back along x at the wanted wrench, so that a minute of drilling gives no credit
/// for later,
///
///   U = |F|^2/(2 k) + F . (p - x) + |tau|^2/(2 k_a), at least 0
///
/// Without known springs E is capped at 0 whenever the wanted wrench is zero. What is guaranteed,
/// under what assumptions: record 55.
///
/// The environment is assumed to store no energy at the first tick. A time step that is not
/// positive or is above 20 ms, or a pose that is not finite, is not observed: the wanted wrench
/// passes and observation resumes from there. A wrench that is not finite passes too; ForceLimits
/// stops it. A wanted wrench that needs no damping passes bit-identical.
///
/// Not thread-safe; apply and sent do not allocate or throw.
class PassivityGuard
{
public:
  struct Parameters
  {
    double allowance = 0.05;           ///< N mm (mJ) that may be generated, > 0
    double stiffness = 0.0;            ///< k of the coupling, N/mm; 0: unknown
    double angularStiffness = 0.0;     ///< k_a, N mm/rad; 0: unknown
    double deviceDamping = 0.0;        ///< b of the device, N s/mm, guaranteed; >= 0
    double deviceAngularDamping = 0.0; ///< N mm s/rad, >= 0
    double largestDamping = 0.02;      ///< alpha_max, N s/mm, > 0; stable up to about half of the
                                       ///< moving mass over dt (50 g at 1 kHz: 0.025)
    double lever = 30.0;               ///< mm, > 0; of the order of sqrt(inertia / mass)
  };

  /// Throws InvalidParameter naming the first invalid value.
  explicit PassivityGuard(const Parameters& parameters);
  PassivityGuard()
    : PassivityGuard(Parameters())
  {
  }

  /// wanted  on the hand about the grip, N and N mm, in the frame of `pose`
  /// pose    of the grip now; now  s, the servo's clock
  Wrench apply(const Wrench& wanted, const Pose& pose, double now) noexcept;

  /// The wrench actually sent to the motors, if limits changed what apply returned.
  void sent(const Wrench& wrench) noexcept;

  double energy() const noexcept { return m_energy; }   ///< E, N mm
  double damping() const noexcept { return m_damping; } ///< alpha of the last tick, N s/mm

private:
  double maxStored(const Wrench& wanted, const Eigen::Vector3d& position) const noexcept;
  void lookForCounts(const Eigen::Vector3d& position) noexcept;

  Parameters m_parameters;
  Wrench m_sent;
  Pose m_pose;                               ///< x
  Eigen::Vector3d m_read{0.0, 0.0, 0.0};     ///< mm, the last reading
  Eigen::Vector3d m_count{0.0, 0.0, 0.0};    ///< q, mm
  std::array<int, 3> m_unchanged{{0, 0, 0}}; ///< ticks
  double m_time = 0.0;
  bool m_hasPose = false;
  double m_energy = 0.0;
  double m_damping = 0.0;
};

} // namespace petrous::haptics
