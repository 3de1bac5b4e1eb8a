#pragma once

#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "petrous/Volume/CutMask.h"

namespace petrous::simulation
{

/// Takes the mask's changes from the thread that cuts to the thread that draws: the latest version
/// of each brick that changed since the last take. Thread-safe.
class MaskChanges
{
public:
  /// The given bricks of `mask` are new.
  void add(const volume::CutMask& mask, const std::vector<std::size_t>& bricks)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (const std::size_t brick : bricks)
      m_bricks[brick] = mask.brick(brick);
  }

  std::map<std::size_t, volume::CutMask::BrickVersion> take()
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return std::exchange(m_bricks, {});
  }

private:
  std::mutex m_mutex;
  std::map<std::size_t, volume::CutMask::BrickVersion> m_bricks;
};

} // namespace petrous::simulation
