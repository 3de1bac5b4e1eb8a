#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "petrous/Volume/NearestSurface.h"

namespace petrous::volume
{

namespace
{

constexpr int kBlock = 8;        // cells along the edge of a block
constexpr int kSubdivisions = 3; // of a crossed cell, minimum
constexpr int kMaxSubdivisions = 12;
constexpr double kFine = 0.9; // of the CT's spacing: finer unions are sampled at their own
                              // resolution
constexpr int kRefinements = 12;

struct Nearest // best candidate so far
{
  double distance;
  Eigen::Vector3d point;
};

// Finer unions need a finer lattice: their walls are at least three of their voxels thick.
int subdivisionsOf(const TissueField& field)
{
  const double ratio = field.geometry().spacing().maxCoeff() / field.finestSpacing();
  return std::clamp(static_cast<int>(std::ceil(0.7 * ratio)), kSubdivisions, kMaxSubdivisions);
}

// Nearest crossing of f on the lines of a finer lattice inside one cell.
void searchCell(const TissueField& field, const Eigen::Vector3d& from, const core::Index3& cell,
                int subdivisions, Nearest& best)
{
  const int n = subdivisions + 1;
  std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(n * n * n));
  std::vector<double> values(points.size());
  const auto at = [n](int i, int j, int k)
  { return static_cast<std::size_t>(i + n * (j + n * k)); };
  const double part = 1.0 / subdivisions;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const Eigen::Vector3d voxel(cell[0] + i * part, cell[1] + j * part, cell[2] + k * part);
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

// Over all operands, mm: the reach of normals.
double coarsestSpacing(const TissueField& field)
{
  double spacing = field.geometry().spacing().maxCoeff();
  for (const TissueField::SolidUnion& occupancy : field.solids())
    spacing = std::max(spacing, occupancy->geometry().spacing().maxCoeff());
  return spacing;
}

void prepareAround(const TissueField& field, const Eigen::Vector3d& point, double reach)
{
  const Eigen::Vector3d step = Eigen::Vector3d::Constant(reach);
  field.prepare({point - step, point + step});
}

// Slides the point along the surface towards `from`, and projects it onto f = 0 by bisection.
void refine(const TissueField& field, const Eigen::Vector3d& from, Nearest& best)
{
  const double h = field.finestSpacing();
  double stride = 1.0;
  // Each round moves by h/2, searches as far again, and needs half a voxel around that for the
  // normal.
  const double around = 1.5 * h + coarsestSpacing(field);
  for (int round = 0; round < kRefinements; ++round)
  {
    prepareAround(field, best.point, around);
    const Eigen::Vector3d n = field.normal(best.point, 0.5);
    if (n.isZero())
      return;
    const Eigen::Vector3d offset = from - best.point;
    const Eigen::Vector3d slide = stride * (offset - n * n.dot(offset));
    const Eigen::Vector3d moved =
        best.point + slide * std::min(1.0, 0.5 * h / std::max(slide.norm(), 1e-12));
    const Eigen::Vector3d in = moved - 0.5 * h * n;
    const Eigen::Vector3d out = moved + 0.5 * h * n;
    // A search from outside the scan would hit its face, which is not a surface.
    const bool known = field.geometry().hullContains(field.geometry().voxelFromPatient(out));
    const auto hit = known ? field.firstHit(out, in) : std::nullopt;
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
  , m_subdivisions(subdivisionsOf(field))
{
}

std::vector<NearestSurfaceSearch::Candidate>
NearestSurfaceSearch::blocksWithinReach(const Eigen::Vector3d& patient, double reach) const
{
  const core::GridGeometry& grid = m_field.geometry();
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(reach);
  const core::IndexBox box = grid.boxCovering(patient - around, patient + around);
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
        if (distance < reach)
          blocks.push_back({distance, {i, j, k}});
      }
  std::sort(blocks.begin(), blocks.end(),
            [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  return blocks;
}

// Marks cells that contain inside voxels of a union with finer voxels: a whole wall may lie between
// CT voxel centres.
void NearestSurfaceSearch::markFine(const core::IndexBox& corners, bool* cells) const
{
  const core::GridGeometry& grid = m_field.geometry();
  for (const TissueField::SolidUnion& occupancy : m_field.solids())
  {
    const core::GridGeometry& own = occupancy->geometry();
    if (own.minSpacing() > kFine * grid.minSpacing())
      continue;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
    Eigen::Vector3d high = -low;
    for (int corner = 0; corner < 8; ++corner)
    {
      Eigen::Vector3d voxel;
      for (int a = 0; a < 3; ++a)
        voxel[a] = corner >> a & 1 ? corners.upper[static_cast<std::size_t>(a)] - 1.0
                                   : corners.lower[static_cast<std::size_t>(a)];
      const Eigen::Vector3d p = grid.patientFromVoxel(voxel);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const core::IndexBox box = own.boxCovering(low, high);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
        {
          if (!(occupancy->at(i, j, k) > 0.5F))
            continue;
          const Eigen::Vector3d voxel =
              grid.voxelFromPatient(own.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}));
          core::Index3 cell;
          bool within = true;
          for (std::size_t a = 0; a < 3; ++a)
          {
            cell[a] = static_cast<int>(std::floor(voxel[static_cast<Eigen::Index>(a)])) -
                      corners.lower[a];
            within = within && cell[a] >= 0 && cell[a] < corners.size()[a] - 1;
          }
          if (within)
            cells[cell[0] + kBlock * (cell[1] + kBlock * cell[2])] = true;
        }
  }
}

// Where the CT alone exceeds the maximum of a union, no union is needed.
void NearestSurfaceSearch::prepareBlock(const core::IndexBox& corners) const
{
  constexpr double kMaxOfUnion = 0.5;
  const TissueField::Parameters& parameters = m_field.parameters();
  bool alone = true;
  for (int k = corners.lower[2]; k < corners.upper[2] && alone; ++k)
    for (int j = corners.lower[1]; j < corners.upper[1] && alone; ++j)
      for (int i = corners.lower[0]; i < corners.upper[0]; ++i)
        alone = alone && (m_field.ct()->at(i, j, k) - parameters.iso) / parameters.scale >
                             kMaxOfUnion; // false for NaN
  if (alone)
    return;
  const core::GridGeometry& grid = m_field.geometry();
  const auto at = [&](const core::Index3& v) {
    return grid.patientFromVoxel({1.0 * v[0], 1.0 * v[1], 1.0 * v[2]});
  };
  core::PatientBox box;
  for (int corner = 0; corner < 8; ++corner)
    box.extend(at({(corner & 1) != 0 ? corners.upper[0] - 1 : corners.lower[0],
                   (corner & 2) != 0 ? corners.upper[1] - 1 : corners.lower[1],
                   (corner & 4) != 0 ? corners.upper[2] - 1 : corners.lower[2]}));
  m_field.prepare(box);
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
  prepareBlock(corners);
  std::array<bool, n * n * n> solid{};
  const auto at = [](int i, int j, int k) { return static_cast<std::size_t>(i + n * (j + n * k)); };
  const core::Index3 size = corners.size();
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        solid[at(i, j, k)] = m_field.value(grid.patientFromVoxel(
                                 {1.0 * (corners.lower[0] + i), 1.0 * (corners.lower[1] + j),
                                  1.0 * (corners.lower[2] + k)})) > 0.0;
  constexpr auto cells = static_cast<std::size_t>(kBlock * kBlock * kBlock);
  std::array<bool, cells> fine{};
  markFine(corners, fine.data());
  for (int k = 0; k + 1 < size[2]; ++k)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int i = 0; i + 1 < size[0]; ++i)
      {
        int count = 0;
        for (int corner = 0; corner < 8; ++corner)
          count += solid[at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2 & 1))];
        const bool between = fine[static_cast<std::size_t>(i + kBlock * (j + kBlock * k))];
        if (count < 8 && (count > 0 || between))
          entry->second.push_back(
              {corners.lower[0] + i, corners.lower[1] + j, corners.lower[2] + k});
      }
  return entry->second;
}

std::optional<NearestSurface> NearestSurfaceSearch::find(const Eigen::Vector3d& patient,
                                                         double reach)
{
  const core::GridGeometry& grid = m_field.geometry();
  const double cellRadius = 0.5 * grid.spacing().norm();
  Nearest best{reach, patient};
  for (const Candidate& block : blocksWithinReach(patient, reach))
  {
    if (block.distance > best.distance)
      break;
    for (const core::Index3& cell : crossedCells(block.block))
    {
      const Eigen::Vector3d center =
          grid.patientFromVoxel({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5});
      if ((center - patient).norm() - cellRadius <= best.distance)
        searchCell(m_field, patient, cell, m_subdivisions, best);
    }
  }
  if (best.distance >= reach)
    return std::nullopt;
  refine(m_field, patient, best);
  prepareAround(m_field, patient, 0.0);
  prepareAround(m_field, best.point, coarsestSpacing(m_field));
  return NearestSurface{m_field.value(patient) > 0.0 ? -best.distance : best.distance, best.point,
                        m_field.normal(best.point, 0.5)};
}

} // namespace petrous::volume
