#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Dissection/RemovedVolume.h"

namespace petrous::session
{

/// What an open stroke has removed so far, measured repeatedly in a separate thread while it is
/// polled; idle otherwise. Call from one thread.
class RemovedVolumeEstimator
{
public:
  /// What the open stroke of a copy has removed; called in the other thread.
  using Measure = std::function<dissection::RemovedVolume(const dissection::Dissection&)>;

  static constexpr double kEvery = 0.25; ///< s, minimum between starts of two measurements
  static constexpr double kMaxShare = 4; ///< minimum interval in durations of a measurement

  /// At most some tenths of a second old; empty while no stroke is open. Never blocks.
  const dissection::RemovedVolume& soFar(const dissection::Dissection& work,
                                         const Measure& measure);

private:
  using Clock = std::chrono::steady_clock;
  struct Result
  {
    dissection::RemovedVolume removed;
    double seconds = 0.0; // duration of the measurement
  };

  dissection::RemovedVolume m_removed;
  std::uint64_t m_stroke = 0;  // Dissection::changes when it was opened
  std::uint64_t m_pending = 0; // the same, of the running measurement
  Clock::time_point m_next;
  std::future<Result> m_result;
};

} // namespace petrous::session
