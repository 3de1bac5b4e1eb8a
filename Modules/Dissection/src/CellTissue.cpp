#include "CellTissue.h"

namespace petrous::dissection
{

namespace
{

constexpr int kEdge = 32; // cells along an axis that have places of their own

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

bool CellTissue::airAround(int i, int j, int k) const
{
  for (int c = 0; c < 8; ++c)
    if (m_tissue.ct()->at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) > m_tissue.parameters().iso)
      return false;
  const Eigen::Vector3d middle = m_tissue.geometry().patientFromVoxel({i + 0.5, j + 0.5, k + 0.5});
  const double around = m_tissue.geometry().spacing().norm(); // twice what is needed
  for (const auto& solid : m_tissue.solids())
  {
    const core::GridGeometry& grid = solid->geometry();
    const Eigen::Vector3d voxel = grid.voxelFromPatient(middle);
    const double margin = around / grid.minSpacing();
    bool near = true;
    for (int a = 0; a < 3; ++a)
      near = near && voxel[a] > -margin &&
             voxel[a] < grid.dims()[static_cast<std::size_t>(a)] - 1 + margin;
    if (near)
      return false;
  }
  return true;
}

void CellTissue::fill(int i, int j, int k, CellContent& content) const
{
  constexpr int n = CellContent::kPoints;
  content.empty = true;
  if (airAround(i, j, k))
    return;
  const auto middle = [](int part) { return (part + 0.5) / n; };
  std::size_t point = 0;
  for (int c = 0; c < n; ++c)
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a, ++point)
      {
        const Eigen::Vector3d p =
            m_tissue.geometry().patientFromVoxel({i + middle(a), j + middle(b), k + middle(c)});
        const bool solid = m_tissue.uncut(p) > 0.0;
        content.resistance[point] = solid ? static_cast<float>(m_resistance.at(p)) : 0.0F;
        content.empty = content.empty && !solid;
      }
}

} // namespace petrous::dissection
