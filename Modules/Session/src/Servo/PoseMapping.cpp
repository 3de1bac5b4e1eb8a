#include "petrous/Session/PoseMapping.h"

namespace petrous::session
{

using haptics::Pose;

PoseMapping::PoseMapping(const Eigen::Vector3d& center) noexcept
{
  m_tool.position = center;
}

Pose PoseMapping::map(const Pose& device, const View& view) noexcept
{
  if (!m_used)
  {
    m_tool.rotation = view.camera;
    m_view = view;
    m_used = true;
  }
  else if (view.scale != m_view.scale || view.camera.coeffs() != m_view.camera.coeffs())
    hold(m_lastDevice, view, m_lastTool);

  const Eigen::Quaterniond& camera = m_view.camera;
  Pose tool;
  tool.position = m_tool.position + m_view.scale * (camera * (device.position - m_device.position));
  tool.rotation = camera * (device.rotation * m_device.rotation.conjugate()) * camera.conjugate() *
                  m_tool.rotation;
  m_lastDevice = device;
  m_lastTool = tool;
  return tool;
}

void PoseMapping::hold(const Pose& device, const View& view, const Pose& tool) noexcept
{
  m_used = true;
  m_view = view;
  m_device = m_lastDevice = device;
  m_tool = tool;
  // The anchor is recomputed repeatedly: its norm would drift.
  m_tool.rotation.normalize();
  m_lastTool = m_tool;
}

haptics::Wrench PoseMapping::toHand(const haptics::Wrench& patient, double gain) const noexcept
{
  const Eigen::Quaterniond back = m_view.camera.conjugate();
  return {gain * m_view.scale * (back * patient.linear), gain * (back * patient.angular)};
}

} // namespace petrous::session
