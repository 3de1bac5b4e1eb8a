#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "LabelOccupancy.h"
#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

using Eigen::Vector3d;

constexpr int kReach = 4;      // voxels, neighbourhood to which a sheet or a rod is fitted
constexpr double kSigma = 1.4; // voxels, of its Gaussian weights
constexpr double kPi = 3.14159265358979323846;

// Minimum half thickness of a sheet, and radius of a rod, without holes in any orientation.
constexpr double kThinnestSheet = 0.53;
constexpr double kThinnestRod = 0.65;
constexpr double kThickest = 0.85;

double ramp(double from, double to, double value)
{
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

struct Fit
{
  double weight = 0.0; // 0: neither
  double depth = 0.0;  // voxels
};

// Fits a plane or a line to the inside around a voxel, and returns the voxel's depth in it. The
// thickness follows from the weighted amount: 2 pi sigma^2 t for a sheet of thickness t, sqrt(2 pi)
// sigma a for a rod of cross-section a.
Fit fitAround(const Volume<std::uint8_t>& inside, const core::Index3& at)
{
  static const auto kWeights = []
  {
    std::array<double, 2 * kReach + 1> weights{};
    for (int d = -kReach; d <= kReach; ++d)
      weights[static_cast<std::size_t>(d + kReach)] = std::exp(-0.5 * d * d / (kSigma * kSigma));
    return weights;
  }();
  const auto weightOf = [](int d) { return kWeights[static_cast<std::size_t>(d + kReach)]; };
  const core::IndexBox box = core::IndexBox{
      {at[0] - kReach, at[1] - kReach, at[2] - kReach},
      {at[0] + kReach + 1, at[1] + kReach + 1,
       at[2] + kReach + 1}}.intersected(inside.geometry().fullBox());
  double sum = 0.0;
  Vector3d first = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
    {
      const std::uint8_t* row = &inside.at(0, j, k);
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        if (row[i] == 0)
          continue;
        const Vector3d p(i - at[0], j - at[1], k - at[2]);
        const double weight = weightOf(i - at[0]) * weightOf(j - at[1]) * weightOf(k - at[2]);
        sum += weight;
        first += weight * p;
        second += weight * p * p.transpose();
      }
    }
  if (sum < 0.5)
    return {};
  const Vector3d center = first / sum;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(second / sum - center * center.transpose());
  const Vector3d spread = solver.eigenvalues() / (kSigma * kSigma); // ascending
  const Vector3d across = solver.eigenvectors().col(0);
  const Vector3d along = solver.eigenvectors().col(2);
  const double off = std::abs(across.dot(center));
  const double aside = (center - across.dot(center) * across).norm();
  const double sheet =
      ramp(0.35, 0.2, spread[0]) * ramp(0.4, 0.6, spread[1]) * ramp(0.7, 0.4, aside);
  if (sheet > 0.0)
  {
    const double half =
        0.5 * sum / (2.0 * kPi * kSigma * kSigma) * std::exp(0.5 * off * off / (kSigma * kSigma));
    return {sheet * ramp(1.1 * kThickest, kThickest, half), std::max(half, kThinnestSheet) - off};
  }
  const double beyond = std::abs(along.dot(center));
  const double away = (center - along.dot(center) * along).norm();
  const double rod =
      ramp(0.35, 0.25, spread[1]) * ramp(0.4, 0.6, spread[2]) * ramp(0.7, 0.4, beyond);
  const double radius = std::sqrt(sum / (std::sqrt(2.0 * kPi) * kSigma) / kPi *
                                  std::exp(0.5 * away * away / (kSigma * kSigma)));
  return {rod * ramp(1.1 * kThickest, kThickest, radius), std::max(radius, kThinnestRod) - away};
}

} // namespace

// A voxel's fit reads only `inside`, and changes only its own occupancy.
void SurfaceNet::fitThin(const OccupancyView& occupancy, const core::IndexBox& target,
                         const std::vector<std::size_t>& thinPoints) const
{
  std::vector<core::Index3> voxels;
  for (const std::size_t n : thinPoints)
    for (int corner = 0; corner < 8; ++corner)
      if (const core::Index3 voxel = voxelOf(m_points[n].cell, corner); target.contains(voxel))
        voxels.push_back(voxel);
  tbb::parallel_sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range)
                    {
                      for (std::size_t n = range.begin(); n < range.end(); ++n)
                      {
                        const core::Index3& voxel = voxels[n];
                        const Fit fit = fitAround(m_inside, voxel);
                        if (!(fit.weight > 0.0))
                          continue;
                        float& value = occupancy.at(voxel);
                        const double own = depthOf(value);
                        value = occupancyOf(own + fit.weight * (fit.depth - own));
                      }
                    });
}

} // namespace petrous::volume
