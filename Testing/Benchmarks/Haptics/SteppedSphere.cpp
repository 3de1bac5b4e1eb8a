#include "SteppedSphere.h"

#include <cmath>

namespace petrous::haptics
{

SteppedSphere::SteppedSphere(std::shared_ptr<const HapticField> field, PointShell shell,
                             double stiffness)
  : m_field(std::move(field))
  , m_shell(std::move(shell))
  , m_stiffness(stiffness)
{
}

// `normal`: at the deepest point, if any point is in tissue.
bool SteppedSphere::freeAt(const Eigen::Vector3d& position, Eigen::Vector3d& normal) const noexcept
{
  const core::GridGeometry& grid = m_field->geometry();
  const volume::MaskState& mask = *m_field->mask().acquire();
  double deepest = 0.0;
  Eigen::Vector3d at(0.0, 0.0, 0.0);
  FieldSample found;
  for (const Eigen::Vector3d& point : m_shell.points)
  {
    const Eigen::Vector3d voxel = grid.voxelFromPatient(position + point);
    const FieldSample sample = m_field->sample(voxel, mask);
    if (sample.value > deepest)
    {
      deepest = sample.value;
      at = voxel;
      found = sample;
    }
  }
  if (deepest > 0.0)
    normal = -m_field->gradient(at, found, mask).normalized();
  m_field->mask().release();
  return !(deepest > 0.0);
}

const ProxyTick& SteppedSphere::step(const Pose& goal) noexcept
{
  constexpr int turns = 3;
  m_tick = {};
  Eigen::Vector3d normal(0.0, 0.0, 0.0);
  Eigen::Vector3d way = goal.position - m_pose.position;
  for (int turn = 0; turn < turns; ++turn)
  {
    const double length = way.norm();
    const int steps = static_cast<int>(std::ceil(length / m_field->voxel()));
    bool stopped = false;
    for (int n = 0; n < steps && !stopped; ++n)
    {
      const Eigen::Vector3d next = m_pose.position + way / steps;
      stopped = !freeAt(next, normal);
      if (!stopped)
        m_pose.position = next;
    }
    if (!stopped)
      break;
    m_tick.status = ProxyStatus::Contact;
    way = goal.position - m_pose.position;
    way -= normal.dot(way) * normal;
  }
  m_tick.pose = m_pose;
  m_tick.wrench.linear = m_stiffness * (m_pose.position - goal.position);
  m_tick.contactCount = m_tick.status == ProxyStatus::Contact ? 1 : 0;
  return m_tick;
}

} // namespace petrous::haptics
