#include "petrous/Session/SpindleMeter.h"

#include <algorithm>

namespace petrous::session
{

void SpindleMeter::add(const TickInput& input, double seconds) noexcept
{
  const double fraction = input.spindle();
  m_seconds += seconds;
  m_turned += fraction * seconds;
  m_max = std::max(m_max, fraction);
  m_isByPedal = m_isByPedal || input.pedalSetsSpeed();
}

std::optional<dissection::SpindleSpeed> SpindleMeter::speed(double rpm) const noexcept
{
  if (!m_isByPedal)
    return std::nullopt;
  return dissection::SpindleSpeed{rpm * (m_seconds > 0.0 ? m_turned / m_seconds : m_max),
                                  rpm * m_max};
}

} // namespace petrous::session
