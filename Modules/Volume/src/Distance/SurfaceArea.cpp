#include "petrous/Volume/SurfaceArea.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <tbb/parallel_for.h>

#include "OccupancySurface.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::volume
{

namespace
{
constexpr int kParts = 2;               // lines per voxel edge
constexpr std::size_t kChunk = 4096;    // cells per task
constexpr double kSmallestSlope = 1e-6; // of the occupancy, per mm: below this there is no surface
} // namespace

double surfaceArea(
    const Volume<float>& occupancy,
    const std::function<bool(const Eigen::Vector3d& point, const Eigen::Vector3d& outward)>& counts,
    const core::Progress& progress)
{
  const OccupancySurface surface(occupancy);
  const core::GridGeometry& grid = occupancy.geometry();
  const std::vector<core::Index3> cells = surface.crossedCells(progress);
  std::vector<double> areas((cells.size() + kChunk - 1) / kChunk);
  const auto areaOf = [&](const core::Index3& cell)
  {
    double area = 0.0;
    surface.forEachCrossing(
        cell, kParts,
        [&](const OccupancySurface::Crossing& crossing)
        {
          if (crossing.shared)
            return;
          const Eigen::Vector3d slope = surface.at(crossing.point).gradient;
          const double steepness = slope.norm();
          if (!(steepness > kSmallestSlope))
            return;
          const Eigen::Vector3d voxel = crossing.point.cwiseQuotient(grid.spacing());
          const Eigen::Vector3d outward = -sampleGradient(occupancy, voxel, 1.0);
          const double length = outward.norm();
          if (!(length > kSmallestSlope) || !counts(grid.patientFromVoxel(voxel), outward / length))
            return;
          const double face = grid.voxelVolume() / grid.spacing()[crossing.axis];
          area += face / (kParts * kParts) * std::abs(slope[crossing.axis]) / steepness;
        });
    return area;
  };
  tbb::parallel_for(std::size_t{0}, areas.size(),
                    [&](std::size_t n)
                    {
                      progress.check("measuring structures");
                      const std::size_t last = std::min((n + 1) * kChunk, cells.size());
                      for (std::size_t c = n * kChunk; c < last; ++c)
                        areas[n] += areaOf(cells[c]);
                    });
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

} // namespace petrous::volume
