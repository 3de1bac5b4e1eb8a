#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Volume/Sampling.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

volume::Volume<float> linearVolume(const core::GridGeometry& grid, const Vector3d& slope)
{
  volume::Volume<float> v(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        v.at(i, j, k) =
            static_cast<float>(slope.dot(grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k})));
  return v;
}

core::GridGeometry oblique()
{
  const Eigen::Matrix3d direction =
      Eigen::AngleAxisd(0.7, Vector3d(1, -1, 2).normalized()).toRotationMatrix();
  return {{9, 9, 9}, {0.4, 0.5, 1.2}, {10, -20, 30}, direction};
}

} // namespace

TEST(Sampling, IsExactOnATrilinearFunction)
{
  const core::GridGeometry grid({5, 6, 7}, Vector3d::Ones(), Vector3d::Zero());
  volume::Volume<float> v(grid);
  const auto f = [](double x, double y, double z) { return 1 + x - 2 * y + 0.5 * x * y * z; };
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 5; ++i)
        v.at(i, j, k) = static_cast<float>(f(i, j, k));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 200; ++n)
  {
    const Vector3d p(4 * unit(random), 5 * unit(random), 6 * unit(random));
    EXPECT_NEAR(volume::sampleTrilinear(v, p), f(p[0], p[1], p[2]), 1e-4);
  }
}

// Against the sum over the corners that defines the interpolation, and its differences: f is linear
// along each axis, so these are exact.
TEST(Sampling, CellIsTheWeightedSumOfItsCorners)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 200; ++n)
  {
    volume::CellCorners<double> c{};
    for (double& value : c)
      value = 20.0 * unit(random) - 10.0;
    const auto sum = [&c](const Vector3d& w)
    {
      double value = 0.0;
      for (std::size_t corner = 0; corner < 8; ++corner)
        value += c[corner] * (corner & 1 ? w[0] : 1.0 - w[0]) * (corner & 2 ? w[1] : 1.0 - w[1]) *
                 (corner & 4 ? w[2] : 1.0 - w[2]);
      return value;
    };
    const Vector3d w(unit(random), unit(random), unit(random));
    EXPECT_NEAR(volume::interpolateCell(c, w[0], w[1], w[2]), sum(w), 1e-13);
    const Vector3d slope = volume::gradientInCell(c, w[0], w[1], w[2]);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      Vector3d low = w, high = w;
      low[axis] = 0.0;
      high[axis] = 1.0;
      EXPECT_NEAR(slope[axis], sum(high) - sum(low), 1e-12);
    }
  }
}

TEST(Sampling, ReachesTheLastVoxelAndClampsBeyond)
{
  volume::Volume<short> v(core::GridGeometry({2, 1, 3}, Vector3d::Ones(), Vector3d::Zero()));
  short n = 0;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 2; ++i)
      v.at(i, 0, k) = n++;
  EXPECT_DOUBLE_EQ(volume::sampleTrilinear(v, {1, 0, 2}), 5.0);
  EXPECT_DOUBLE_EQ(volume::sampleTrilinear(v, {99, 99, 99}), 5.0);
  EXPECT_DOUBLE_EQ(volume::sampleTrilinear(v, {0.5, 0, 1}), 2.5);
}

TEST(Sampling, GradientOfALinearFieldIsItsSlopeInPatientAxes)
{
  const core::GridGeometry grid = oblique();
  const Vector3d slope(3.0, -1.0, 2.0);
  const auto v = linearVolume(grid, slope);
  EXPECT_LT((volume::sampleGradient(v, {4.2, 3.3, 5.1}) - slope).norm(), 1e-3);
  EXPECT_LT((volume::sampleGradient(v, {0.0, 8.0, 0.0}) - slope).norm(), 1e-3) << "at the border";
}

TEST(Sampling, EdgeGradientOfALinearFieldIsItsSlopeInPatientAxes)
{
  const core::GridGeometry grid = oblique();
  const Vector3d slope(3.0, -1.0, 2.0);
  const auto v = linearVolume(grid, slope);
  const auto at = [&](const Vector3d& p) { return volume::sampleTrilinear(v, p); };
  for (const Vector3d& p : {Vector3d(4.2, 3.3, 5.1), Vector3d(0.0, 8.0, 0.3)})
    EXPECT_LT((volume::edgeGradientInPatient(grid, p, at) - slope).norm(), 1e-3) << p.transpose();
  const core::GridGeometry slice({9, 9, 1}, Vector3d::Ones(), Vector3d::Zero());
  const auto flat = linearVolume(slice, slope);
  EXPECT_LT((volume::edgeGradientInPatient(slice, {4, 4, 0},
                                           [&](const Vector3d& p)
                                           { return volume::sampleTrilinear(flat, p); }) -
             Vector3d(3.0, -1.0, 0.0))
                .norm(),
            1e-5);
}

// A plane border of bone and air, as sharp as in a scan (a Gaussian of 0.4 voxel): on its
// isosurface the normal oscillates as the border moves from voxel to voxel.
TEST(Sampling, EdgeGradientSwingsHalfAsMuchOnASharpBorder)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  for (const double tilt : {0.05, 0.15, 0.3})
  {
    const Vector3d normal = Vector3d(tilt, 0.6 * tilt, 1.0).normalized();
    volume::Volume<float> v(grid);
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
        {
          const double d = normal.dot(Vector3d(i, j, k) - Vector3d::Constant(19.7));
          v.at(i, j, k) =
              static_cast<float>(-1000.0 + 2800.0 * 0.5 * std::erfc(d / (0.4 * std::sqrt(2.0))));
        }
    const auto at = [&](const Vector3d& p) { return volume::sampleTrilinear(v, p); };
    double central = 0.0;
    double edges = 0.0;
    for (double i = 8.0; i < 32.0; i += 0.37)
      for (double j = 8.0; j < 32.0; j += 0.73)
      {
        Vector3d p(i, j, 0.0);
        double low = 2.0;
        double high = 37.0;
        while (high - low > 1e-4)
        {
          p.z() = 0.5 * (low + high);
          (at(p) > 300.0 ? low : high) = p.z();
        }
        const auto squaredSine = [&](const Vector3d& gradient)
        { return gradient.normalized().cross(normal).squaredNorm(); };
        central += squaredSine(volume::gradientInPatient(grid, p, 1.0, at));
        edges += squaredSine(volume::edgeGradientInPatient(grid, p, at));
      }
    EXPECT_LT(std::sqrt(edges), 0.6 * std::sqrt(central)) << tilt;
  }
}

TEST(Volume, SharesTheMemoryItAdopts)
{
  auto memory = std::shared_ptr<short>(new short[8](), std::default_delete<short[]>());
  const std::weak_ptr<short> watch = memory;
  {
    const volume::Volume<short> v(core::GridGeometry({2, 2, 2}, Vector3d::Ones(), Vector3d::Zero()),
                                  std::move(memory));
    EXPECT_EQ(v.data(), watch.lock().get());
  }
  EXPECT_TRUE(watch.expired());
}
