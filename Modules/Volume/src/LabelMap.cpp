#include "petrous/Volume/LabelMap.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace petrous::volume
{

LabelMap makeLabelMap(std::shared_ptr<const Volume<std::uint16_t>> voxels,
                      std::vector<Segment> names)
{
  if (!voxels)
    throw core::InvalidParameter("label map: no voxels given");
  const auto byIndex = [](const Segment& a, const Segment& b) { return a.index < b.index; };
  std::sort(names.begin(), names.end(), byIndex);
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    if (names[n].index == 0)
      throw core::InvalidParameter("label map: segment '" + names[n].name +
                                   "' has index 0, which means nothing");
    if (n > 0 && names[n].index == names[n - 1].index)
      throw core::InvalidParameter("label map: segments '" + names[n - 1].name + "' and '" +
                                   names[n].name + "' share index " +
                                   std::to_string(names[n].index));
  }

  std::vector<std::uint64_t> count(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1);
  const std::uint16_t* data = voxels->data();
  for (std::size_t i = 0; i < voxels->size(); ++i)
    ++count[data[i]];

  for (Segment& segment : names)
  {
    segment.voxels = count[segment.index];
    count[segment.index] = 0;
  }
  for (std::size_t index = 1; index < count.size(); ++index)
    if (count[index] > 0)
    {
      Segment segment;
      segment.name = "label " + std::to_string(index);
      segment.index = static_cast<std::uint16_t>(index);
      segment.voxels = count[index];
      names.push_back(std::move(segment));
    }
  std::sort(names.begin(), names.end(), byIndex);
  return {std::move(voxels), std::move(names)};
}

} // namespace petrous::volume
