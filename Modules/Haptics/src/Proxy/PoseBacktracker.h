#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "petrous/Haptics/ProxyTick.h"
#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

/// What the ticks of all proxies have in common: the mask state that a tick uses, and the tool's
/// way out of tissue.
///
/// Resolves tissue restored around a tool (undo, another mask state): the tool goes back along its
/// path, which is stored as poses that were free. A tool without a free pose is inside and follows
/// the device without contact until it is free.
///
/// Only the constructor allocates; nothing locks or throws. Not thread-safe.
class PoseBacktracker
{
public:
  explicit PoseBacktracker(ShellSweep& sweep); ///< must outlive this

  /// Places the tool at `pose`; clears its path. False, and nothing done, if `pose` is not finite.
  bool place(const Pose& pose) noexcept;

  /// Whether the tool would be free of tissue in the current mask state.
  bool freeAt(const Pose& pose) noexcept;

  /// One tick: clears `tick`, except for the pose, and calls act(free) while the sweep looks at the
  /// current mask state. `free`: the tool was free of tissue when the tick began; otherwise it has
  /// been moved to the goal, where it may be free. Not called if the goal is not finite.
  template <class Act>
  void tick(const Pose& goal, ProxyTick& tick, const Act& act) noexcept
  {
    clear(tick);
    if (!goal.finite())
    {
      tick.status = ProxyStatus::BadGoal;
      return;
    }
    const volume::PublishedMask& mask = m_sweep.field().mask();
    m_sweep.look(*mask.acquire());
    tick.maskState = m_sweep.state().number();
    if (notice())
      tick.status = ProxyStatus::Retreated;
    const bool free = !m_inside;
    if (!free)
    {
      follow(goal);
      tick.status = m_inside ? ProxyStatus::Inside : ProxyStatus::Free;
    }
    act(free);
    mask.release();
  }

  /// Stores the present pose, which is free.
  void remember() noexcept;

private:
  static constexpr std::size_t kTrail = 512;

  static void clear(ProxyTick& tick) noexcept;
  void settle(std::size_t most) noexcept;

  /// Processes the sweep's mask state. True if tissue was restored around the tool and it went back
  /// along its path. Work beyond a tick's budget continues in the next ticks; the tool is inside
  /// until then.
  bool notice() noexcept;

  /// If inside: moves the tool to the goal, where it may be free.
  void follow(const Pose& goal) noexcept;

  bool retreat() noexcept;

  ShellSweep& m_sweep;
  std::vector<Pose> m_trail; // ring of poses that were free
  std::size_t m_trailEnd = 0;
  std::size_t m_trailLength = 0;
  std::uint64_t m_raises = 0;
  bool m_inside = false;
  bool m_retreats = false; // inside, and the path back is not fully searched yet
};

} // namespace petrous::haptics
