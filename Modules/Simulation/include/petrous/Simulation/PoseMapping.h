#pragma once

#include "petrous/Haptics/Pose.h"

namespace petrous::simulation
{

/// Takes the hand to the tool by the hand-eye rule (Documentation/frames.md): the device's axes are
/// the camera's, R = R_PD, a millimetre of the hand is `scale` millimetres of the tool, a turn of
/// the hand is the same turn of the tool. From an anchor (p0, q0 of the hand; P0, Q0 of the tool):
///
///   P = P0 + scale R (p - p0)        Q = R (q q0^-1) R^-1 Q0
///
/// At first p0 = 0, q0 = 1, P0 = `center`, Q0 = R: place and heading are the hand's as seen on the
/// screen. A new camera or scale makes the last pose the anchor, so that it does not move the tool;
/// `hold` makes the tool's pose the anchor, so that the hand can move alone.
///
/// The wrench goes back by the transpose of that map, times a gain g > 0:
///
///   F_D = g scale R^-1 F_P           T_D = g R^-1 T_P
///
/// so F_D v_D + T_D w_D = g (F_P v_P + T_P w_P): what is passive in the patient is passive in the
/// hand, at every scale. g = 1 keeps the power; g = 1 / scale keeps the newtons.
///
/// Nothing here allocates or throws. Inputs must be finite, rotations unit.
class PoseMapping
{
public:
  struct View
  {
    Eigen::Quaterniond camera = Eigen::Quaterniond::Identity(); ///< R_PD
    double scale = 1.0;
  };

  /// center  mm, patient: where the tool is when the hand is at the device's origin
  explicit PoseMapping(const Eigen::Vector3d& center = Eigen::Vector3d::Zero()) noexcept;

  /// The hand at `device` moves the tool. X_PT.
  haptics::Pose map(const haptics::Pose& device, const View& view) noexcept;

  /// The hand is at `device` and the tool stays at `tool`; map() goes on from there.
  void hold(const haptics::Pose& device, const View& view, const haptics::Pose& tool) noexcept;

  /// Wrench on the hand in frame D, by the view of the last map() or hold().
  haptics::Wrench toHand(const haptics::Wrench& patient, double gain) const noexcept;

private:
  View m_view;
  haptics::Pose m_device; // the anchor
  haptics::Pose m_tool;
  haptics::Pose m_lastDevice;
  haptics::Pose m_lastTool;
  bool m_used = false;
};

} // namespace petrous::simulation
