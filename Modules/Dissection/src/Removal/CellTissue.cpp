#include "CellTissue.h"

namespace petrous::dissection
{

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
