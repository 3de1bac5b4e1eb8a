#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "petrous/Core/RigidTransform.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::registration::testing
{

using Eigen::Vector3d;

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Samples a scalar function of patient points on a grid.
template <class T = float>
std::shared_ptr<const volume::IntensityVolume>
imageOf(const core::GridGeometry& grid, const std::function<double(const Vector3d&)>& value,
        double noise = 0.0, unsigned seed = 1)
{
  auto voxels = std::make_shared<volume::Volume<T>>(grid);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        voxels->at(i, j, k) = static_cast<T>(value(grid.patientFromVoxel(Vector3d(i, j, k))) +
                                             (noise > 0.0 ? noise * normal(random) : 0.0));
  return std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<T>>(std::move(voxels)));
}

/// Soft indicator of an ellipsoid: 1 inside, 0 outside, over a transition of about 1 mm.
inline double ellipsoid(const Vector3d& p, const Vector3d& centre, const Vector3d& radii)
{
  const double depth = (1.0 - (p - centre).cwiseQuotient(radii).norm()) * radii.minCoeff();
  return 1.0 / (1.0 + std::exp(-4.0 * depth));
}

/// An asymmetric head of about 120 mm: skin, skull, brain with a few fluid spaces, and air
/// cavities. Values of a CT (HU), and of a T1 and a T2 MR of it.
class Head
{
public:
  struct Tissue
  {
    double ct, t1, t2;
  };

  double ct(const Vector3d& p) const
  {
    return mixed(p, [](const Tissue& t) { return t.ct; });
  }
  double t1(const Vector3d& p) const
  {
    return mixed(p, [](const Tissue& t) { return t.t1; });
  }
  double t2(const Vector3d& p) const
  {
    return mixed(p, [](const Tissue& t) { return t.t2; });
  }

private:
  struct Part
  {
    Vector3d centre, radii;
    Tissue tissue;
  };

  template <class Pick>
  double mixed(const Vector3d& p, const Pick& pick) const
  {
    double value = pick(kAir);
    for (const Part& part : kParts)
    {
      const double share = ellipsoid(p, part.centre, part.radii);
      value += share * (pick(part.tissue) - value);
    }
    return value;
  }

  static constexpr Tissue kAir{-1000.0, 5.0, 5.0};
  const std::vector<Part> kParts{
      {{0, 0, 0}, {55, 65, 48}, {60.0, 700.0, 300.0}},   // skin
      {{0, 2, 1}, {49, 59, 43}, {1100.0, 40.0, 30.0}},   // skull
      {{0, 3, 3}, {43, 53, 37}, {40.0, 450.0, 400.0}},   // brain
      {{-10, 8, 8}, {9, 16, 8}, {5.0, 150.0, 900.0}},    // fluid
      {{13, -7, 12}, {7, 9, 12}, {5.0, 150.0, 900.0}},   // fluid
      {{22, 20, -12}, {10, 8, 7}, {900.0, 60.0, 40.0}},  // petrous bone
      {{-24, 14, -10}, {8, 12, 6}, {900.0, 60.0, 40.0}}, // and the contralateral one
      {{24, 22, -13}, {4, 3, 3}, {-900.0, 5.0, 5.0}},    // a middle ear
      {{5, -45, -20}, {11, 9, 9}, {-900.0, 5.0, 5.0}},   // a sinus
      {{15, 30, 10}, {6, 7, 5}, {70.0, 620.0, 350.0}},   // a tumour
  };
};

/// A grid centred at a point.
inline core::GridGeometry gridAbout(const Vector3d& centre, const Vector3d& extent,
                                    const Vector3d& spacing,
                                    const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity())
{
  core::Index3 dims{};
  Vector3d half;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    dims[a] = static_cast<int>(std::lround(extent[axis] / spacing[axis]));
    half[axis] = 0.5 * spacing[axis] * (dims[a] - 1);
  }
  return {dims, spacing, centre - axes * half, axes};
}

inline core::RigidTransform motion(const Vector3d& about, double millimetres, double degrees,
                                   const Vector3d& axis = {0.3, -0.5, 0.8})
{
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(degrees * kDegree, axis.normalized()));
  const Vector3d by = millimetres * Vector3d(0.6, 0.64, -0.48).normalized();
  return {turn, about + by - turn * about};
}

} // namespace petrous::registration::testing
