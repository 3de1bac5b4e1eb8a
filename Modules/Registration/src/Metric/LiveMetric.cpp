#include "petrous/Registration/LiveMetric.h"

#include <utility>

#include "ImagePair.h"
#include "MutualInformation.h"

namespace petrous::registration
{

namespace
{

constexpr std::size_t kSamples = 20'000;

} // namespace

struct LiveMetric::Parts
{
  bool fixedIsCt;
  FixedSamples samples;
  LevelImage moving;
};

LiveMetric::LiveMetric(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                       const std::optional<core::PatientBox>& region)
{
  ImagePair pair = makePair(ct, mr, region, 1, {});
  const bool fixedIsCt = pair.fixedIsCt;
  FixedSamples samples =
      drawSamples(pair.fixed.finest(), pair.fixed.content.back(), kSamples, 1, kBins);
  m_parts.reset(new Parts{fixedIsCt, std::move(samples), std::move(pair.moving.levels.back())});
}

LiveMetric::~LiveMetric() = default;
LiveMetric::LiveMetric(LiveMetric&&) noexcept = default;
LiveMetric& LiveMetric::operator=(LiveMetric&&) noexcept = default;

double LiveMetric::at(const core::RigidTransform& mrFromCt) const
{
  return MutualInformation(m_parts->samples, m_parts->moving)
      .value(m_parts->fixedIsCt ? mrFromCt : mrFromCt.inverse());
}

std::size_t LiveMetric::bytes() const
{
  return m_parts->moving.voxels.bytes() +
         m_parts->samples.size() * (sizeof(Eigen::Vector3f) + sizeof(std::uint8_t));
}

} // namespace petrous::registration
