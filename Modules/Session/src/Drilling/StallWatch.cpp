#include "petrous/Session/StallWatch.h"

namespace petrous::session
{

namespace
{
constexpr double kNoForce = 0.3; // s: contacts fluctuate from tick to tick
}

void StallWatch::see(const TickRecord& record)
{
  if (record.drill == 0)
    return forget();
  const double now = record.time();
  const Eigen::Vector3d burr = record.proxy.pose().position;
  if (!m_from || record.wrench.wrench().linear.norm() > kForce)
    m_pressed = now;
  if (!m_from || (burr - *m_from).norm() > kWay || now - m_pressed > kNoForce)
  {
    m_from = burr;
    m_since = now;
  }
  m_stalls = now - m_since > kAfter;
  if (isHeldOff(record))
  {
    m_heldAt = now;
    m_held = record.held;
  }
  const bool held = m_heldAt && (now - *m_heldAt < kLinger || (m_stalls && *m_heldAt >= m_since));
  m_told = held ? m_held : 0;
}

} // namespace petrous::session
