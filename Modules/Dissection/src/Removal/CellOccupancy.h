#pragma once

#include <array>

#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

constexpr int kCellPoints = 4; ///< along an axis, in the middles of equal parts of a cell

/// A value at each point, first axis fastest.
using CellValues = std::array<float, kCellPoints * kCellPoints * kCellPoints>;

/// The point a, b, c of the cell whose lowest corner is the voxel i, j, k, patient mm.
inline Eigen::Vector3d cellPoint(const core::GridGeometry& grid, int i, int j, int k, int a, int b,
                                 int c)
{
  const auto middle = [](int part) { return (part + 0.5) / kCellPoints; };
  return grid.patientFromVoxel({i + middle(a), j + middle(b), k + middle(c)});
}

/// How much of each point's part of a cell is tissue before any cut, 0 to 1: where f is f0 in the
/// middle of a part over which it changes by g, 1/2 + f0/g of it. False where there is none.
/// The voxel must have a neighbour above it on each axis.
bool cellOccupancies(const volume::TissueField& tissue, int i, int j, int k, CellValues& shares);

} // namespace petrous::dissection
