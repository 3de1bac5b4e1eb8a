#include <algorithm>
#include <cmath>
#include <vector>

#include "petrous/Volume/NearestSurface.h"

namespace petrous::volume
{

namespace
{

constexpr int kBlock = 8;        // cells along the edge of a block
constexpr int kSubdivisions = 3; // of a cell that the surface crosses
constexpr int kRefinements = 12;

struct Nearest // the best so far
{
  double distance;
  Eigen::Vector3d point;
};

// Nearest crossing of f on the lines of a finer lattice inside one cell.
void searchCell(const TissueField& field, const Eigen::Vector3d& from, const core::Index3& cell,
                Nearest& best)
{
  constexpr int n = kSubdivisions + 1;
  std::array<Eigen::Vector3d, n * n * n> points;
  std::array<double, n * n * n> values{};
  const auto at = [](int i, int j, int k) { return static_cast<std::size_t>(i + n * (j + n * k)); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const Eigen::Vector3d voxel(cell[0] + i / double{kSubdivisions},
                                    cell[1] + j / double{kSubdivisions},
                                    cell[2] + k / double{kSubdivisions});
        points[at(i, j, k)] = field.geometry().patientFromVoxel(voxel);
        values[at(i, j, k)] = field.value(points[at(i, j, k)]);
      }
  const auto edge = [&](std::size_t a, std::size_t b)
  {
    if ((values[a] > 0.0) == (values[b] > 0.0))
      return;
    const double t = values[a] / (values[a] - values[b]);
    const Eigen::Vector3d p = points[a] + t * (points[b] - points[a]);
    const double d = (p - from).norm();
    if (d < best.distance)
      best = {d, p};
  };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        if (i + 1 < n)
          edge(at(i, j, k), at(i + 1, j, k));
        if (j + 1 < n)
          edge(at(i, j, k), at(i, j + 1, k));
        if (k + 1 < n)
          edge(at(i, j, k), at(i, j, k + 1));
      }
}

// Slides the point along the surface towards `from`, and back onto f = 0 by bisection.
void refine(const TissueField& field, const Eigen::Vector3d& from, Nearest& best)
{
  const double h = field.geometry().minSpacing();
  double stride = 1.0;
  for (int round = 0; round < kRefinements; ++round)
  {
    const Eigen::Vector3d n = field.normal(best.point, 0.5);
    if (n.isZero())
      return;
    const Eigen::Vector3d offset = from - best.point;
    const Eigen::Vector3d slide = stride * (offset - n * n.dot(offset));
    const Eigen::Vector3d moved =
        best.point + slide * std::min(1.0, 0.5 * h / std::max(slide.norm(), 1e-12));
    const Eigen::Vector3d in = moved - 0.5 * h * n;
    const auto hit = field.firstHit(moved + 0.5 * h * n, in);
    if (!hit || *hit <= 0.0)
    {
      stride *= 0.5;
      continue;
    }
    const Eigen::Vector3d p = moved + (0.5 * h - *hit) * n;
    const double d = (p - from).norm();
    if (d < best.distance)
      best = {d, p};
    else
      stride *= 0.5;
  }
}

} // namespace

NearestSurfaceSearch::NearestSurfaceSearch(const TissueField& field, double reach)
  : m_field(field)
  , m_reach(reach)
{
}

std::vector<NearestSurfaceSearch::Candidate>
NearestSurfaceSearch::blocksWithinReach(const Eigen::Vector3d& patient) const
{
  const core::GridGeometry& grid = m_field.geometry();
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(m_reach);
  const core::IndexBox box = grid.boxCovering(patient - reach, patient + reach);
  std::vector<Candidate> blocks;
  if (box.empty())
    return blocks;
  const double blockRadius = 0.5 * kBlock * grid.spacing().norm();
  const auto last = [&box](std::size_t a) { return (box.upper[a] - 1) / kBlock; };
  for (int k = box.lower[2] / kBlock; k <= last(2); ++k)
    for (int j = box.lower[1] / kBlock; j <= last(1); ++j)
      for (int i = box.lower[0] / kBlock; i <= last(0); ++i)
      {
        const Eigen::Vector3d center =
            grid.patientFromVoxel({(i + 0.5) * kBlock, (j + 0.5) * kBlock, (k + 0.5) * kBlock});
        const double distance = (center - patient).norm() - blockRadius;
        if (distance < m_reach)
          blocks.push_back({distance, {i, j, k}});
      }
  std::sort(blocks.begin(), blocks.end(),
            [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  return blocks;
}

const std::vector<core::Index3>& NearestSurfaceSearch::crossedCells(const core::Index3& block)
{
  const std::uint64_t key = static_cast<std::uint64_t>(block[0]) |
                            static_cast<std::uint64_t>(block[1]) << 21 |
                            static_cast<std::uint64_t>(block[2]) << 42;
  const auto [entry, isNew] = m_crossed.try_emplace(key);
  if (!isNew)
    return entry->second;

  const core::GridGeometry& grid = m_field.geometry();
  constexpr int n = kBlock + 1;
  core::IndexBox corners;
  for (std::size_t a = 0; a < 3; ++a)
  {
    corners.lower[a] = block[a] * kBlock;
    corners.upper[a] = std::min(corners.lower[a] + n, grid.dims()[a]);
  }
  std::array<bool, n * n * n> solid{};
  const auto at = [](int i, int j, int k) { return static_cast<std::size_t>(i + n * (j + n * k)); };
  const core::Index3 size = corners.size();
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        solid[at(i, j, k)] = m_field.value(grid.patientFromVoxel(
                                 {1.0 * (corners.lower[0] + i), 1.0 * (corners.lower[1] + j),
                                  1.0 * (corners.lower[2] + k)})) > 0.0;
  for (int k = 0; k + 1 < size[2]; ++k)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int i = 0; i + 1 < size[0]; ++i)
      {
        int count = 0;
        for (int corner = 0; corner < 8; ++corner)
          count += solid[at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2 & 1))];
        if (count > 0 && count < 8)
          entry->second.push_back(
              {corners.lower[0] + i, corners.lower[1] + j, corners.lower[2] + k});
      }
  return entry->second;
}

std::optional<NearestSurface> NearestSurfaceSearch::find(const Eigen::Vector3d& patient)
{
  const core::GridGeometry& grid = m_field.geometry();
  const double cellRadius = 0.5 * grid.spacing().norm();
  Nearest best{m_reach, patient};
  for (const Candidate& block : blocksWithinReach(patient))
  {
    if (block.distance > best.distance)
      break;
    for (const core::Index3& cell : crossedCells(block.block))
    {
      const Eigen::Vector3d center =
          grid.patientFromVoxel({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5});
      if ((center - patient).norm() - cellRadius <= best.distance)
        searchCell(m_field, patient, cell, best);
    }
  }
  if (best.distance >= m_reach)
    return std::nullopt;
  refine(m_field, patient, best);
  return NearestSurface{m_field.value(patient) > 0.0 ? -best.distance : best.distance, best.point,
                        m_field.normal(best.point, 0.5)};
}

} // namespace petrous::volume
