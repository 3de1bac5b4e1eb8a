#pragma once

#include <memory>

#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Proxy.h"

namespace petrous::haptics
{

/// Peer for these benchmarks: a god object as in point-based haptic rendering (Zilles and Salisbury
/// 1995), a ball without rotation. It moves towards the goal one voxel at a time and stops where
/// one of its points is in tissue at the end of a step; the rest of the motion then follows the
/// tangent plane there, twice. Nothing is tested between two steps.
class SteppedSphere : public Proxy
{
public:
  SteppedSphere(std::shared_ptr<const HapticField> field, PointShell shell, double stiffness = 1.0);

  const Pose& pose() const noexcept override { return m_pose; }
  void place(const Pose& pose) noexcept override { m_pose = pose; }
  bool placeFree(const Pose& pose) noexcept override
  {
    Eigen::Vector3d normal;
    if (!freeAt(pose.position, normal))
      return false;
    place(pose);
    return true;
  }
  const ProxyTick& step(const Pose& goal) noexcept override;

private:
  bool freeAt(const Eigen::Vector3d& position, Eigen::Vector3d& normal) const noexcept;

  std::shared_ptr<const HapticField> m_field;
  PointShell m_shell;
  double m_stiffness; // N/mm
  Pose m_pose;
  ProxyTick m_tick;
};

} // namespace petrous::haptics
