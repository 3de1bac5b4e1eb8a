#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace petrous::volume
{

/// Bytes of a block of cells, first axis fastest; rows are padded so that a plane is one line of
/// whole vector registers.
struct DistanceBlock
{
  core::IndexBox box;
  std::size_t rowStride = 0;
  std::vector<std::uint8_t> bytes;

  const std::uint8_t* row(int j, int k) const noexcept ///< at the box's first cell
  {
    return &bytes[rowStride * (static_cast<std::size_t>(j - box.lower[1]) +
                               static_cast<std::size_t>(box.upper[1] - box.lower[1]) *
                                   static_cast<std::size_t>(k - box.lower[2]))];
  }
};

/// For every cell of `box` the Chebyshev distance in cells to the nearest marked cell of the grid,
/// at most `cap`. A cell is marked where cells[i * stride] & bit; the grid's border is no obstacle
/// and no mark. Exact: L-infinity separates into one pass an axis,
///
///   d(x, y, z) = min_c max(|c|, min_b max(|b|, d_x(x, y + b, z + c)))
///
/// and with a cap each pass looks at cap - 1 neighbours to both sides, many cells at a time.
DistanceBlock chebyshevDistances(const std::uint8_t* cells, std::size_t stride, std::uint8_t bit,
                                 const core::Index3& dims, const core::IndexBox& box, int cap);

} // namespace petrous::volume
