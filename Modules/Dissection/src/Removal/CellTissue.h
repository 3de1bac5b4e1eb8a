#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "petrous/Dissection/TissueResistance.h"
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

/// Contents of a cell between eight voxel centres, before any cut.
struct CellContent
{
  std::int64_t cell = -1;
  std::uint64_t asked = 0; ///< last search that used it
  // Result of the last evaluation, cached.
  std::array<std::uint16_t, 8> corners{}; ///< of the mask
  float work = 0.0F;
  float volume = 0.0F;
  bool reckoned = false;
  bool empty = true;
  alignas(16) CellValues occupancy{};  ///< tissue occupancy of each sub-cell, 0 to 1
  alignas(16) CellValues resistance{}; ///< N/mm^2; 0 where there is no tissue
};

/// Lazily computed cache of cell contents: a table in which neighbouring cells have distinct slots.
class CellTissue
{
public:
  /// Both must outlive this; `tissue` is evaluated before any mask.
  CellTissue(const volume::TissueField& tissue, const TissueResistance& resistance);

  /// Begins a search: references returned by `at` are valid until the next one.
  void begin();

  /// The cell whose lowest corner is the voxel (i, j, k); that voxel needs an upper neighbour on
  /// each axis.
  CellContent& at(int i, int j, int k);

private:
  void fill(int i, int j, int k, CellContent& content) const;

  const volume::TissueField& m_tissue;
  const TissueResistance& m_resistance;
  std::vector<CellContent> m_table;
  std::deque<CellContent> m_besides; // whose slots are in use by the current search
  std::uint64_t m_search = 0;
};

} // namespace petrous::dissection
