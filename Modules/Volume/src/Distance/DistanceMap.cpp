#include "petrous/Volume/DistanceMap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "ClosestPoints.h"
#include "DistanceGrid.h"
#include "OccupancySurface.h"

namespace petrous::volume
{

namespace
{

constexpr double kMargin = 2.5; // voxels of the occupancy beyond those inside
constexpr double kSharp = 3.0;  // map voxels: the spline is sharpened closer to the surface than
                                // this,
constexpr double kFullySharp = 1.5; // and fully so up to here

constexpr double kNoSurface = 1e6; // mm: the structure fills its grid

// Depth below the faces of a grid's hull, mm.
double belowHull(const core::GridGeometry& grid, const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  double depth = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double last = grid.dims()[a] - 1.0;
    depth = std::min(depth, grid.spacing()[axis] * std::min(voxel[axis], last - voxel[axis]));
  }
  return depth;
}

// A quadratic B-spline with the values as coefficients lowers them by an eighth of the second
// difference; this is compensated near the surface. Around the medial axis it is not, which rounds
// the ridge.
void sharpen(const Volume<float>& depth, Volume<float>& result)
{
  const core::Index3& dims = depth.geometry().dims();
  const double edge = depth.geometry().minSpacing();
  const auto row = static_cast<std::ptrdiff_t>(dims[0]);
  const std::ptrdiff_t plane = row * dims[1];
  tbb::parallel_for(
      0, dims[2],
      [&](int k)
      {
        for (int j = 0; j < dims[1]; ++j)
          for (int i = 0; i < dims[0]; ++i)
          {
            const float* here = &depth.at(i, j, k);
            const double fade = (kSharp - std::abs(double{*here}) / edge) / (kSharp - kFullySharp);
            double second = 0.0;
            const core::Index3 at{i, j, k};
            const std::array<std::ptrdiff_t, 3> strides{1, row, plane};
            for (std::size_t a = 0; a < 3; ++a)
              if (at[a] > 0 && at[a] + 1 < dims[a])
                second +=
                    double{here[strides[a]]} + double{here[-strides[a]]} - 2.0 * double{*here};
            result.at(i, j, k) =
                static_cast<float>(double{*here} - std::clamp(fade, 0.0, 1.0) * second / 8.0);
          }
      });
}

} // namespace

DistanceMap::DistanceMap(Volume<float> coefficients)
  : m_coefficients(std::move(coefficients))
{
  const core::Index3& dims = geometry().dims();
  m_last = Eigen::Vector3d(dims[0] - 2.0, dims[1] - 2.0, dims[2] - 2.0);
  m_border = std::numeric_limits<double>::max();
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
    {
      const bool face = k < 2 || j < 2 || k >= dims[2] - 2 || j >= dims[1] - 2;
      for (int i = 0; i < dims[0]; ++i)
      {
        const double depth = double{m_coefficients.at(i, j, k)};
        m_deepest = std::max(m_deepest, depth);
        if (face || i < 2 || i >= dims[0] - 2)
          m_border = std::min(m_border, -depth);
      }
    }
  // Nodes are one edge apart, and depth decreases by no more than the distance.
  m_border = std::max(0.0, m_border - geometry().minSpacing());
}

double DistanceMap::away(const Eigen::Vector3d& voxel) const noexcept
{
  const Eigen::Array3d beyond = (1.0 - voxel.array()).max(voxel.array() - m_last.array()).max(0.0);
  if ((beyond == 0.0).all())
    return 0.0;
  return m_border + geometry().minSpacing() * beyond.matrix().norm();
}

DistanceMap::Sample DistanceMap::at(const Eigen::Vector3d& voxel) const noexcept
{
  std::array<std::array<double, 3>, 3> weight{};
  std::array<std::array<double, 3>, 3> slope{};
  core::Index3 first;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double x = voxel[static_cast<Eigen::Index>(a)];
    const int nearest = static_cast<int>(x + 0.5);
    const double t = x - nearest;
    first[a] = nearest - 1;
    weight[a] = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
    slope[a] = {t - 0.5, -2.0 * t, t + 0.5};
  }
  const core::Index3& dims = geometry().dims();
  const auto row = static_cast<std::ptrdiff_t>(dims[0]);
  const float* corner = &m_coefficients.at(first[0], first[1], first[2]);
  Sample result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    double value = 0.0;
    double alongX = 0.0;
    double alongY = 0.0;
    for (std::size_t j = 0; j < 3; ++j)
    {
      const float* at = corner + row * (static_cast<std::ptrdiff_t>(j) +
                                        dims[1] * static_cast<std::ptrdiff_t>(k));
      const double sum = weight[0][0] * double{at[0]} + weight[0][1] * double{at[1]} +
                         weight[0][2] * double{at[2]};
      value += weight[1][j] * sum;
      alongY += slope[1][j] * sum;
      alongX += weight[1][j] * (slope[0][0] * double{at[0]} + slope[0][1] * double{at[1]} +
                                slope[0][2] * double{at[2]});
    }
    result.depth += weight[2][k] * value;
    result.gradient +=
        Eigen::Vector3d(weight[2][k] * alongX, weight[2][k] * alongY, slope[2][k] * value);
  }
  result.gradient = geometry().voxelFromPatientLinear().transpose() * result.gradient;
  return result;
}

double DistanceMap::depth(const Eigen::Vector3d& patient) const noexcept
{
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(patient);
  const double far = away(voxel);
  return far > 0.0 ? -far : at(voxel).depth;
}

std::shared_ptr<const DistanceMap> makeDistanceMap(const Volume<float>& occupancy,
                                                   const core::GridGeometry& domain,
                                                   const core::Progress& progress,
                                                   std::size_t maxVoxels)
{
  const core::GridGeometry& from = occupancy.geometry();
  const core::IndexBox box = insideBox(occupancy);
  if (box.empty())
    return nullptr;
  const DistanceGrid grid = gridFor(from, box, kMargin * from.minSpacing(), maxVoxels);
  const OccupancySurface surface(occupancy);
  const ClosestPoints closest(surface.points(progress.part(0.0, 0.2)), grid.dims, grid.origin,
                              grid.edge, progress.part(0.2, 0.8));

  const core::GridGeometry own = geometryOf(grid, from);
  Volume<float> depth(own);
  tbb::parallel_for(
      0, grid.dims[2],
      [&](int k)
      {
        for (int j = 0; j < grid.dims[1]; ++j)
          for (int i = 0; i < grid.dims[0]; ++i)
          {
            const std::size_t node = own.linearIndex(i, j, k);
            const Eigen::Vector3d voxel(i, j, k);
            const Eigen::Vector3d position = grid.origin + grid.edge * voxel;
            const double distance =
                closest.any() ? surface.refined(position, closest.point(node)) : kNoSurface;
            const double inside = surface.at(position).value > 0.0 ? distance : -distance;
            const Eigen::Vector3d patient = own.patientFromVoxel(voxel);
            depth.data()[node] = static_cast<float>(
                std::min({inside, belowHull(domain, patient), belowHull(from, patient)}));
          }
      });
  progress.check("measuring structures");
  Volume<float> coefficients(own);
  sharpen(depth, coefficients);
  progress.report(1.0, "measuring structures");
  return std::shared_ptr<const DistanceMap>(new DistanceMap(std::move(coefficients)));
}

} // namespace petrous::volume
