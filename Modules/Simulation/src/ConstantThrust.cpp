#include "petrous/Simulation/ConstantThrust.h"

#include <algorithm>
#include <cmath>

namespace petrous::simulation
{

using Eigen::Vector3d;

namespace
{

// s in which the advance follows what the surface gives way.
constexpr double kAdvanceTime = 0.01;

// mm of way along the surface in which the force follows what the contacts say. Not a time: in a
// hollow of the burr's own size all directions within its opening are in balance, so that one that
// follows in time wanders, and with it the law's r, though the burr stays where it is.
constexpr double kFollowWay = 1.0;

// A place that lies L beyond the tool pulls sideways by k L where the force turns by one, against
// that turn: followed as fast as anything else, a weak force would swing about from tick to tick.
constexpr double kMostGain = 0.5;

constexpr double kArrived = 0.001; // mm

// A tool that is held back sideways pulls at most with F, but follows the hand at 0.2 m/s at least.
constexpr double kLeastSideways = 0.2; // mm a tick

} // namespace

ConstantThrust::ConstantThrust(double stiffness, std::size_t burrPoints) noexcept
  : m_stiffness(stiffness)
  , m_burrPoints(burrPoints)
{
}

void ConstantThrust::see(const haptics::ProxyTick& tick, double speed, double dt) noexcept
{
  Vector3d push = Vector3d::Zero();
  for (std::size_t n = 0; n < tick.contactCount; ++n)
    if (tick.contacts[n].point < m_burrPoints)
      push += tick.contacts[n].thrust * tick.contacts[n].normal;
  const double length = push.norm();
  const bool contact = length > 0.0;
  const Vector3d moved = m_hasProxy ? Vector3d(tick.pose.position - m_proxy) : Vector3d::Zero();
  if (contact && !m_contact)
  {
    m_direction = -push / length;
    m_advance = 0.0;
  }
  else if (contact)
  {
    const double way = m_direction.dot(moved);
    const double aside = (moved - way * m_direction).norm();
    const double share = std::min(1.0 - std::exp(-aside / kFollowWay), kMostGain * m_turning);
    const Vector3d turned = m_direction - share * (push / length + m_direction);
    const double norm = turned.norm();
    m_direction = norm > 0.1 ? Vector3d(turned / norm) : Vector3d(-push / length);
    m_advance +=
        (1.0 - std::exp(-dt / kAdvanceTime)) * (std::clamp(way, 0.0, speed * dt) - m_advance);
  }
  // A tick's work is bounded (ConstrainedProxy): what gave way far may not have been fallen
  // through.
  m_falling = m_contact && !contact && (m_goal - tick.pose.position).norm() > kArrived;
  m_contact = contact || m_falling;
  m_inside = tick.status == haptics::ProxyStatus::Inside;
  m_proxy = tick.pose.position;
  m_hasProxy = true;
}

haptics::Pose ConstantThrust::goal(const haptics::Pose& place, const haptics::Pose& proxy,
                                   const Vector3d& approach, double thrust, double speed,
                                   double dt) noexcept
{
  Vector3d direction = m_direction;
  if (!m_contact)
  {
    const double length = approach.stableNorm();
    direction = length > 0.0 ? Vector3d(approach / length)
                             : Vector3d(-(place.rotation * Vector3d::UnitZ()));
  }
  const Vector3d offset = place.position - proxy.position;
  Vector3d sideways = offset - direction.dot(offset) * direction;
  const double press = thrust / m_stiffness;
  m_turning = press / std::max(press + std::abs(direction.dot(offset)), kArrived);
  double along = m_falling ? direction.dot(m_goal - proxy.position) : press + m_advance;
  if (m_inside)
    along = -speed * dt;
  else if (!m_contact)
    along = std::min(speed * dt, std::max(kReach + direction.dot(offset), -kReach));
  const double most = std::max(press, kLeastSideways);
  const double length = sideways.norm();
  if (m_contact && length > most)
    sideways *= most / length;
  m_goal = proxy.position + sideways + along * direction;
  return {m_goal, place.rotation};
}

} // namespace petrous::simulation
