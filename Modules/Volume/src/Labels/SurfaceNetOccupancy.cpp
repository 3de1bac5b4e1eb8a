#include "SurfaceNet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "LabelOccupancy.h"

namespace petrous::volume
{

namespace
{

constexpr float kReach = 1.9F;     // voxels, radius within which a point counts
constexpr int kSpan = 2;           // cells within that radius
constexpr float kMin = 0.05F;      // minimum |distance| of any voxel, voxels
constexpr float kThinDepth = 0.3F; // voxels that touch others by an edge or a corner

// Depth outside of a voxel next to such voxels, as a fraction of the sum of their depths (of the
// numerator of the trilinear value at the centre of a triangle). At most half of what would
// separate them.
constexpr float kAcrossFace = 0.25F;
constexpr float kAcrossCell = 0.1F;
constexpr float kAcrossTriangle = 0.6F / 14.0F;

bool has(int corners, int corner)
{
  return (corners >> corner & 1) != 0;
}

// Calls visit(a, b, c, d), the corners of a cell around one of its faces, twice per face.
template <class Visit>
void forEachFace(const Visit& visit)
{
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
    {
      const int u = 1 << (axis + 1) % 3;
      const int v = 1 << (axis + 2) % 3;
      const int base = side << axis;
      visit(base, base + u, base + u + v, base + v);
      visit(base + u, base + u + v, base + v, base);
    }
}

bool touchAcross(int corners, int a, int b, int c, int d)
{
  return has(corners, a) && has(corners, c) && !has(corners, b) && !has(corners, d);
}

// For each corner mask of a cell, whether some inside corners touch by an edge or a corner only.
std::array<bool, 256> cellsAskew()
{
  std::array<bool, 256> result{};
  for (int corners = 1; corners < 255; ++corners)
  {
    bool& askew = result[static_cast<std::size_t>(corners)];
    forEachFace([&](int a, int b, int c, int d)
                { askew = askew || touchAcross(corners, a, b, c, d); });
    for (int a = 0; a < 4; ++a)
      askew = askew || corners == (1 << a | 1 << (7 - a));
  }
  return result;
}

// Calls lift(corner, depth) for the voxels that join the inside corners of a cell; `thin`: mask of
// the thin ones, `at(corner)`: depth in voxels.
template <class At, class Lift>
void joinCorners(int corners, int thin, const At& at, const Lift& lift)
{
  forEachFace(
      [&](int a, int b, int c, int d)
      {
        if (!touchAcross(corners, a, b, c, d) || (thin & (1 << a | 1 << c)) == 0)
          return;
        lift(b, -kAcrossFace * (at(a) + at(c)));
        lift(d, -kAcrossFace * (at(a) + at(c)));
      });
  for (int a = 0; a < 4; ++a)
    if (corners == (1 << a | 1 << (7 - a)))
      for (int corner = 0; corner < 8; ++corner)
        lift(corner, -kAcrossCell * (at(a) + at(7 - a)));
  // Three that touch by edges, the corners of a triangle: `far` is the corner beyond it.
  for (int far = 0; far < 8; ++far)
  {
    if (corners != (1 << (far ^ 3) | 1 << (far ^ 5) | 1 << (far ^ 6)))
      continue;
    const float inside = 4.0F * (at(far ^ 3) + at(far ^ 5) + at(far ^ 6)) + at(far);
    for (const int corner : {far ^ 7, far ^ 1, far ^ 2, far ^ 4})
      lift(corner, -kAcrossTriangle * std::max(inside, 0.0F));
  }
}

} // namespace

void SurfaceNet::writeOccupancy(Volume<float>& occupancy, const core::Progress& progress) const
{
  writeDistances(occupancy, progress);
  const core::IndexBox full = occupancy.geometry().fullBox();
  const OccupancyView all{full, occupancy.data(), full.upper[0],
                          static_cast<std::ptrdiff_t>(full.upper[0]) * full.upper[1]};
  std::vector<std::uint8_t> thin(m_points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, thin.size(), 4096),
                    [&](const tbb::blocked_range<std::size_t>& range)
                    {
                      for (std::size_t n = range.begin(); n < range.end(); ++n)
                        thin[n] = thinCorners(n);
                    });
  std::vector<std::size_t> thinPoints;
  for (std::size_t n = 0; n < thin.size(); ++n)
    if (thin[n] != 0)
      thinPoints.push_back(n);
  joinThin(all, thinPoints);
  fitThin(all, full, thinPoints);
}

// Joining thin voxels needs the occupancies one voxel beyond the box.
void SurfaceNet::writeOccupancyIn(const core::IndexBox& box, Volume<float>& occupancy) const
{
  const core::IndexBox full = occupancy.geometry().fullBox();
  const core::IndexBox target = box.intersected(full);
  if (target.empty())
    return;
  const core::IndexBox around = grown(target, 1).intersected(full);
  const core::Index3 size = around.size();
  std::vector<float> values(around.count(), 0.0F);
  const OccupancyView view{around, values.data(), size[0],
                           static_cast<std::ptrdiff_t>(size[0]) * size[1]};
  writeDistancesIn(around, true, view);
  std::vector<std::size_t> thinPoints;
  const core::IndexBox cells = grown(target, 2).intersected(full);
  for (int k = cells.lower[2]; k < cells.upper[2]; ++k)
    for (int j = cells.lower[1]; j < cells.upper[1]; ++j)
      for (int i = cells.lower[0]; i < cells.upper[0]; ++i)
        if (const int n = pointAt(i, j, k); n >= 0 && thinCorners(static_cast<std::size_t>(n)) != 0)
          thinPoints.push_back(static_cast<std::size_t>(n));
  if (!thinPoints.empty())
  {
    joinThin(view, thinPoints);
    fitThin(view, target, thinPoints);
  }
  for (int k = target.lower[2]; k < target.upper[2]; ++k)
    for (int j = target.lower[1]; j < target.upper[1]; ++j)
    {
      float* row = &occupancy.at(0, j, k);
      for (int i = target.lower[0]; i < target.upper[0]; ++i)
        if (const float value = view.at({i, j, k}); value > 0.0F) // see writeDistancesIn
          row[i] = value;
    }
}

// Heights above the points near the voxels of a tile: weighted sum, and sum of weights.
std::vector<std::array<float, 2>> SurfaceNet::heightsIn(const core::IndexBox& tile) const
{
  const core::Index3 size = tile.size();
  std::vector<std::array<float, 2>> sums(tile.count(), {0.0F, 0.0F});
  const core::IndexBox cells = grown(tile, kSpan).intersected(m_inside.geometry().fullBox());
  for (int k = cells.lower[2]; k < cells.upper[2]; ++k)
    for (int j = cells.lower[1]; j < cells.upper[1]; ++j)
    {
      const std::int32_t* row = nullptr;
      for (int i = cells.lower[0], from = i; i < cells.upper[0]; ++i)
      {
        if (i == from || i == PointTable::rowEnd(from))
        {
          from = i;
          row = m_pointOf.rowFrom(i, j, k);
        }
        if (!row)
        {
          i = PointTable::rowEnd(i) - 1;
          from = i;
          continue;
        }
        if (row[i - from] == 0)
          continue;
        const auto n = static_cast<std::size_t>(row[i - from] - 1);
        const Eigen::Vector3f& p = m_positions[n];
        const Eigen::Vector3f& normal = m_normals[n];
        const core::IndexBox near =
            core::IndexBox{{i - 1, j - 1, k - 1}, {i + 3, j + 3, k + 3}}.intersected(tile);
        for (int z = near.lower[2]; z < near.upper[2]; ++z)
          for (int y = near.lower[1]; y < near.upper[1]; ++y)
          {
            const std::uint8_t* inside = &m_inside.at(0, y, z);
            auto* out = &sums[static_cast<std::size_t>(
                (y - tile.lower[1] + size[1] * (z - tile.lower[2])) * size[0])];
            const float dy = static_cast<float>(y) - p.y();
            const float dz = static_cast<float>(z) - p.z();
            for (int x = near.lower[0]; x < near.upper[0]; ++x)
            {
              const float dx = static_cast<float>(x) - p.x();
              const float closeness =
                  1.0F - (dx * dx + dy * dy + dz * dz) * (1.0F / (kReach * kReach));
              const float height = dx * normal.x() + dy * normal.y() + dz * normal.z();
              // The other side of a thin sheet does not count for this voxel.
              if (closeness <= 0.0F || (height < 0.0F) != (inside[x] != 0))
                continue;
              const float squared = closeness * closeness;
              const float weight = squared * squared * squared;
              auto& sum = out[x - tile.lower[0]];
              sum[0] += weight * height;
              sum[1] += weight;
            }
          }
      }
    }
  return sums;
}

void SurfaceNet::writeDistances(Volume<float>& occupancy, const core::Progress& progress) const
{
  const core::Index3& dims = occupancy.geometry().dims();
  LabelTiles tiles(dims); // tiles that contain points
  for (const Point& point : m_points)
    tiles.row(point.cell[1] / LabelTiles::kEdge,
              point.cell[2] / LabelTiles::kEdge)[point.cell[0] / LabelTiles::kEdge] = 1;
  const core::IndexBox full = occupancy.geometry().fullBox();
  const OccupancyView all{full, occupancy.data(), dims[0],
                          static_cast<std::ptrdiff_t>(dims[0]) * dims[1]};
  const auto writeTile = [&](const core::Index3&, const core::IndexBox& tile)
  {
    const bool near = tiles.any(grown(tile, kSpan));
    if (!near && m_inside.at(tile.lower[0], tile.lower[1], tile.lower[2]) == 0)
      return; // entirely outside
    writeDistancesIn(tile, near, all);
  };
  forEachTile(dims, progress, "smoothing structures", writeTile);
}

// `near`: whether points may affect the tile.
void SurfaceNet::writeDistancesIn(const core::IndexBox& tile, bool near,
                                  const OccupancyView& occupancy) const
{
  const core::Index3 size = tile.size();
  const auto sums = near ? heightsIn(tile) : std::vector<std::array<float, 2>>();
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
    {
      const core::Index3 first{tile.lower[0], tile.lower[1] + y, tile.lower[2] + z};
      const std::uint8_t* inside = &m_inside.at(first[0], first[1], first[2]);
      float* row = &occupancy.at(first);
      for (int x = 0; x < size[0]; ++x)
      {
        const auto n = static_cast<std::size_t>(x + size[0] * (y + size[1] * z));
        const bool in = inside[x] != 0;
        float value = in ? 1.0F : 0.0F; // far from the net
        if (!sums.empty() && sums[n][1] > 1e-9F)
        {
          const float depth = -sums[n][0] / sums[n][1];
          value = occupancyOf(in ? std::max(depth, kMin) : std::min(depth, -kMin));
        }
        if (value > 0.0F) // memory is committed only where something is written
          row[x] = value;
      }
    }
}

// Whether no 2 x 2 x 2 block that contains it is entirely inside.
bool SurfaceNet::isThin(const core::Index3& voxel) const noexcept
{
  // Bit n: voxels n and n + 1 of a row around it are both inside.
  std::array<int, 9> pairs{};
  for (int row = 0; row < 9; ++row)
  {
    const std::uint8_t* at =
        &m_inside.at(voxel[0] - 1, voxel[1] + row % 3 - 1, voxel[2] + row / 3 - 1);
    pairs[static_cast<std::size_t>(row)] = (at[0] & at[1]) | (at[1] & at[2]) << 1;
  }
  for (const std::size_t row : {0U, 1U, 3U, 4U})
    if ((pairs[row] & pairs[row + 1] & pairs[row + 3] & pairs[row + 4]) != 0)
      return false;
  return true;
}

// Mask of a point's voxels that are inside and thin.
std::uint8_t SurfaceNet::thinCorners(std::size_t point) const noexcept
{
  int thin = 0;
  for (int corner = 0; corner < 8; ++corner)
    if (has(m_points[point].corners, corner) && isThin(voxelOf(m_points[point].cell, corner)))
      thin |= 1 << corner;
  return static_cast<std::uint8_t>(thin);
}

// Lifts voxels next to two or three that touch by an edge or a corner: enough to connect these, and
// little enough to stay outside themselves. For a part of the occupancies, all but its outermost
// voxels are valid.
void SurfaceNet::joinThin(const OccupancyView& occupancy,
                          const std::vector<std::size_t>& thinPoints) const
{
  struct Corners
  {
    core::Index3 cell;
    int corners;
    int thin; // the thin ones among them
  };
  const std::array<bool, 256> askew = cellsAskew();
  std::vector<Corners> cells;
  for (const std::size_t n : thinPoints)
    if (askew[m_points[n].corners])
      cells.push_back({m_points[n].cell, m_points[n].corners, thinCorners(n)});
  const auto valueAt = [&occupancy](const core::Index3& v) -> float& { return occupancy.at(v); };
  for (const Corners& cell : cells)
    for (int corner = 0; corner < 8; ++corner)
      if (has(cell.thin, corner) && occupancy.box.contains(voxelOf(cell.cell, corner)))
      {
        float& value = valueAt(voxelOf(cell.cell, corner));
        value = std::max(value, occupancyOf(kThinDepth));
      }
  const auto partly = [&occupancy](const Corners& cell)
  { return !occupancy.box.contains(cell.cell) || !occupancy.box.contains(voxelOf(cell.cell, 7)); };
  cells.erase(std::remove_if(cells.begin(), cells.end(), partly), cells.end());
  // The highest lift of a voxel counts, independent of order.
  using Lifts = std::vector<std::pair<core::Index3, float>>;
  tbb::enumerable_thread_specific<Lifts> found;
  const auto findLifts = [&](const Corners& cell, Lifts& lifts)
  {
    std::array<float, 8> depth{};
    for (int corner = 0; corner < 8; ++corner)
      depth[static_cast<std::size_t>(corner)] =
          static_cast<float>(depthOf(valueAt(voxelOf(cell.cell, corner))));
    const auto at = [&depth](int corner) { return depth[static_cast<std::size_t>(corner)]; };
    joinCorners(cell.corners, cell.thin, at,
                [&](int corner, float to)
                {
                  if (!has(cell.corners, corner) && to > at(corner))
                    lifts.emplace_back(voxelOf(cell.cell, corner),
                                       occupancyOf(std::min(to, -kMin)));
                });
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range)
                    {
                      Lifts& lifts = found.local();
                      for (std::size_t n = range.begin(); n < range.end(); ++n)
                        findLifts(cells[n], lifts);
                    });
  for (const Lifts& lifts : found)
    for (const auto& [voxel, value] : lifts)
      valueAt(voxel) = std::max(valueAt(voxel), value);
}

} // namespace petrous::volume
