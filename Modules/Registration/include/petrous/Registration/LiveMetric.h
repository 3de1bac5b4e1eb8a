#pragma once

#include <memory>
#include <optional>

#include "petrous/Registration/Fit.h"

namespace petrous::registration
{

/// The metric at any pose, fast enough for interactive use (a slider): set up once per image pair.
///
/// Immutable and thread-safe. Owns `bytes` of memory; the images may be released.
class LiveMetric
{
public:
  /// Throws InvalidParameter like fitRigid.
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
