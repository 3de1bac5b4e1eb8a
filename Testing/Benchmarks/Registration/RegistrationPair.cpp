#include "RegistrationPair.h"

#include <algorithm>

#include "CounterNoise.h"

namespace petrous::registration
{

std::array<Vector3d, 8> cornersOf(const core::GridGeometry& grid)
{
  std::array<Vector3d, 8> corners;
  const core::Index3& n = grid.dims();
  for (std::size_t c = 0; c < corners.size(); ++c)
    corners[c] = grid.patientFromVoxel(
        {(c & 1) ? n[0] - 1.0 : 0.0, (c & 2) ? n[1] - 1.0 : 0.0, (c & 4) ? n[2] - 1.0 : 0.0});
  return corners;
}

PairError errorOf(const RegistrationPair& pair, const core::RigidTransform& mrFromCt)
{
  const auto at = [&](const Vector3d& p) { return (mrFromCt * p - pair.truth(p)).norm(); };
  PairError error;
  for (const Vector3d& p : pair.targets)
    error.target += at(p) / static_cast<double>(pair.targets.size());
  for (const Vector3d& p : cornersOf(pair.ct->geometry()))
  {
    error.cornerMean += at(p) / 8.0;
    error.cornerMax = std::max(error.cornerMax, at(p));
  }
  return error;
}

double distanceAtTargets(const RegistrationPair& pair, const core::RigidTransform& a,
                         const core::RigidTransform& b)
{
  double most = 0.0;
  for (const Vector3d& p : pair.targets)
    most = std::max(most, (a * p - b * p).norm());
  return most;
}

RegistrationPair displaced(const RegistrationPair& pair, const core::RigidTransform& move)
{
  RegistrationPair result = pair;
  const core::GridGeometry& grid = pair.mr->geometry();
  const core::GridGeometry moved(grid.dims(), grid.spacing(), move * grid.origin(),
                                 move.rotation().toRotationMatrix() * grid.direction());
  result.mr = pair.mr->visit(
      [&](const auto& voxels)
      {
        using Voxels = std::decay_t<decltype(voxels)>;
        using Value = typename Voxels::Value;
        // Keeps the voxels alive; they are never written.
        std::shared_ptr<Value> data(pair.mr, const_cast<Value*>(voxels.data()));
        return std::make_shared<const volume::IntensityVolume>(
            std::make_shared<const Voxels>(moved, std::move(data)), pair.mr->padding());
      });
  if (pair.truth)
    result.truth = [move, truth = pair.truth](const Vector3d& p) { return move * truth(p); };
  return result;
}

core::RigidTransform randomMotion(const Vector3d& center, double millimetres, double degrees,
                                  std::uint64_t seed)
{
  const CounterNoise noise(seed);
  const auto direction = [&noise](std::uint64_t n)
  { return Vector3d(noise.normal(n), noise.normal(n + 1), noise.normal(n + 2)).normalized(); };
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180.0, direction(0)));
  const Vector3d shift = millimetres * direction(3);
  return {turn, center + shift - turn * center};
}

} // namespace petrous::registration
