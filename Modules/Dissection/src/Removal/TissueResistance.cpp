#include "petrous/Dissection/TissueResistance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "petrous/Core/Error.h"

namespace petrous::dissection
{

namespace
{

bool positive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

} // namespace

TissueResistance::TissueResistance(std::shared_ptr<const volume::IntensityVolume> ct,
                                   const Ramp& ramp, std::vector<Structure> structures)
  : m_ct(std::move(ct))
  , m_ramp(ramp)
  , m_structures(std::move(structures))
{
  if (!(ramp.low < ramp.high) || !positive(ramp.atLow) || !positive(ramp.atHigh))
    throw core::InvalidParameter("resistance: the ramp of bone must rise in intensity and lie "
                                 "above 0 N/mm2");
  for (std::size_t n = 0; n < m_structures.size(); ++n)
  {
    const Structure& structure = m_structures[n];
    if (!positive(structure.resistance))
      throw core::InvalidParameter("resistance: that of a structure must be above 0 N/mm2");
    auto map = std::find_if(m_maps.begin(), m_maps.end(),
                            [&](const Map& known) { return known.labels == structure.labels; });
    if (map == m_maps.end())
      map = m_maps.insert(map, {structure.labels, {}});
    if (map->order.size() <= structure.index)
      map->order.resize(std::size_t{structure.index} + 1, kNone);
    std::uint32_t& order = map->order[structure.index];
    order = std::min(order, static_cast<std::uint32_t>(n));
  }
}

double TissueResistance::at(const Eigen::Vector3d& patient) const
{
  std::uint32_t first = kNone;
  for (const Map& map : m_maps)
  {
    const auto& voxels = *map.labels->voxels;
    const Eigen::Vector3d v = voxels.geometry().voxelFromPatient(patient);
    const core::Index3 nearest{static_cast<int>(std::floor(v[0] + 0.5)),
                               static_cast<int>(std::floor(v[1] + 0.5)),
                               static_cast<int>(std::floor(v[2] + 0.5))};
    if (!voxels.geometry().fullBox().contains(nearest))
      continue;
    const std::uint16_t value = voxels.at(nearest[0], nearest[1], nearest[2]);
    if (value < map.order.size())
      first = std::min(first, map.order[value]);
  }
  if (first != kNone)
    return m_structures[first].resistance;
  const double hu = m_ct->sample(m_ct->geometry().voxelFromPatient(patient));
  const double share = (hu - m_ramp.low) / (m_ramp.high - m_ramp.low);
  // NaN counts as the densest bone, where the drill is slowest.
  return m_ramp.atLow + (share >= 0.0  ? std::min(share, 1.0)
                         : share < 0.0 ? 0.0
                                       : 1.0) *
                            (m_ramp.atHigh - m_ramp.atLow);
}

} // namespace petrous::dissection
