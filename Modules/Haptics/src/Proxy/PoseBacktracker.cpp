#include "PoseBacktracker.h"

#include <algorithm>

namespace petrous::haptics
{

namespace
{
constexpr double kTrailStep = 0.5;        // voxels
constexpr std::size_t kMaxRetreat = 3000; // field samples per tick
} // namespace

PoseBacktracker::PoseBacktracker(ShellSweep& sweep)
  : m_sweep(sweep)
  , m_trail(kTrail)
{
}

void PoseBacktracker::clear(ProxyTick& tick) noexcept
{
  tick.status = ProxyStatus::Free;
  tick.wrench = {};
  tick.contactCount = 0;
  tick.thrust = 0.0;
  tick.penetration = 0.0;
  tick.rounds = 0;
  tick.postponed = 0.0;
  tick.nearPoints = 0;
  tick.samples = 0;
}

void PoseBacktracker::settle(std::size_t most) noexcept
{
  m_inside = !m_sweep.measure(most);
  m_retreats = false;
  if (!m_inside)
    remember();
}

bool PoseBacktracker::place(const Pose& pose) noexcept
{
  if (!pose.finite())
    return false;
  const volume::PublishedMask& mask = m_sweep.field().mask();
  m_sweep.look(*mask.acquire());
  m_raises = m_sweep.state().raises();
  m_sweep.moveTo(pose);
  m_trailLength = 0;
  settle(SIZE_MAX);
  mask.release();
  return true;
}

bool PoseBacktracker::freeAt(const Pose& pose) noexcept
{
  if (!pose.finite())
    return false;
  const volume::PublishedMask& mask = m_sweep.field().mask();
  m_sweep.look(*mask.acquire());
  const bool free = m_sweep.freeAt(pose);
  mask.release();
  return free;
}

void PoseBacktracker::follow(const Pose& goal) noexcept
{
  if (m_retreats)
    return;
  m_sweep.moveTo(goal);
  settle(ShellSweep::kMaxQuery);
}

void PoseBacktracker::remember() noexcept
{
  const std::size_t last = (m_trailEnd + kTrail - 1) % kTrail;
  if (m_trailLength > 0 &&
      maxDisplacement(motionBetween(m_trail[last], m_sweep.pose()), m_sweep.shell().reach) <
          kTrailStep * m_sweep.field().voxel())
    return;
  m_trail[m_trailEnd] = m_sweep.pose();
  m_trailEnd = (m_trailEnd + 1) % kTrail;
  m_trailLength = std::min(m_trailLength + 1, kTrail);
}

// Goes back along the path to the last pose that is free now, within a tick's budget.
bool PoseBacktracker::retreat() noexcept
{
  while (m_trailLength > 0)
  {
    if (m_sweep.samples() + m_sweep.surfaceSamples() > kMaxRetreat)
      return false;
    const std::size_t last = (m_trailEnd + kTrail - 1) % kTrail;
    if (m_sweep.freeAt(m_trail[last]))
    {
      m_sweep.moveTo(m_trail[last]);
      m_inside = m_retreats = false;
      return true;
    }
    m_trailEnd = last;
    --m_trailLength;
  }
  m_retreats = false;
  return false;
}

bool PoseBacktracker::notice() noexcept
{
  if (m_sweep.state().raises() != m_raises)
  {
    m_raises = m_sweep.state().raises();
    m_sweep.forgetClearances();
    if ((m_inside && !m_retreats) || m_sweep.freeAt(m_sweep.pose()))
    {
      m_inside = m_inside && !m_retreats;
      m_retreats = false;
      return false;
    }
    m_inside = m_retreats = true;
  }
  return m_retreats && retreat();
}

} // namespace petrous::haptics
