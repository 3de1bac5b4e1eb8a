#include "petrous/Session/StallWatch.h"

#include <algorithm>

namespace petrous::session
{

namespace
{
constexpr double kNoForce = 0.3; // s: contacts fluctuate from tick to tick
}

void StallWatch::see(const TickRecord& record)
{
  const bool arriving = isArriving(record);
  if (record.drill == 0 && !arriving)
  {
    // A fault has a sentence of its own, and a reading that is late does not let go of the burr.
    if (!record.input.drillWanted() || record.fault == 0)
      forget();
    return;
  }
  const double now = record.time();
  const Eigen::Vector3d burr = record.proxy.pose().position;
  if (!m_last || record.wrench.wrench().linear.norm() > kForce)
    m_pressed = now;
  if (!m_last || now - m_pressed > kNoForce)
    m_last = Progress{burr, now, record.maskState, now, now};
  if ((burr - m_last->place).norm() > kWay)
  {
    m_last->place = burr;
    m_last->stood = now;
  }
  if (record.maskState != m_last->mask || arriving)
    m_last->cut = now;
  m_last->mask = record.maskState;
  if (arriving)
    m_last->stood = now;
  else
    m_last->arrived = now;
  m_cannotArrive = now - m_last->arrived > kAfter;
  m_stalls = now - std::min(m_last->stood, m_last->cut) > kAfter;
  if (isHeldOff(record))
  {
    m_heldAt = now;
    m_held = record.held;
  }
  const bool held =
      m_heldAt && (now - *m_heldAt < kLinger || (m_stalls && *m_heldAt >= m_last->stood));
  m_told = held ? m_held : 0;
}

} // namespace petrous::session
