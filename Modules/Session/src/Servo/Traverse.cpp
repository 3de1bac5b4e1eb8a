#include "petrous/Session/Traverse.h"

#include <algorithm>
#include <utility>

namespace petrous::session
{

using Eigen::Vector3d;

namespace
{

constexpr double kBeside = 0.1;       // mm across the pick ray: the tool is above its target
constexpr double kAnotherPlace = 0.5; // mm
constexpr double kStill = 1e-4;       // mm per tick: no progress
constexpr double kMinThrust = 0.1;    // N: a tool with zero thrust must move, too
constexpr double kMaxTurn = 0.05;     // rad per tick, when held by tissue

Vector3d atMost(const Vector3d& vector, double most) noexcept
{
  const double length = vector.norm();
  return length > most ? Vector3d(most / length * vector) : vector;
}

} // namespace

void Traverse::forget() noexcept
{
  *this = Traverse(m_stiffness);
}

void Traverse::see(const haptics::ProxyTick& tick) noexcept
{
  const Vector3d moved = m_hasProxy ? Vector3d(tick.pose.position - m_proxy) : Vector3d::Zero();
  m_touches = tick.contactCount > 0;
  if (std::exchange(m_asked, false))
  {
    const bool held = m_touches && !m_down;
    m_lift = std::max(m_lift - std::max(m_up.dot(moved), 0.0), 0.0);
    m_idle = held && moved.norm() < kStill ? m_idle + 1 : 0;
    m_trying = held ? m_trying + 1 : 0;
    m_byShaft = m_byShaft && held;
    if (!m_byShaft && m_idle > kIdleTicks)
    {
      m_byShaft = true;
      m_idle = 0;
    }
  }
  else
  {
    const bool touches = m_touches;
    forget();
    m_touches = touches;
  }
  m_proxy = tick.pose.position;
  m_hasProxy = true;
}

haptics::Pose Traverse::goal(const haptics::Pose& place, const haptics::Pose& proxy,
                             const Vector3d& sight, double thrust, double dt) noexcept
{
  const double length = sight.stableNorm();
  const Vector3d down =
      length > 0.0 ? Vector3d(sight / length) : Vector3d(-(place.rotation * Vector3d::UnitZ()));
  const Vector3d offset = place.position - proxy.position;
  const double depth = down.dot(offset);
  const Vector3d beside = offset - depth * down;
  const bool over = beside.norm() <= kBeside;
  if (m_down && (place.position - m_place).norm() > kAnotherPlace)
    m_down = false;
  if (m_touches && !m_down)
  {
    m_down = over;
    m_place = place.position;
    if (!over && m_lift <= 0.0)
      m_lift = kLift;
  }
  const double held = kShare * std::max(thrust, kMinThrust) / m_stiffness;
  const double most = m_touches ? held : kSpeed * dt;

  Vector3d toGoal = offset;
  bool retracts = false;
  if (!over && !m_down)
  {
    const double lift = std::max(m_lift, -depth);
    retracts = lift > kBeside || m_lift > 0.0;
    m_up = m_byShaft ? Vector3d(proxy.rotation * Vector3d::UnitZ()) : Vector3d(-down);
    toGoal = retracts ? Vector3d(std::max(lift, kBeside) * m_up) : beside;
  }
  m_asked = true;
  // Rotating in a hole would jam it.
  const haptics::Pose goal{proxy.position + atMost(toGoal, most),
                           retracts && m_touches ? proxy.rotation : place.rotation};
  if (!m_touches)
    return goal;
  haptics::Motion turn = haptics::motionBetween(proxy, goal);
  turn.angular = atMost(turn.angular, kMaxTurn);
  return haptics::moved(proxy, turn);
}

} // namespace petrous::session
