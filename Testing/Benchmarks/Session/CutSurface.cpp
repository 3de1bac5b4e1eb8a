#include "CutSurface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petrous::session
{

namespace
{

using Eigen::Vector3d;

constexpr double kStep = 0.1; // voxels
constexpr int kHalvings = 20;

// The n-th of `count` directions evenly distributed over the sphere (golden angle).
Vector3d directionOf(int n, int count)
{
  const double z = 1.0 - (2.0 * n + 1.0) / count;
  const double turn = 2.399963229728653 * n;
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

// Where the mask crosses 1/2 on the ray from inside the cut; nullopt outside the grid.
std::optional<Vector3d> surfaceOn(const volume::CutMask& mask, const Vector3d& from,
                                  const Vector3d& way, double first)
{
  const core::GridGeometry& grid = mask.geometry();
  const double h = grid.minSpacing();
  const auto solid = [&](double t)
  { return mask.sample(grid.voxelFromPatient(from + t * way)) > 0.5; };
  double t = first;
  while (grid.hullContains(grid.voxelFromPatient(from + t * way)))
  {
    if (!solid(t))
    {
      t += kStep * h;
      continue;
    }
    double low = t - kStep * h;
    for (int n = 0; n < kHalvings; ++n)
    {
      const double middle = 0.5 * (low + t);
      (solid(middle) ? t : low) = middle;
    }
    return from + t * way;
  }
  return std::nullopt;
}

} // namespace

SurfaceError surfaceErrorOf(const testing::LawScene& scene, int centers, int directions)
{
  const volume::CutMask& mask = scene.work.mask();
  const double h = mask.geometry().minSpacing();
  const auto& bites = scene.bites;
  SurfaceError error;
  double squares = 0.0;
  double sum = 0.0;
  const auto stride = std::max<std::size_t>(1, bites.size() / static_cast<std::size_t>(centers));
  for (std::size_t b = 0; b < bites.size(); b += stride)
    for (int d = 0; d < directions; ++d)
    {
      const Vector3d way = directionOf(d, directions);
      const auto point =
          surfaceOn(mask, bites[b].from, way, std::max(0.0, bites[b].radius - 2.0 * h));
      if (!point || !(scene.tissue.uncut(*point) > 0.0))
        continue;
      double off = std::numeric_limits<double>::infinity();
      for (const dissection::SweptSphere& bite : bites)
        off = std::min(off, (*point - bite.from).norm() - bite.radius);
      off /= h;
      squares += off * off;
      sum += off;
      error.most = std::max(error.most, std::abs(off));
      ++error.points;
    }
  const auto count = static_cast<double>(std::max<std::size_t>(error.points, 1));
  error.rms = std::sqrt(squares / count);
  error.mean = sum / count;
  return error;
}

} // namespace petrous::session
