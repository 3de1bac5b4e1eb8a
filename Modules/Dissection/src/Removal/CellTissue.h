#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "CellOccupancy.h"
#include "petrous/Dissection/TissueResistance.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// What lies in a cell between eight voxel centres before any cut.
struct CellContent
{
  std::int64_t cell = -1;
  std::uint64_t asked = 0; ///< by which search last
  // What was reckoned of it last, kept for whoever asks the same again.
  std::array<std::uint16_t, 8> corners{}; ///< of the mask
  float work = 0.0F;
  float volume = 0.0F;
  bool reckoned = false;
  bool empty = true;
  alignas(16) CellValues occupancy{};      ///< of a point's part that is tissue, 0 to 1
  alignas(16) CellValues resistance{}; ///< N/mm^2; 0 where there is no tissue
};

/// The cells' contents, made when first asked for and kept where there is room: a table in which
/// cells near each other have places of their own.
class CellTissue
{
public:
  /// Both must outlive this; `tissue` is asked for f before any mask.
  CellTissue(const volume::TissueField& tissue, const TissueResistance& resistance);

  /// A search begins: what it is given holds until the next one begins.
  void begin();

  /// Of the cell whose lowest corner is the voxel (i, j, k), which has a neighbour above it on each
  /// axis.
  CellContent& at(int i, int j, int k);

private:
  void fill(int i, int j, int k, CellContent& content) const;

  const volume::TissueField& m_tissue;
  const TissueResistance& m_resistance;
  std::vector<CellContent> m_table;
  std::deque<CellContent> m_besides; // whose places in the table are taken by the same search
  std::uint64_t m_search = 0;
};

} // namespace petrous::dissection
