#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace petrous::volume
{

/// One byte per cell of a block, first axis fastest; rows are padded so that a plane is a whole
/// number of vector registers.
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

/// Chebyshev distance in cells of every cell of `box` to the nearest marked cell of the grid,
/// capped at `cap`. A cell is marked if cells[i * stride] & bit; cells beyond the grid are
/// unmarked. Exact: L-infinity separates into one pass per axis,
///
///   d(x, y, z) = min_c max(|c|, min_b max(|b|, d_x(x, y + b, z + c)))
///
/// and with a cap each pass reads cap - 1 neighbours on both sides, many cells at a time.
DistanceBlock chebyshevDistances(const std::uint8_t* cells, std::size_t stride, std::uint8_t bit,
                                 const core::Index3& dims, const core::IndexBox& box, int cap);

} // namespace petrous::volume
