#pragma once

#include <array>

#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

constexpr int kCellPoints = 4; ///< per axis, at the centres of equal sub-cells

/// One value per point, first axis fastest.
using CellValues = std::array<float, kCellPoints * kCellPoints * kCellPoints>;

/// Point (a, b, c) of the cell whose lowest corner is voxel (i, j, k), patient mm.
inline Eigen::Vector3d cellPoint(const core::GridGeometry& grid, int i, int j, int k, int a, int b,
                                 int c)
{
  const auto middle = [](int part) { return (part + 0.5) / kCellPoints; };
  return grid.patientFromVoxel({i + middle(a), j + middle(b), k + middle(c)});
}

/// Tissue occupancy of each sub-cell of a cell before any cut, 0 to 1: 1/2 + f0/g, f0 the value of
/// f at the centre of the sub-cell and g its change across it. False if there is no tissue. The
/// voxel needs an upper neighbour on each axis.
bool cellOccupancies(const volume::TissueField& tissue, int i, int j, int k, CellValues& shares);

} // namespace petrous::dissection
