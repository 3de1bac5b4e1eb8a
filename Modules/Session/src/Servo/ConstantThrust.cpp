#include "petrous/Session/ConstantThrust.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petrous::session
{

using Eigen::Vector3d;

namespace
{

// s, time constant for compensating missing force: a yielding surface reduces it.
constexpr double kAdvanceTime = 0.005;

// mm of motion along the surface over which the force direction follows the contacts. Not a time:
// in a hollow of the burr's own size all directions within its opening are in equilibrium, so that
// a direction filtered in time would drift, and with it the law's r, although the burr stays in
// place.
constexpr double kFollowWay = 1.0;

// mm of back-and-forth motion that is ignored: the tool slides on the ripples of its hollow. Where
// the force turns, the goal turns too, with the depth of the goal as lever, so that each slide
// would lead to a larger one.
constexpr double kPlay = 0.15;

// A goal at distance L beyond the tool pulls sideways by k L per radian of the force's rotation,
// against it: without this limit, a weak force would oscillate from tick to tick.
constexpr double kMaxGain = 0.5;

constexpr double kArrived = 0.001; // mm
constexpr double kStill = 1e-4;    // mm per tick: no progress

// A tool beyond its approach goes back at once.
constexpr double kMaxWayBack = 30.0; // mm

// Ripples and the skin between tool and tissue are some hundredths of a millimetre: a tool that
// presses by less is on the surface only intermittently.
constexpr double kMinPress = 0.04; // mm
constexpr double kStiffest = 10.0; // N/mm
constexpr double kAngular = 10.0;  // mm^2/rad, ratio to the stiffness

// Fraction of the force that may pull sideways on a tool that is held back; a moving tool may be
// led at up to this speed, and an excessive stretch pulls for one tick only.
constexpr double kMaxSideways = 0.7;
constexpr double kFollowSpeed = 200.0; // mm/s

// Maximum ratio of the speeds of a tool in the air from tick to tick.
constexpr double kHaste = 2.0;

} // namespace

ConstantThrust::ConstantThrust(double stiffness, std::size_t burrPoints) noexcept
  : m_stiffness(stiffness)
  , m_burrPoints(burrPoints)
{
}

haptics::ProxyParameters ConstantThrust::coupling(double thrust) noexcept
{
  haptics::ProxyParameters parameters;
  const double stiffness = std::min(thrust / kMinPress, kStiffest);
  if (stiffness > parameters.stiffness)
  {
    parameters.stiffness = stiffness;
    parameters.angularStiffness = std::max(kAngular * stiffness, parameters.angularStiffness);
  }
  return parameters;
}

void ConstantThrust::see(const haptics::ProxyTick& tick, double speed, double dt) noexcept
{
  const bool pressed = std::exchange(m_pressed, false);
  Vector3d push = Vector3d::Zero();
  for (std::size_t n = 0; n < tick.contactCount; ++n)
    if (tick.contacts[n].point < m_burrPoints)
      push += tick.contacts[n].thrust * tick.contacts[n].normal;
  const double length = push.norm();
  const bool contact = length > 0.0;
  const Vector3d moved = m_hasProxy ? Vector3d(tick.pose.position - m_proxy) : Vector3d::Zero();
  const double way = m_heading.dot(moved);
  m_glide = (moved - way * m_heading).norm();
  m_sank = std::max(way, 0.0);
  if (contact && !m_contact)
  {
    m_direction = -push / length;
    m_advance = m_pull = 0.0;
    m_from = tick.pose.position;
  }
  else if (contact)
  {
    m_pull = (push - m_direction.dot(push) * m_direction).norm() / m_stiffness;
    turn(-push / length, tick.pose.position);
    const double lacks = m_press + m_direction.dot(tick.wrench.linear) / m_stiffness;
    const double share = 1.0 - std::exp(-dt / kAdvanceTime);
    m_advance = pressed ? std::clamp(m_advance + share * lacks, 0.0, speed * dt) : 0.0;
  }
  // A tick's work is bounded (ConstrainedProxy): the tool may not have fallen all the way through
  // tissue that gave way.
  const bool falls =
      pressed && m_contact && !contact && (m_goal - tick.pose.position).norm() > kArrived;
  m_idle = falls && moved.norm() < kStill ? m_idle + 1 : 0;
  m_falling = falls && m_idle < kIdleTicks;
  m_contact = contact || m_falling;
  m_touches = tick.contactCount > 0;
  m_inside = tick.status == haptics::ProxyStatus::Inside;
  m_proxy = tick.pose.position;
  m_hasProxy = true;
}

void ConstantThrust::turn(const Vector3d& wanted, const Vector3d& position) noexcept
{
  Vector3d aside = position - m_from;
  aside -= m_direction.dot(aside) * m_direction;
  const double way = aside.norm() - kPlay;
  if (!(way > 0.0))
    return;
  m_from += way / aside.norm() * aside;
  const double share = std::min(1.0 - std::exp(-way / kFollowWay), kMaxGain * m_turning);
  const Vector3d turned = m_direction + share * (wanted - m_direction);
  const double norm = turned.norm();
  m_direction = norm > 0.1 ? Vector3d(turned / norm) : wanted;
}

haptics::Pose ConstantThrust::goal(const haptics::Pose& place, const haptics::Pose& proxy,
                                   const Vector3d& approach, double thrust, double speed,
                                   double dt) noexcept
{
  Vector3d direction = m_direction;
  const double reach = approach.stableNorm(); // mm
  if (!m_contact)
    direction =
        reach > 0.0 ? Vector3d(approach / reach) : Vector3d(-(place.rotation * Vector3d::UnitZ()));
  const Vector3d offset = place.position - proxy.position;
  Vector3d sideways = offset - direction.dot(offset) * direction;
  const double whole = thrust / m_stiffness;
  m_turning = whole / std::max(whole + std::abs(direction.dot(offset)), kArrived);
  // The lateral pull is part of the force.
  const double pull = std::min(m_pull, kMaxSideways * whole);
  m_press = std::sqrt(whole * whole - pull * pull);
  double along = m_falling ? direction.dot(m_goal - proxy.position) : m_press + m_advance;
  if (m_inside)
    along = -speed * dt;
  else if (!m_contact)
    along = std::min({speed * dt, std::max(whole, kArrived) + kHaste * m_sank,
                      std::max(reach + direction.dot(offset), -kMaxWayBack)});
  const double most = kMaxSideways * whole + std::min(m_glide, kFollowSpeed * dt);
  const double length = sideways.norm();
  if (m_contact && length > most)
    sideways *= most / length;
  Vector3d stretch = sideways + along * direction;
  // Held by something other than the burr.
  if (const double pulls = stretch.norm(); m_touches && !m_contact && pulls > whole)
    stretch *= whole / pulls;
  m_goal = proxy.position + stretch;
  m_heading = direction;
  m_pressed = true;
  return {m_goal, place.rotation};
}

} // namespace petrous::session
