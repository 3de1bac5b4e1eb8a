#pragma once

#include <algorithm>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// The range of stored values that a slice declares as padding: [low, high].
template <class Stored>
struct PaddingRange
{
  Stored low = 1;
  Stored high = 0;

  explicit PaddingRange(const SliceHeader& slice, bool wanted)
  {
    if (!wanted || !slice.padding)
      return;
    const auto value = static_cast<Stored>(*slice.padding);
    const auto limit = static_cast<Stored>(slice.paddingRangeLimit.value_or(*slice.padding));
    low = std::min(value, limit);
    high = std::max(value, limit);
  }
  bool empty() const { return low > high; }
  bool contains(Stored stored) const { return stored >= low && stored <= high; }
};

} // namespace petrous::imaging
