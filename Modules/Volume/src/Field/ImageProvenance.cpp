#include "petrous/Volume/ImageProvenance.h"

#include <algorithm>

namespace petrous::volume
{

bool contains(const std::vector<SliceRange>& ranges, int slice) noexcept
{
  return std::any_of(ranges.begin(), ranges.end(),
                     [slice](const SliceRange& range)
                     { return range.first <= slice && slice <= range.last; });
}

int sliceCount(const std::vector<SliceRange>& ranges) noexcept
{
  int count = 0;
  for (const SliceRange& range : ranges)
    count += range.last - range.first + 1;
  return count;
}

std::string toString(const std::vector<SliceRange>& ranges, std::size_t most)
{
  std::string text;
  const std::size_t named = most == 0 ? ranges.size() : std::min(most, ranges.size());
  const auto after = ranges.begin() + static_cast<std::ptrdiff_t>(named);
  for (auto range = ranges.begin(); range != after; ++range)
    text += (text.empty() ? "" : ", ") + std::to_string(range->first + 1) +
            (range->last > range->first ? "-" + std::to_string(range->last + 1) : "");
  const int others = sliceCount({after, ranges.end()});
  return others == 0
             ? text
             : text + " and " + std::to_string(others) + (others == 1 ? " other" : " others");
}

} // namespace petrous::volume
