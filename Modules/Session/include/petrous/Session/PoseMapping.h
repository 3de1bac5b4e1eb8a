#pragma once

#include "petrous/Haptics/Pose.h"

namespace petrous::session
{

/// Maps device poses to tool poses (Documentation/frames.md): the device's axes are the camera's
/// (R = R_PD), a millimetre of the device is `scale` millimetres of the tool, rotations are 1:1.
/// From an anchor (p0, q0 of the device; P0, Q0 of the tool):
///
///   P = P0 + scale R (p - p0)        Q = R (q q0^-1) R^-1 Q0
///
/// Initially p0 = 0, q0 = 1, P0 = `center`, Q0 = R: position and orientation are the device's as
/// seen on the screen. A new camera or scale makes the last pose the anchor, so that the tool does
/// not move; `hold` makes the tool's pose the anchor, so that the device can move alone.
///
/// The wrench is mapped back by the transpose, times a gain g > 0:
///
///   F_D = g scale R^-1 F_P           T_D = g R^-1 T_P
///
/// so F_D v_D + T_D w_D = g (F_P v_P + T_P w_P): passivity at the tool implies passivity at the
/// device, at every scale. g = 1 preserves power; g = 1 / scale preserves force.
///
/// Does not allocate or throw. Inputs must be finite, rotations unit.
class PoseMapping
{
public:
  struct View
  {
    Eigen::Quaterniond camera = Eigen::Quaterniond::Identity(); ///< R_PD
    double scale = 1.0;
  };

  /// center  mm, patient: position of the tool with the device at its origin
  explicit PoseMapping(const Eigen::Vector3d& center = Eigen::Vector3d::Zero()) noexcept;

  /// X_PT of the tool for the device pose.
  haptics::Pose map(const haptics::Pose& device, const View& view) noexcept;

  /// Anchors `tool` to `device`; map() continues from there.
  void hold(const haptics::Pose& device, const View& view, const haptics::Pose& tool) noexcept;

  /// Wrench on the hand in frame D, for the view of the last map() or hold().
  haptics::Wrench toHand(const haptics::Wrench& patient, double gain) const noexcept;

private:
  View m_view;
  haptics::Pose m_device; // the anchor
  haptics::Pose m_tool;
  haptics::Pose m_lastDevice;
  haptics::Pose m_lastTool;
  bool m_used = false;
};

} // namespace petrous::session
