#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

/// Resolves tissue restored around a tool (undo, another mask state): the tool goes back along its
/// path, which is stored as poses that were free. A tool without a free pose is inside and follows
/// the device without contact until it is free.
///
/// Only the constructor allocates; nothing locks or throws. Not thread-safe.
class PoseBacktracker
{
public:
  explicit PoseBacktracker(ShellSweep& sweep); ///< must outlive this

  /// Places the tool at `pose`; clears its path.
  void place(const Pose& pose) noexcept;

  /// Whether the tool would be free of tissue in the current mask state.
  bool freeAt(const Pose& pose) noexcept;

  /// Processes the sweep's mask state. True if tissue was restored around the tool and it went back
  /// along its path. Work beyond a tick's budget continues in the next ticks; the tool is inside
  /// until then.
  bool notice() noexcept;

  bool inside() const noexcept { return m_inside; }

  /// If inside: moves the tool to the goal, where it may be free.
  void follow(const Pose& goal) noexcept;

  /// Stores the present pose, which is free.
  void remember() noexcept;

private:
  static constexpr std::size_t kTrail = 512;

  void settle(std::size_t most) noexcept;
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
