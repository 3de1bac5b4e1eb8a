#include "petrous/Volume/IntensityVolume.h"

#include <cmath>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "petrous/Volume/Sampling.h"

namespace petrous::volume
{

IntensityVolume::IntensityVolume(Voxels voxels, std::optional<double> padding)
  : m_voxels(std::move(voxels))
  , m_padding(padding)
{
  if (std::visit([](const auto& pointer) { return pointer == nullptr; }, m_voxels))
    throw core::InvalidParameter("intensity volume: no voxels given");
}

const core::GridGeometry& IntensityVolume::geometry() const noexcept
{
  return visit([](const auto& v) -> const core::GridGeometry& { return v.geometry(); });
}

std::size_t IntensityVolume::bytes() const noexcept
{
  return visit([](const auto& v) { return v.bytes(); });
}

ValueRange IntensityVolume::range() const
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const ValueRange nothing{kInfinity, -kInfinity};
  const ValueRange found = visit(
      [&](const auto& v)
      {
        const auto* data = v.data();
        const double padding = m_padding.value_or(std::numeric_limits<double>::quiet_NaN());
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, v.size(), 1 << 18), nothing,
            [&](const tbb::blocked_range<std::size_t>& part, ValueRange sofar)
            {
              for (std::size_t i = part.begin(); i != part.end(); ++i)
              {
                const auto value = static_cast<double>(data[i]);
                if (value == padding || !std::isfinite(value))
                  continue;
                sofar.min = std::min(sofar.min, value);
                sofar.max = std::max(sofar.max, value);
              }
              return sofar;
            },
            [](const ValueRange& a, const ValueRange& b) {
              return ValueRange{std::min(a.min, b.min), std::max(a.max, b.max)};
            });
      });
  return found.min <= found.max ? found : ValueRange{};
}

double IntensityVolume::at(int i, int j, int k) const
{
  return visit([&](const auto& v) { return static_cast<double>(v.at(i, j, k)); });
}

double IntensityVolume::sample(const Eigen::Vector3d& voxel) const
{
  return visit([&](const auto& v) { return sampleTrilinear(v, voxel); });
}

} // namespace petrous::volume
