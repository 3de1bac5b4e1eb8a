#pragma once

#include <future>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"

namespace petrous::rendering
{

/// Signed distance to an instrument's surface, negative inside, sampled around its front part in
/// its own frame: the tip at the origin, +z to the hand, mm. Of a surface that is not closed the
/// distance is positive everywhere.
struct InstrumentDistance
{
  static constexpr double kPart = 60.0;   ///< mm from the tip; what is farther back is not in it
  static constexpr double kMargin = 3.0;  ///< mm, around
  static constexpr double kFinest = 0.25; ///< mm, between samples
  static constexpr double kMostSamples = 1 << 18;

  Eigen::Vector3d lower{0.0, 0.0, 0.0}; ///< the first sample
  double edge = kFinest;                ///< mm from sample to sample
  core::Index3 dims{0, 0, 0};           ///< 0: nothing there
  std::vector<float> distances;         ///< mm, first axis fastest

  /// Throws InvalidParameter for vertices that do not exist or are not finite, CancelledError.
  static InstrumentDistance of(const core::TriangleMesh& instrument,
                               const core::Progress& progress = {});

  Eigen::Vector3d upper() const ///< the last sample
  {
    return lower + edge * Eigen::Vector3d(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0);
  }
};

/// InstrumentDistance::of in the background. The destructor cancels it, and waits for its next
/// check.
class InstrumentMeasurement
{
public:
  explicit InstrumentMeasurement(std::shared_ptr<const core::TriangleMesh> instrument);
  ~InstrumentMeasurement();
  InstrumentMeasurement(const InstrumentMeasurement&) = delete;
  InstrumentMeasurement& operator=(const InstrumentMeasurement&) = delete;

  const std::shared_ptr<const core::TriangleMesh>& instrument() const noexcept
  {
    return m_instrument;
  }
  bool isDone() const;

  /// Waits for it. Throws what `of` throws, each time.
  const InstrumentDistance& result() const { return m_result.get(); }

private:
  std::shared_ptr<const core::TriangleMesh> m_instrument;
  std::shared_ptr<core::CancelToken> m_token = std::make_shared<core::CancelToken>();
  std::shared_future<InstrumentDistance> m_result;
};

} // namespace petrous::rendering
