#include "CellOccupancy.h"

#include <algorithm>
#include <cmath>

namespace petrous::dissection
{

namespace
{

constexpr std::size_t pointOf(int a, int b, int c)
{
  return static_cast<std::size_t>(a + kCellPoints * (b + kCellPoints * c));
}

// Difference of the field across one sub-cell along an axis; one-sided at the ends.
float slopeAt(const CellValues& field, const std::array<int, 3>& part, std::size_t axis)
{
  auto low = part, high = part;
  low[axis] = std::max(part[axis] - 1, 0);
  high[axis] = std::min(part[axis] + 1, kCellPoints - 1);
  return (field[pointOf(high[0], high[1], high[2])] - field[pointOf(low[0], low[1], low[2])]) /
         static_cast<float>(high[axis] - low[axis]);
}

bool mayHoldStructures(const volume::TissueField& tissue, int i, int j, int k)
{
  const Eigen::Vector3d middle = tissue.geometry().patientFromVoxel({i + 0.5, j + 0.5, k + 0.5});
  const double around = tissue.geometry().spacing().norm(); // twice what is needed
  for (const auto& solid : tissue.solids())
  {
    const core::GridGeometry& grid = solid->geometry();
    const Eigen::Vector3d voxel = grid.voxelFromPatient(middle);
    const double margin = around / grid.minSpacing();
    bool near = true;
    for (int a = 0; a < 3; ++a)
      near = near && voxel[a] > -margin &&
             voxel[a] < grid.dims()[static_cast<std::size_t>(a)] - 1 + margin;
    if (near)
      return true;
  }
  return false;
}

} // namespace

bool cellOccupancies(const volume::TissueField& tissue, int i, int j, int k, CellValues& shares)
{
  double least = tissue.ct()->at(i, j, k);
  double most = least;
  for (int corner = 1; corner < 8; ++corner)
  {
    const double value =
        tissue.ct()->at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const double iso = tissue.parameters().iso;
  if (most <= iso && !mayHoldStructures(tissue, i, j, k))
    return false;
  // The surface is farther than one sub-cell everywhere; false for NaN.
  if (least - iso > most - least)
  {
    shares.fill(1.0F);
    return true;
  }
  CellValues field;
  for (int c = 0; c < kCellPoints; ++c)
    for (int b = 0; b < kCellPoints; ++b)
      for (int a = 0; a < kCellPoints; ++a)
        field[pointOf(a, b, c)] =
            static_cast<float>(tissue.uncut(cellPoint(tissue.geometry(), i, j, k, a, b, c)));
  bool any = false;
  for (int c = 0; c < kCellPoints; ++c)
    for (int b = 0; b < kCellPoints; ++b)
      for (int a = 0; a < kCellPoints; ++a)
      {
        const float f = field[pointOf(a, b, c)];
        float square = 0.0F;
        for (std::size_t axis = 0; axis < 3; ++axis)
          square += std::pow(slopeAt(field, {a, b, c}, axis), 2.0F);
        const float g = std::sqrt(square);
        const float share = 2.0F * std::abs(f) < g ? 0.5F + f / g : (f > 0.0F ? 1.0F : 0.0F);
        shares[pointOf(a, b, c)] = share;
        any = any || share > 0.0F;
      }
  return any;
}

} // namespace petrous::dissection
