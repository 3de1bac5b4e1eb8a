#include "RemovalStencil.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "Protection.h"

namespace petrous::dissection
{

using volume::CutMask;

namespace
{

constexpr int kGone = 8; // consecutive empty voxels that are worth skipping
constexpr std::size_t kFewCells = 200;

} // namespace

RemovalStencil::RemovalStencil(const volume::TissueField& tissue,
                               const TissueResistance& resistance, ProtectedTissue keep)
  : m_grid(tissue.geometry())
  , m_keep(std::move(keep))
  , m_tissue(tissue, resistance)
  , m_sums(m_grid)
{
}

void RemovalStencil::load(const CutMask& mask, const core::IndexBox& box)
{
  constexpr int edge = CutMask::kBrickEdge;
  m_box = box;
  m_dims = box.size();
  m_now.resize(box.count());
  std::uint16_t* to = m_now.data();
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0];)
      {
        const int end = std::min((i / edge + 1) * edge, box.upper[0]);
        const auto count = static_cast<std::size_t>(end - i);
        const auto& brick = mask.brick(mask.brickIndex({i / edge, j / edge, k / edge}));
        if (brick)
          std::memcpy(to, brick->data() + (i % edge) + edge * ((j % edge) + edge * (k % edge)),
                      count * sizeof *to);
        else
          std::fill_n(to, count, CutMask::kUntouched);
        to += count;
        i = end;
      }
}

bool RemovalStencil::gather(const CutMask& mask, const SweptSphere& way)
{
  const BurrCoverage burr(way, m_grid, true);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(burr.reach());
  core::IndexBox box =
      m_grid.boxCovering(way.from.cwiseMin(way.to) - margin, way.from.cwiseMax(way.to) + margin);
  if (box.empty())
    return false;
  prepare(m_keep, way, burr.reach(), m_grid);
  // One more voxel on each side, so that every cell of a changed voxel is included.
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = std::max(box.lower[a] - 1, 0);
    box.upper[a] = std::min(box.upper[a] + 1, m_grid.dims()[a]);
  }
  load(mask, box);
  m_after = m_now;
  m_reckoned = false;
  m_voxels.clear();
  m_x.clear();
  m_y.clear();
  m_z.clear();
  m_least.clear();
  m_row.resize(static_cast<std::size_t>(m_dims[0]));

  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      if (const auto span = burr.span(j, k, box.lower[0], box.upper[0]); span.begin < span.end)
        gatherRow(burr, span.begin, j, k, span.end - span.begin);
  gatherCells();
  return !m_cells.empty();
}

void RemovalStencil::gatherRow(const BurrCoverage& burr, int first, int j, int k, int count)
{
  const std::size_t start =
      static_cast<std::size_t>(first - m_box.lower[0]) +
      static_cast<std::size_t>(m_dims[0]) *
          (static_cast<std::size_t>(j - m_box.lower[1]) +
           static_cast<std::size_t>(m_dims[1]) * static_cast<std::size_t>(k - m_box.lower[2]));
  const std::uint16_t* now = &m_now[start];
  // Within the burr's own cavity most voxels are already removed.
  for (int begin = 0; begin < count;)
  {
    int end = begin;
    for (int n = begin; n < count && n - end < kGone; ++n)
      if (now[n] != 0)
        end = n + 1;
    if (end > begin)
      gatherRun(burr, first + begin, j, k, end - begin, start + static_cast<std::size_t>(begin));
    begin = end + 1; // voxel `end` is empty, or past the last one
    while (begin < count && now[begin] == 0)
      ++begin;
  }
}

void RemovalStencil::gatherRun(const BurrCoverage& burr, int first, int j, int k, int count,
                               std::size_t start)
{
  const std::uint16_t* now = &m_now[start];
  burr.row(first, j, k, count, m_row.data());
  const Eigen::Vector3d& h = m_grid.spacing();
  for (int n = 0; n < count; ++n)
  {
    const std::uint16_t left = m_row[static_cast<std::size_t>(n)];
    if (left >= now[n])
      continue;
    const std::size_t at = start + static_cast<std::size_t>(n);
    m_after[at] = left;
    m_voxels.push_back(static_cast<std::uint32_t>(at));
    m_x.push_back(h[0] * (first + n));
    m_y.push_back(h[1] * j);
    m_z.push_back(h[2] * k);
    if (!m_keep.empty())
      m_least.push_back(
          leastLeft(m_keep, m_grid.patientFromVoxel({1.0 * (first + n), 1.0 * j, 1.0 * k})));
  }
}

RemovalStencil::Corners RemovalStencil::cornersOf(const std::vector<std::uint16_t>& values,
                                                  std::uint32_t corner) const noexcept
{
  const auto row = static_cast<std::size_t>(m_dims[0]);
  const std::size_t slice = row * static_cast<std::size_t>(m_dims[1]);
  const std::uint16_t* v = values.data() + corner;
  return {v[0],     v[1],         v[row],         v[row + 1],
          v[slice], v[slice + 1], v[slice + row], v[slice + row + 1]};
}

// Cells with such a voxel as a corner in which the mask leaves its saturated ranges.
void RemovalStencil::gatherCells()
{
  const auto row = static_cast<std::size_t>(m_dims[0]);
  const std::size_t slice = row * static_cast<std::size_t>(m_dims[1]);
  m_marked.assign(m_now.size(), 0);
  m_left.resize(m_voxels.size());
  // At the grid border a mark may fall on the last column of the previous row, which has no cell.
  for (const std::size_t voxel : m_voxels)
    for (const std::size_t down : {std::size_t{0}, row, slice, slice + row})
    {
      if (voxel >= down)
        m_marked[voxel - down] = 1;
      if (voxel > down)
        m_marked[voxel - down - 1] = 1;
    }
  m_tissue.begin();
  m_cells.clear();
  for (int z = 0; z + 1 < m_dims[2]; ++z)
    for (int y = 0; y + 1 < m_dims[1]; ++y)
    {
      const std::size_t start =
          row * static_cast<std::size_t>(y) + slice * static_cast<std::size_t>(z);
      const auto begin = m_marked.begin() + static_cast<std::ptrdiff_t>(start);
      const auto end = begin + static_cast<std::ptrdiff_t>(row) - 1;
      for (auto mark = std::find(begin, end, 1); mark != end; mark = std::find(mark + 1, end, 1))
      {
        const auto x = static_cast<int>(mark - begin);
        addCell(x, y, z, static_cast<std::uint32_t>(start) + static_cast<std::uint32_t>(x));
      }
    }
}

void RemovalStencil::addCell(int x, int y, int z, std::uint32_t corner)
{
  const Corners now = cornersOf(m_now, corner);
  if (*std::max_element(now.begin(), now.end()) <= m_sums.low())
    return; // already empty
  const Corners least = cornersOf(m_after, corner);
  if (*std::min_element(least.begin(), least.end()) >= m_sums.high())
    return; // nothing is removed
  CellContent& content = m_tissue.at(m_box.lower[0] + x, m_box.lower[1] + y, m_box.lower[2] + z);
  if (!content.empty)
    m_cells.push_back({corner, &content, m_sums.known(now, content), {}});
}

void RemovalStencil::lower(const Eigen::Vector3d& place, double radius)
{
  const BurrCoverage burr({place, place, radius}, m_grid);
  const std::size_t count = m_voxels.size();
  burr.list(m_x.data(), m_y.data(), m_z.data(), count, m_left.data());
  for (std::size_t n = 0; n < m_least.size(); ++n)
    m_left[n] = std::max(m_left[n], m_least[n]);
  for (std::size_t n = 0; n < count; ++n)
    m_after[m_voxels[n]] = std::min(m_left[n], m_now[m_voxels[n]]);
}

double RemovalStencil::work(const Eigen::Vector3d& place, double radius)
{
  // The accepted step is usually the last one tried.
  if (m_reckoned && place == m_place && radius == m_radius)
    return m_work;
  lower(place, radius);
  double sum = 0.0;
  for (Cell& cell : m_cells)
  {
    const Corners corners = cornersOf(m_after, cell.corner);
    cell.after = corners == cornersOf(m_now, cell.corner) ? cell.before
                                                          : m_sums.solid(corners, *cell.content);
    sum += static_cast<double>(cell.before.work - cell.after.work);
  }
  m_reckoned = true;
  m_place = place;
  m_radius = radius;
  m_work = sum * m_sums.partVolume();
  return m_work;
}

// For a patch of few cells the directions of its points are used; otherwise the cell centres.
void RemovalStencil::addToPatch(const Cell& cell, const Eigen::Vector3d& center, bool fine)
{
  const auto row = static_cast<std::uint32_t>(m_dims[0]);
  const std::uint32_t slice = row * static_cast<std::uint32_t>(m_dims[1]);
  const Eigen::Vector3d& h = m_grid.spacing();
  const Eigen::Vector3d corner(m_box.lower[0] + cell.corner % row,
                               m_box.lower[1] + cell.corner / row % m_dims[1],
                               m_box.lower[2] + cell.corner / slice);
  const Eigen::Vector3d offset = h.cwiseProduct(corner) - center;
  if (!fine)
  {
    m_patch.add(offset + 0.5 * h, static_cast<double>(cell.before.volume - cell.after.volume));
    return;
  }
  CellValues before, after;
  m_sums.left(cornersOf(m_now, cell.corner), cell.content->occupancy, before);
  m_sums.left(cornersOf(m_after, cell.corner), cell.content->occupancy, after);
  std::size_t point = 0;
  for (int c = 0; c < kCellPoints; ++c)
    for (int b = 0; b < kCellPoints; ++b)
      for (int a = 0; a < kCellPoints; ++a, ++point)
        if (const float gone = before[point] - after[point]; gone != 0.0F)
          m_patch.add(offset +
                          h.cwiseProduct(Eigen::Vector3d(a + 0.5, b + 0.5, c + 0.5)) / kCellPoints,
                      static_cast<double>(gone));
}

RemovalStencil::Taken RemovalStencil::taken(const Eigen::Vector3d& place, double radius,
                                            const Eigen::Vector3d& spindle)
{
  Taken taken;
  taken.work = work(place, radius);
  m_bitten.clear();
  for (std::size_t n = 0; n < m_cells.size(); ++n)
  {
    const Cell& cell = m_cells[n];
    QuadratureSums::keep(cornersOf(m_after, cell.corner), cell.after, *cell.content);
    const auto volume = static_cast<double>(cell.before.volume - cell.after.volume);
    taken.volume += volume;
    if (volume != 0.0)
      m_bitten.push_back(static_cast<std::uint32_t>(n));
  }
  taken.volume *= m_sums.partVolume();
  m_patch.clear();
  const Eigen::Vector3d center = m_grid.spacing().cwiseProduct(m_grid.voxelFromPatient(place));
  for (const std::uint32_t n : m_bitten)
    addToPatch(m_cells[n], center, m_bitten.size() <= kFewCells);
  taken.patch = m_patch.patch(radius, m_grid.direction().transpose() * spindle);
  taken.patch.middle = m_grid.direction() * taken.patch.middle;
  return taken;
}

} // namespace petrous::dissection
