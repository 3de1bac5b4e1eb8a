// The surface of a label against the shape from which it was drawn.

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

using Distance = std::function<double(const Vector3d&)>; // in voxels, negative inside

class Label
{
public:
  /// The voxels whose centres are inside, or all that the shape touches.
  Label(int size, const Distance& distance, bool touched = false)
    : m_grid({size, size, size}, Vector3d::Constant(0.3), Vector3d::Constant(-0.15 * (size - 1)))
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(m_grid, std::uint16_t{0});
    for (int k = 0; k < size; ++k)
      for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
          voxels->at(i, j, k) = isIn(inVoxels(i, j, k), distance, touched) ? 1 : 0;
    m_voxels = voxels;
    m_occupancy = volume::makeSmoothedUnion(volume::makeLabelMap(voxels, {}),
                                            [](std::uint16_t) { return true; });
  }

  /// All positions below are in voxels from the centre.
  bool inside(const Vector3d& p) const
  {
    const Vector3d voxel = m_occupancy->geometry().voxelFromPatient(0.3 * p);
    return m_occupancy->geometry().hullContains(voxel) &&
           volume::sampleTrilinear(*m_occupancy, voxel) > 0.5;
  }

  Vector3d outward(const Vector3d& p) const
  {
    return -volume::sampleGradient(*m_occupancy, m_occupancy->geometry().voxelFromPatient(0.3 * p),
                                   1.0)
                .normalized();
  }

  /// Length inside of the line through p, up to 5 voxels to both sides.
  double along(const Vector3d& p, const Vector3d& direction) const
  {
    constexpr int n = 500;
    int count = 0;
    for (int s = 0; s < n; ++s)
      count += inside(p + direction * (10.0 * (s + 0.5) / n - 5.0)) ? 1 : 0;
    return 10.0 * count / n;
  }

  /// Number of the label's voxels for which `wanted` holds.
  int count(const std::function<bool(const Vector3d&)>& wanted) const
  {
    int voxels = 0;
    const core::Index3 n = m_grid.dims();
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          voxels += m_voxels->at(i, j, k) != 0 && wanted(inVoxels(i, j, k)) ? 1 : 0;
    return voxels;
  }

  /// Distance of the surface beyond p along the normal of the shape, up to 2 voxels.
  double beyond(const Vector3d& p, const Vector3d& normal) const
  {
    double in = -2.0;
    double out = 2.0;
    EXPECT_TRUE(inside(p + in * normal));
    EXPECT_FALSE(inside(p + out * normal));
    while (out - in > 1e-3)
    {
      const double middle = 0.5 * (in + out);
      (inside(p + middle * normal) ? in : out) = middle;
    }
    return in;
  }

private:
  Vector3d inVoxels(double i, double j, double k) const
  {
    return m_grid.patientFromVoxel({i, j, k}) / 0.3;
  }

  static bool isIn(const Vector3d& center, const Distance& distance, bool touched)
  {
    if (!touched)
      return distance(center) < 0.0;
    for (int n = 0; n < 125; ++n)
      if (distance(center + 0.2 * Vector3d(n % 5 - 2, n / 5 % 5 - 2, n / 25 - 2)) < 0.0)
        return true;
    return false;
  }

  core::GridGeometry m_grid;
  std::shared_ptr<const volume::Volume<std::uint16_t>> m_voxels;
  std::shared_ptr<const volume::Volume<float>> m_occupancy;
};

struct Error
{
  double bias = 0.0;  // voxels
  double angle = 0.0; // degrees, RMS
};

// Error of a label's surface at points of the shape.
template <class Pick>
Error errorOf(const Label& label, const Pick& pick)
{
  std::mt19937 random(3);
  Error error;
  constexpr int n = 1500;
  for (int s = 0; s < n; ++s)
  {
    const auto [point, normal] = pick(random);
    const double off = label.beyond(point, normal);
    const double cosine = label.outward(point + off * normal).dot(normal);
    error.bias += off / n;
    error.angle += std::pow(std::acos(std::min(cosine, 1.0)), 2.0) / n;
  }
  error.angle = std::sqrt(error.angle) * 57.29578;
  return error;
}

using PointAndNormal = std::pair<Vector3d, Vector3d>;

// Directions of sheets and rods: axes, diagonals of faces and cells, and others.
const Vector3d kDirections[] = {{0, 0, 1}, {0.1, 0.05, 1},   {0.25, 0.1, 1},    {1, 1, 0},
                                {1, 1, 1}, {0.3, 0.6, 0.75}, {0.88, 0.28, 0.38}};

Vector3d across(const Vector3d& direction, double angle)
{
  const Vector3d a = direction.unitOrthogonal();
  return std::cos(angle) * a + std::sin(angle) * direction.cross(a);
}

} // namespace

// The binomial filter [1 2 1]/4 has 5 to 10 degrees here.
TEST(SmoothedUnion, HasNoStepsOnPlanes)
{
  for (const double tilt : {7.0, 15.0, 30.0, 50.0})
  {
    const double t = tilt / 57.29578;
    const Vector3d normal(std::sin(t) * std::cos(0.7), std::sin(t) * std::sin(0.7), std::cos(t));
    const Label label(60, [&](const Vector3d& p) { return p.dot(normal) - 0.13; });
    std::uniform_real_distribution<double> way(-13.0, 13.0);
    const Error error =
        errorOf(label,
                [&](std::mt19937& random)
                {
                  return PointAndNormal{0.13 * normal + way(random) * across(normal, 0.0) +
                                            way(random) * across(normal, 1.5708),
                                        normal};
                });
    EXPECT_LT(error.angle, 2.5) << tilt;
    EXPECT_NEAR(error.bias, 0.0, 0.05) << tilt;
  }
}

TEST(SmoothedUnion, ShrinksNeitherBallsNorTubes)
{
  for (const double radius : {3.0, 6.0, 15.0})
  {
    const Vector3d center(0.2, -0.3, 0.1);
    const Label ball(static_cast<int>(2 * radius) + 10,
                     [&](const Vector3d& p) { return (p - center).norm() - radius; });
    const Error ofBall = errorOf(ball,
                                 [&](std::mt19937& random)
                                 {
                                   std::normal_distribution<double> any;
                                   const double x = any(random);
                                   const double y = any(random);
                                   const Vector3d n = Vector3d(x, y, any(random)).normalized();
                                   return PointAndNormal{center + radius * n, n};
                                 });
    EXPECT_NEAR(ofBall.bias, 0.0, 0.03) << radius;
    EXPECT_LT(ofBall.angle, radius < 5.0 ? 5.0 : 3.0) << radius;
    const Vector3d axis = Vector3d(1.0, 0.3, 0.2).normalized();
    const Label tube(static_cast<int>(2 * radius) + 30,
                     [&](const Vector3d& p) { return p.cross(axis).norm() - radius; });
    const Error ofTube = errorOf(tube,
                                 [&](std::mt19937& random)
                                 {
                                   std::uniform_real_distribution<double> any(-1.0, 1.0);
                                   const Vector3d n = across(axis, 3.14159 * any(random));
                                   return PointAndNormal{9.0 * any(random) * axis + radius * n, n};
                                 });
    EXPECT_NEAR(ofTube.bias, 0.0, 0.03) << radius;
    EXPECT_LT(ofTube.angle, 3.0) << radius;
  }
}

// A sheet of half a voxel is not closed in voxels whose centres are inside, so it is drawn from all
// voxels that it touches. Reference is the thickness of the label: its volume over the area.
TEST(SmoothedUnion, KeepsSheetsClosedAndAtTheirThickness)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> way(-12.0, 12.0);
  for (const double thickness : {0.5, 1.0, 1.5, 2.0, 3.0})
    for (const Vector3d& direction : kDirections)
    {
      const Vector3d normal = direction.normalized();
      const bool touched = thickness < 1.0;
      const Label label(
          44, [&](const Vector3d& p) { return std::abs(p.dot(normal) - 0.13) - 0.5 * thickness; },
          touched);
      double mean = 0.0;
      constexpr int n = 600;
      for (int s = 0; s < n; ++s)
      {
        const Vector3d p = 0.13 * normal + way(random) * across(normal, 0.0) +
                           way(random) * across(normal, 1.5708);
        const double length = label.along(p, normal);
        ASSERT_GT(length, 0.0) << thickness << " across " << direction.transpose();
        mean += length / n;
      }
      const double voxels = label.count(
          [&](const Vector3d& p)
          {
            return std::abs(p.dot(across(normal, 0.0))) <= 12.0 &&
                   std::abs(p.dot(across(normal, 1.5708))) <= 12.0;
          });
      EXPECT_NEAR(mean, voxels / (24.0 * 24.0), 0.4)
          << thickness << " across " << direction.transpose();
      if (!touched && std::abs(normal.z()) < 0.9999) // otherwise it has an integer number of layers
      {
        EXPECT_NEAR(mean, thickness, 0.35) << thickness << " across " << direction.transpose();
      }
    }
}

TEST(SmoothedUnion, KeepsRodsWholeAndAtTheirThickness)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> way(-12.0, 12.0);
  std::uniform_real_distribution<double> turn(0.0, 6.283);
  for (const double thickness : {0.5, 1.0, 1.5, 2.0, 3.0})
    for (const Vector3d& direction : kDirections)
    {
      const Vector3d axis = direction.normalized();
      const bool touched = thickness < 1.5; // the centres inside do not form a connected rod
      const Label label(
          44,
          [&](const Vector3d& p)
          { return (p - Vector3d(0.13, 0.08, -0.1)).cross(axis).norm() - 0.5 * thickness; },
          touched);
      double area = 0.0;
      constexpr int n = 600;
      for (int s = 0; s < n; ++s)
      {
        const Vector3d p = Vector3d(0.13, 0.08, -0.1) + way(random) * axis;
        const double length = label.along(p, across(axis, turn(random)));
        ASSERT_GT(length, 0.0) << thickness << " along " << direction.transpose();
        area += length * length / n;
      }
      // A round rod with the label's volume.
      const double voxels =
          label.count([&](const Vector3d& p) { return std::abs(p.dot(axis)) <= 12.0; });
      EXPECT_NEAR(std::sqrt(area), std::sqrt(4.0 / 3.14159 * voxels / 24.0), 0.45)
          << thickness << " along " << direction.transpose();
    }
}

// Rods, sheets and single voxels one voxel thin, touching by faces, edges and corners.
TEST(SmoothedUnion, IsTheSameForAnyNumberOfThreads)
{
  std::mt19937 random(3);
  std::uniform_int_distribution<int> among(0, 23);
  const core::GridGeometry grid({96, 96, 96}, Vector3d::Constant(0.3), Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 2; k < 94; ++k)
    for (int j = 2; j < 94; ++j)
      for (int i = 2; i < 94; ++i)
      {
        const bool rod = (i + 2 * j) % 31 == 0 && (k + j) % 17 == 0;
        const bool sheet = (i + j + 3 * k) % 47 == 0;
        voxels->at(i, j, k) = rod || sheet || among(random) == 0 ? 1 : 0;
      }
  const volume::LabelMap labels = volume::makeLabelMap(voxels, {});
  const auto smoothed = [&labels](int threads)
  {
    const tbb::global_control most(tbb::global_control::max_allowed_parallelism,
                                   static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    std::shared_ptr<const volume::Volume<float>> occupancy;
    arena.execute(
        [&] { occupancy = volume::makeSmoothedUnion(labels, [](std::uint16_t) { return true; }); });
    return occupancy;
  };
  const auto alone = smoothed(1);
  for (const int threads : {2, 5})
  {
    const auto occupancy = smoothed(threads);
    ASSERT_EQ(occupancy->size(), alone->size());
    EXPECT_EQ(std::memcmp(occupancy->data(), alone->data(), occupancy->size() * sizeof(float)), 0);
  }
}
