#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

/// Where a tool can go when tissue comes back round it (undo, another state of the mask): the way
/// that it came, as poses that were free. A tool that has nowhere to go is inside, and follows the
/// hand without contact until it is free.
///
/// Only the constructor allocates; nothing locks or throws. One thread.
class PoseBacktracker
{
public:
  explicit PoseBacktracker(ShellSweep& sweep); ///< which must outlive this

  /// Puts the tool where it is told; the way that it came is forgotten.
  void place(const Pose& pose) noexcept;

  /// Whether no tissue is there, by the mask as it is now.
  bool freeAt(const Pose& pose) noexcept;

  /// Looks at the sweep's present state of the mask. True when tissue came back round the tool and
  /// it went back on its path. What of that a tick's work is not enough for, the next ones do; the
  /// tool is inside until then.
  bool notice() noexcept;

  bool inside() const noexcept { return m_inside; }

  /// Inside: the tool goes where the hand is, and may be free there.
  void follow(const Pose& goal) noexcept;

  /// The tool is free where it is now.
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
  bool m_retreats = false; // inside, and the way back is not looked through yet
};

} // namespace petrous::haptics
