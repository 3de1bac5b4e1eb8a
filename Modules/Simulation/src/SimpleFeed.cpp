#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"
#include "petrous/Simulation/Feed.h"

namespace petrous::simulation
{

namespace
{
constexpr double kMostOwed = 0.1; // mm: a burr that is held elsewhere does not bore on alone
}

SimpleFeed::SimpleFeed(double radius, double gain)
  : m_radius(radius)
  , m_gain(gain)
{
  if (!(radius > 0.0) || !std::isfinite(radius))
    throw core::InvalidParameter("feed: the burr's radius must be above 0 mm");
  if (!(gain > 0.0) || !std::isfinite(gain))
    throw core::InvalidParameter("feed: the gain must be above 0 mm/s per N");
}

std::optional<dissection::SweptSphere> SimpleFeed::bite(const TickRecord& record, double seconds)
{
  const Eigen::Vector3d force(record.burrForce[0], record.burrForce[1], record.burrForce[2]);
  const double length = force.norm();
  const double depth = m_gain * length * seconds;
  const Eigen::Vector3d at = record.proxy.pose().position;
  if (!(length > 0.0) || !(depth > 0.0) || !std::isfinite(depth) || !at.allFinite())
    return std::nullopt;
  const Eigen::Vector3d into = -force / length;
  // Contact that ended, or ticks that were left out, leave nothing owed.
  if (record.number != m_number + 1)
    m_owed = 0.0;
  else
    m_owed = std::max(0.0, m_owed - std::max(0.0, into.dot(at - m_at)));
  m_owed = std::min(m_owed, kMostOwed) + depth;
  m_at = at;
  m_number = record.number;
  return dissection::SweptSphere{at, at + m_owed * into, m_radius};
}

} // namespace petrous::simulation
