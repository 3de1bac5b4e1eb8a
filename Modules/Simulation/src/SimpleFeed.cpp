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

} // namespace petrous::simulation
