#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"
#include "petrous/Simulation/Feed.h"

namespace petrous::simulation
{

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
  return dissection::SweptSphere{at, at - depth / length * force, m_radius};
}

std::optional<dissection::SweptSphere> OwedFeed::bite(const TickRecord& record, double seconds)
{
  auto bite = m_feed.bite(record, seconds);
  if (!bite)
    return std::nullopt;
  const Eigen::Vector3d way = bite->to - bite->from;
  const double depth = way.norm();
  if (!(depth > 0.0))
    return bite;
  const Eigen::Vector3d into = way / depth;
  // Contact that ended, or ticks that were left out, leave nothing owed.
  if (record.number != m_number + 1)
    m_owed = 0.0;
  else
    m_owed = std::max(0.0, m_owed - std::max(0.0, into.dot(bite->from - m_at)));
  m_owed = std::min(m_owed, kMost) + depth;
  m_at = bite->from;
  m_number = record.number;
  bite->to = bite->from + m_owed * into;
  return bite;
}

} // namespace petrous::simulation
