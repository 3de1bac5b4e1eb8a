#pragma once

#include <memory>
#include <optional>

#include "petrous/Registration/Fit.h"

namespace petrous::registration
{

/// The metric at any pose, fast enough to follow a slider: made once for a pair of images.
///
/// Immutable and thread-safe. Holds `bytes` of its own; the images may go.
class LiveMetric
{
public:
  /// Throws InvalidParameter as fitRigid does.
  LiveMetric(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
             const std::optional<core::PatientBox>& region = std::nullopt);
  ~LiveMetric();
  LiveMetric(LiveMetric&&) noexcept;
  LiveMetric& operator=(LiveMetric&&) noexcept;

  double at(const core::RigidTransform& mrFromCt) const; ///< mutual information, nats
  std::size_t bytes() const;

private:
  struct Parts;
  std::unique_ptr<const Parts> m_parts;
};

} // namespace petrous::registration
