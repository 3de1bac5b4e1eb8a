#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Dissection/RemovedVolume.h"

namespace petrous::presenters
{

/// What an open stroke has taken so far, measured again and again in a thread of its own while
/// somebody asks. Costs nothing otherwise. One thread asks.
class RemovedVolumeEstimator
{
public:
  /// What the open stroke of a copy has removed; called in the other thread.
  using Measure = std::function<dissection::RemovedVolume(const dissection::Dissection&)>;

  static constexpr double kEvery = 0.25;  ///< s, between the beginnings of two measurements
  static constexpr double kMaxShare = 4; ///< nor more often than so many times what one takes

  /// As it was at most some tenths of a second ago; nothing while no stroke is open. Never waits.
  const dissection::RemovedVolume& soFar(const dissection::Dissection& work,
                                         const Measure& measure);

private:
  using Clock = std::chrono::steady_clock;
  struct Result
  {
    dissection::RemovedVolume removed;
    double seconds = 0.0; // that it took
  };

  dissection::RemovedVolume m_removed;
  std::uint64_t m_stroke = 0;  // Dissection::changes when it was opened
  std::uint64_t m_pending = 0; // the same, of what is measured now
  Clock::time_point m_next;
  std::future<Result> m_result;
};

} // namespace petrous::presenters
