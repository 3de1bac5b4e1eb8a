#include "CellTissue.h"

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

namespace
{

constexpr int kEdge = 32; // edge of the block of cells with distinct slots in the table

std::size_t placeOf(int i, int j, int k)
{
  return static_cast<std::size_t>((i % kEdge) + kEdge * ((j % kEdge) + kEdge * (k % kEdge)));
}

} // namespace

CellTissue::CellTissue(const volume::TissueField& tissue, const TissueResistance& resistance)
  : m_tissue(tissue)
  , m_resistance(resistance)
  , m_table(std::size_t{kEdge} * kEdge * kEdge)
{
}

void CellTissue::begin()
{
  ++m_search;
  m_besides.clear();
}

CellContent& CellTissue::at(int i, int j, int k)
{
  const auto cell = static_cast<std::int64_t>(m_tissue.geometry().linearIndex(i, j, k));
  CellContent* content = &m_table[placeOf(i, j, k)];
  if (content->cell != cell && content->asked == m_search)
    content = &m_besides.emplace_back();
  if (content->cell != cell)
  {
    fill(i, j, k, *content);
    content->cell = cell;
    content->reckoned = false;
  }
  content->asked = m_search;
  return *content;
}

void CellTissue::fill(int i, int j, int k, CellContent& content) const
{
  content.empty = !cellOccupancies(m_tissue, i, j, k, content.occupancy);
  if (content.empty)
    return;
  std::size_t point = 0;
  for (int c = 0; c < kCellPoints; ++c)
    for (int b = 0; b < kCellPoints; ++b)
      for (int a = 0; a < kCellPoints; ++a, ++point)
        content.resistance[point] = content.occupancy[point] > 0.0F
                                        ? static_cast<float>(m_resistance.at(
                                              cellPoint(m_tissue.geometry(), i, j, k, a, b, c)))
                                        : 0.0F;
}

} // namespace petrous::dissection
