#include <algorithm>
#include <cmath>
#include <vector>

#include "petrous/Volume/TissueField.h"

namespace petrous::volume
{

namespace
{

constexpr int kSubdivisions = 3; // of a cell that the surface crosses
constexpr int kRefinements = 12;

struct Nearest
{
  double distance;
  Eigen::Vector3d point;
};

// Values of f on a block of lattice points of the CT grid, each computed once.
class CornerBlock
{
public:
  CornerBlock(const TissueField& field, const core::IndexBox& box)
    : m_box(box), m_size(box.size()), m_values(box.count())
  {
    std::size_t n = 0;
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
          m_values[n++] = field.value(field.geometry().patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}));
  }

  bool crossed(int i, int j, int k) const
  {
    const bool first = solid(i, j, k);
    for (int corner = 1; corner < 8; ++corner)
      if (solid(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2 & 1)) != first)
        return true;
    return false;
  }

private:
  bool solid(int i, int j, int k) const
  {
    const std::size_t n =
      static_cast<std::size_t>(i - m_box.lower[0]) +
      static_cast<std::size_t>(m_size[0]) *
        (static_cast<std::size_t>(j - m_box.lower[1]) +
         static_cast<std::size_t>(m_size[1]) * static_cast<std::size_t>(k - m_box.lower[2]));
    return m_values[n] > 0.0;
  }

  core::IndexBox m_box;
  core::Index3 m_size;
  std::vector<double> m_values;
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
  const auto edge = [&](std::size_t a, std::size_t b) {
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

std::optional<TissueField::NearestSurface>
TissueField::nearestSurface(const Eigen::Vector3d& patient, double reach) const
{
  const core::GridGeometry& grid = geometry();
  const double h = grid.minSpacing();
  Nearest best{reach, patient};
  bool found = false;
  // Growing balls: most questions are asked near a surface, and cost little there.
  for (double radius = 2.0 * h;; radius *= 2.0)
  {
    const double r = std::min(radius, reach);
    const Eigen::Vector3d reachBox = Eigen::Vector3d::Constant(r);
    const core::IndexBox box = grid.boxCovering(patient - reachBox, patient + reachBox);
    if (!box.empty())
    {
      const CornerBlock corners(*this, box);
      const double cellRadius = 0.5 * grid.spacing().norm();
      for (int k = box.lower[2]; k + 1 < box.upper[2]; ++k)
        for (int j = box.lower[1]; j + 1 < box.upper[1]; ++j)
          for (int i = box.lower[0]; i + 1 < box.upper[0]; ++i)
          {
            const double toCenter =
              (grid.patientFromVoxel({i + 0.5, j + 0.5, k + 0.5}) - patient).norm();
            if (toCenter - cellRadius > best.distance || !corners.crossed(i, j, k))
              continue;
            const double before = best.distance;
            searchCell(*this, patient, {i, j, k}, best);
            found = found || best.distance < before;
          }
    }
    if ((found && best.distance <= r) || r >= reach)
      break;
  }
  if (!found)
    return std::nullopt;
  refine(*this, patient, best);
  return NearestSurface{value(patient) > 0.0 ? -best.distance : best.distance, best.point,
                        normal(best.point, 0.5)};
}

} // namespace petrous::volume
