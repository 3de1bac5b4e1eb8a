#include "Refuge.h"

#include <algorithm>

namespace petrous::haptics
{

namespace
{
constexpr double kTrailStep = 0.5; // voxels
} // namespace

Refuge::Refuge(ShellSweep& sweep)
  : m_sweep(sweep)
  , m_trail(kTrail)
{
}

void Refuge::settle() noexcept
{
  m_sweep.measure();
  m_inside = m_sweep.penetration() > 0.0;
  if (!m_inside)
    remember();
}

void Refuge::place(const Pose& pose) noexcept
{
  const volume::PublishedMask& mask = m_sweep.field().mask();
  m_sweep.look(*mask.acquire());
  m_raises = m_sweep.state().raises();
  m_sweep.moveTo(pose);
  m_trailLength = 0;
  settle();
  mask.release();
}

bool Refuge::freeAt(const Pose& pose) noexcept
{
  const volume::PublishedMask& mask = m_sweep.field().mask();
  m_sweep.look(*mask.acquire());
  const bool free = m_sweep.freeAt(pose);
  mask.release();
  return free;
}

void Refuge::follow(const Pose& goal) noexcept
{
  m_sweep.moveTo(goal);
  settle();
}

void Refuge::remember() noexcept
{
  const std::size_t last = (m_trailEnd + kTrail - 1) % kTrail;
  if (m_trailLength > 0 && longestWay(motionBetween(m_trail[last], m_sweep.pose()),
                                      m_sweep.shell().reach) < kTrailStep * m_sweep.field().voxel())
    return;
  m_trail[m_trailEnd] = m_sweep.pose();
  m_trailEnd = (m_trailEnd + 1) % kTrail;
  m_trailLength = std::min(m_trailLength + 1, kTrail);
}

// Back along the path to the last pose that is free now.
bool Refuge::retreat() noexcept
{
  while (m_trailLength > 0)
  {
    const std::size_t last = (m_trailEnd + kTrail - 1) % kTrail;
    if (m_sweep.freeAt(m_trail[last]))
    {
      m_sweep.moveTo(m_trail[last]);
      return true;
    }
    m_trailEnd = last;
    --m_trailLength;
  }
  return false;
}

bool Refuge::notice() noexcept
{
  if (m_sweep.state().raises() == m_raises)
    return false;
  m_raises = m_sweep.state().raises();
  m_sweep.forgetClearances();
  if (m_inside || m_sweep.freeAt(m_sweep.pose()))
    return false;
  m_inside = !retreat();
  m_sweep.measure();
  return !m_inside;
}

} // namespace petrous::haptics
