#pragma once

#include <cstddef>

#include "petrous/Volume/CutMask.h"

namespace petrous::volume
{

/// Number of voxels that differ between two masks on one grid.
inline std::size_t differentVoxels(const CutMask& a, const CutMask& b)
{
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.brickCount(); ++n)
  {
    if (a.brick(n) == b.brick(n))
      continue;
    const core::IndexBox box = a.brickBox(n);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
          count += a.at(i, j, k) != b.at(i, j, k);
  }
  return count;
}

} // namespace petrous::volume
