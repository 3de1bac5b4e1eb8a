#pragma once

#include "petrous/Dissection/RemovalDepthSolver.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Session/RemovalModel.h"

namespace petrous::session
{

/// Volume balance of drilling: removed + owed + forfeited = predicted.
struct RemovalBalance
{
  double predicted = 0.0; ///< mm^3, sum of law times dt over the ticks with drill on and thrust
  double removed = 0.0;   ///< mm^3 lost from {f > 0}
  double owed = 0.0;      ///< mm^3 that the work done so far will still remove
  double forfeited = 0.0; ///< mm^3 owed at the end of contact, or kept by protected tissue
};

/// Removal by the laws [Chan2016, Eq. 8 and 9; Documentation/equations.md, "Removal"]. Each tick
/// does work at the contact,
///
///   dW = F_t r omega dt,
///
/// which removes tissue up to the depth it allows (RemovalDepthSolver); work below a step of the
/// search is owed and added to the next step.
///
/// omega  rad/s, the spindle's speed as the pedal sets it (TickInput::spindle)
/// F_t  N, vector sum of the burr's contact forces, so that opposing walls that wedge the burr do
///      not count twice
/// r    mm, distance of the contact from the spindle axis: the mean over the patch removed by the
///      last step, weighted by volume. For a small patch away from the pole that is r_b cos(theta)
///      of its middle. A step uses the mean of the patch before and after it.
class BurrRemovalModel : public RemovalModel
{
public:
  /// Tissue is removed at most this far ahead of the burr's known position: a burr that is held
  /// back (by its shaft, by protected tissue) does not drill on by itself. The remaining work is
  /// owed, at most kMaxOwed.
  static constexpr double kVoxelsAhead = 0.25; ///< voxels
  static constexpr double kMinAhead = 0.1;     ///< mm
  static constexpr double kMaxOwed = 0.05;     ///< s of work at the present rate

  /// A step that would advance the burr by less waits for more work, at most kMaxWait.
  static constexpr double kMinAdvance = 0.005; ///< voxels
  static constexpr double kMaxWait = 0.02;     ///< s of work at the present rate

  /// search  for this burr; must outlive this
  /// Throws InvalidParameter if the spindle's speed is negative.
  BurrRemovalModel(dissection::RemovalDepthSolver& search, const dissection::Burr& burr,
                   double voxel);

  void press(const TickRecord& record, double seconds) override;
  std::optional<dissection::SweptSphere> nextCut(const volume::CutMask& mask) override;
  void release() override;

  RemovalBalance balance() const noexcept;

  /// Inputs of the law at the last press.
  double thrust() const noexcept { return m_thrust; } ///< F_t, N
  double arm() const noexcept { return m_arm; }       ///< r, mm

  /// r, mm, of a round patch: the mean distance from the spindle axis over a cap of the ball, by
  /// quadrature.
  ///
  /// radius     r_b, mm
  /// elevation  theta, rad, of the spindle above the surface at the patch's middle
  /// spread     s, mm, mean distance of the patch from the line through centre and middle, i.e. r
  ///            at the pole; at least that of a burr sunk in by 2 um
  static double armOf(double radius, double elevation, double spread) noexcept;

private:
  double armOf(const Eigen::Vector3d& normal, double spread) const noexcept;
  double armOfPatch() const noexcept;
  double resistance(const volume::CutMask& mask);
  void account(const dissection::RemovalStep& step);
  void forfeit(double work);

  dissection::RemovalDepthSolver& m_search;
  double m_speed; // rad/s, at full speed
  double m_voxel; // mm
  double m_ahead; // mm
  dissection::RemovalDepthSolver::Wish m_wish;
  bool m_pressed = false; // since the last step that returned nothing more
  double m_thrust = 0.0;
  double m_arm = 0.0;
  bool m_bitten = false;            // in this contact
  dissection::ContactPatch m_patch; // of the last step
  Eigen::Vector3d m_spindle{0.0, 0.0, 1.0};
  double m_pressedArm = 0.0; // mm, used by the last press
  double m_patchArm = 0.0;   // mm, of the last step's patch
  double m_biteArm = 0.0;    // mm, of an equivalent round patch, with the spindle as it was then
  double m_rate = 0.0;       // N mm/s
  double m_resistance = 0.0; // N/mm^2, of the last step; 0: unknown in this contact
  double m_unpriced = 0.0;   // N mm done before the resistance was known
  double m_owed = 0.0;       // N mm
  RemovalBalance m_balance;  // except for what is owed
};

} // namespace petrous::session
