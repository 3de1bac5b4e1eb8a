#include "petrous/Presenters/DissectionDistances.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <tbb/parallel_for.h>

#include "petrous/Presenters/StructureSurfaces.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/CaseField.h"

namespace petrous::presenters
{

namespace
{
constexpr int kCellEdge = 4; // voxels; divides CutMask::kBrickEdge
} // namespace

void RemovedTissue::addPoints(const volume::TissueField& tissue, const volume::CutMask& mask,
                              const core::Index3& voxel, std::vector<Eigen::Vector3d>& points)
{
  const auto [i, j, k] = voxel;
  constexpr double kHalf = 0.5 * volume::CutMask::kUntouched;
  const double here = mask.at(i, j, k);
  if (here >= kHalf)
    return;
  const core::GridGeometry& grid = mask.geometry();
  const Eigen::Vector3d middle(i, j, k);
  const auto add = [&](const Eigen::Vector3d& at)
  {
    const Eigen::Vector3d patient = grid.patientFromVoxel(at);
    if (tissue.uncut(patient) > 0.0)
      points.push_back(patient);
  };
  add(middle);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1})
    {
      core::Index3 next = voxel;
      next[axis] += step;
      if (next[axis] < 0 || next[axis] >= grid.dims()[axis])
        continue;
      const double there = mask.at(next[0], next[1], next[2]);
      if (there < kHalf)
        continue;
      Eigen::Vector3d wall = middle;
      wall[static_cast<Eigen::Index>(axis)] += step * (kHalf - here) / (there - here);
      add(wall);
    }
}

RemovedTissue::RemovedTissue(const volume::TissueField& tissue, const volume::CutMask& mask,
                             const core::Progress& progress)
{
  const std::vector<std::size_t> bricks = mask.cutBricks();
  std::vector<std::vector<Cell>> found(bricks.size());
  tbb::parallel_for(std::size_t{0}, bricks.size(),
                    [&](std::size_t n)
                    { found[n] = cellsOf(tissue, mask, mask.brickBox(bricks[n])); });
  progress.check("measuring distances");
  for (auto& some : found)
    std::move(some.begin(), some.end(), std::back_inserter(m_cells));
}

std::vector<RemovedTissue::Cell> RemovedTissue::cellsOf(const volume::TissueField& tissue,
                                                        const volume::CutMask& mask,
                                                        const core::IndexBox& box)
{
  std::vector<Cell> cells;
  for (int ck = box.lower[2]; ck < box.upper[2]; ck += kCellEdge)
    for (int cj = box.lower[1]; cj < box.upper[1]; cj += kCellEdge)
      for (int ci = box.lower[0]; ci < box.upper[0]; ci += kCellEdge)
      {
        Cell cell;
        for (int k = ck; k < std::min(ck + kCellEdge, box.upper[2]); ++k)
          for (int j = cj; j < std::min(cj + kCellEdge, box.upper[1]); ++j)
            for (int i = ci; i < std::min(ci + kCellEdge, box.upper[0]); ++i)
              addPoints(tissue, mask, {i, j, k}, cell.points);
        if (cell.points.empty())
          continue;
        for (const Eigen::Vector3d& point : cell.points)
          cell.center += point / static_cast<double>(cell.points.size());
        for (const Eigen::Vector3d& point : cell.points)
          cell.radius = std::max(cell.radius, (point - cell.center).norm());
        cells.push_back(std::move(cell));
      }
  return cells;
}

// The distance is 1-Lipschitz: a cell is passed over where its centre is too far.
std::optional<RemovedTissue::Nearest> RemovedTissue::nearest(StructureSurfaces& surfaces,
                                                             std::size_t structure,
                                                             const core::Progress& progress) const
{
  double best = StructureSurfaces::kFar;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < m_cells.size() && best > 0.0; ++n)
  {
    const Cell& cell = m_cells[n];
    if (n % 256 == 0)
      progress.check("measuring distances");
    const double reach = best + cell.radius;
    if (surfaces.distance(structure, cell.center, reach) >= reach)
      continue;
    for (const Eigen::Vector3d& point : cell.points)
      if (const double there = surfaces.distance(structure, point, best); there < best)
      {
        best = there;
        place = point;
      }
  }
  if (best >= StructureSurfaces::kFar)
    return std::nullopt;
  return Nearest{std::max(best, 0.0), place};
}

std::optional<double> wallUncertainty(const scene::Case& value, const SurfaceUncertainty& surface)
{
  if (surface.incomplete())
    return std::nullopt;
  return std::hypot(surface.millimetres(), 0.5 * value.ct.geometry.spacing().maxCoeff());
}

std::vector<DissectionDistance> dissectionDistances(const scene::Case& value,
                                                    const core::Progress& progress)
{
  if (!value.dissection.loaded())
    throw core::InvalidParameter("distances: the dissection of case '" + value.name +
                                 "' is not loaded");
  std::vector<DissectionDistance> distances;
  if (value.dissection.mask().untouched())
    return distances;
  const RemovedTissue removed(scene::tissueField(value, progress.part(0.0, 0.1)),
                              value.dissection.mask(), progress);
  if (removed.empty())
    return distances;
  const auto touched = scene::summaryOf(value, value.dissection.history().position()).structures;
  StructureSurfaces surfaces(value);
  for (std::size_t n = 0; n < surfaces.count(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(surfaces.count()),
                    "measuring distances");
    surfaces.measure(
        n, progress.part(static_cast<double>(n) / static_cast<double>(surfaces.count()),
                         static_cast<double>(n + 1) / static_cast<double>(surfaces.count())));
    const auto nearest = removed.nearest(surfaces, n, progress);
    if (!nearest)
      continue;
    const SurfaceUncertainty& surface = surfaces.uncertainty(n);
    DissectionDistance one;
    one.name = surfaces.name(n);
    one.distance = {"distance of the dissection", nearest->distance, "mm",
                    wallUncertainty(value, surface), toString(surface)};
    const auto found = std::find_if(touched.begin(), touched.end(),
                                    [&one](const dissection::TouchedStructure& structure)
                                    { return structure.name == one.name; });
    if (found != touched.end())
      one.removed = found->volume;
    one.place = nearest->place;
    one.onStructure =
        nearest->distance > 0.0 ? surfaces.nearestPoint(n, nearest->place) : nearest->place;
    distances.push_back(std::move(one));
  }
  std::stable_sort(distances.begin(), distances.end(),
                   [](const DissectionDistance& a, const DissectionDistance& b)
                   { return *a.distance.value < *b.distance.value; });
  return distances;
}

} // namespace petrous::presenters
