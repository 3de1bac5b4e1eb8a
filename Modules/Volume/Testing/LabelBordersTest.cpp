#include "petrous/Volume/LabelBorders.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "LabelPainting.h"

using namespace petrous;
using namespace petrous::volume;
using namespace petrous::testing;

namespace
{

using Eigen::Vector3d;

std::shared_ptr<const LabelField> fieldOf(const Labels& labels, int count)
{
  std::vector<LabelSource> sources;
  for (int n = 1; n <= count; ++n)
    sources.push_back({labels, static_cast<std::uint16_t>(n), static_cast<std::uint8_t>(n), true});
  return makeLabelField(sources);
}

int structureOf(const LabelField& field, const Vector3d& patient)
{
  return structureAt(*field.index, field.borders.get(),
                     field.index->geometry().voxelFromPatient(patient))
      .index;
}

// Where structure 2 changes to structure 1 along the direction, mm from `from`; by bisection.
double borderOnTheWay(const LabelField& field, const Vector3d& from, const Vector3d& direction,
                      double farthest)
{
  double low = 0.0;
  double high = farthest;
  while (high - low > 1e-4)
  {
    const double middle = 0.5 * (low + high);
    (structureOf(field, from + middle * direction) == 2 ? low : high) = middle;
  }
  return low;
}

struct Error
{
  double mean = 0.0;
  double rms = 0.0;
};

template <class Distance>
Error errorOf(int lines, const Distance& distance)
{
  Error error;
  for (int n = 0; n < lines; ++n)
  {
    const double off = distance(n);
    error.mean += off / lines;
    error.rms += off * off / lines;
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

} // namespace

TEST(LabelBorders, AreNoneWhereNoTwoSolidsMeet)
{
  const core::GridGeometry grid = cube(24, 1.0);
  // Two slabs separated by two empty voxels, whose dilated indices meet.
  const Labels apart =
      paint(grid,
            [](const Vector3d& p) -> std::uint16_t {
              return std::abs(p.x()) > 8.0 || std::abs(p.x()) < 1.0 ? 0 : p.x() < 0.0 ? 1 : 2;
            });
  EXPECT_EQ(fieldOf(apart, 2)->borders, nullptr);
  const Labels touching = paint(grid,
                                [](const Vector3d& p) -> std::uint16_t {
                                  return p.norm() > 8.0 ? 0 : p.x() < 0.0 ? 1 : 2;
                                });
  EXPECT_NE(fieldOf(touching, 2)->borders, nullptr);
  EXPECT_EQ(makeLabelField({{touching, 1, 1, true}, {touching, 2, 2, false}})->borders, nullptr);
  EXPECT_EQ(makeLabelField({{touching, 1, 1, true}, {touching, 2, 1, true}})->borders, nullptr);
}

TEST(LabelBorders, LeaveEveryVoxelWithItsStructure)
{
  const core::GridGeometry grid = cube(24, 1.0);
  // Noise: neighbouring labels are independent.
  const Labels labels =
      paint(grid,
            [](const Vector3d& p) -> std::uint16_t
            {
              const double wave =
                  std::sin(12.9898 * p.x() + 78.233 * p.y() + 37.719 * p.z()) * 43758.5453;
              return p.norm() > 8.0
                         ? 0
                         : static_cast<std::uint16_t>(1.0 + 4.0 * (wave - std::floor(wave)));
            });
  const auto field = fieldOf(labels, 4);
  ASSERT_NE(field->borders, nullptr);
  int seen = 0;
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i)
        if (const int own = labels->voxels->at(i, j, k))
        {
          const Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
          EXPECT_EQ(structureOf(*field, p), own);
          ++seen;
        }
  EXPECT_GT(seen, 2000);
}

// A ball of two halves: the border is the plane between them, in any orientation to the voxels.
TEST(LabelBorders, LieOnThePlaneBetweenTwoHalves)
{
  const core::GridGeometry grid = cube(40, 1.0, {0.2, -0.1, 0.3});
  for (const Vector3d& along :
       {Vector3d(1.0, 0.0, 0.0), Vector3d(1.0, 0.12, 0.05), Vector3d(1.0, -0.4, 0.2),
        Vector3d(1.0, 0.9, 0.1), Vector3d(0.6, 1.0, -0.9)})
  {
    const Vector3d normal = along.normalized();
    const Labels labels = paint(grid,
                                [&](const Vector3d& p) -> std::uint16_t {
                                  return p.norm() > 16.0 ? 0 : p.dot(normal) > 0.0 ? 1 : 2;
                                });
    const auto field = fieldOf(labels, 2);
    const Vector3d u = normal.unitOrthogonal();
    const Vector3d v = normal.cross(u);
    const Error error = errorOf(400,
                                [&](int n)
                                {
                                  const Vector3d start = 0.9 * (n % 20 - 9.5) * u +
                                                         0.9 * (n / 20 - 9.5) * v - 3.0 * normal;
                                  return borderOnTheWay(*field, start, normal, 6.0) - 3.0;
                                });
    // A plane parallel to the voxel layers may be anywhere between two of them.
    EXPECT_LT(std::abs(error.mean), along.y() == 0.0 ? 0.5 : 0.1) << along.transpose();
    const double spread = std::sqrt(error.rms * error.rms - error.mean * error.mean);
    EXPECT_LT(spread, 0.15) << along.transpose(); // voxel faces have 0.29
  }
}

// A nerve through a tumour.
TEST(LabelBorders, LeaveARodWithinABallItsWidth)
{
  const core::GridGeometry grid = cube(40, 1.0, {0.2, -0.1, 0.3});
  const Vector3d axis = Vector3d(1.0, 0.35, -0.2).normalized();
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  for (const double radius : {3.5, 2.0, 1.2})
  {
    const Labels labels =
        paint(grid,
              [&](const Vector3d& p) -> std::uint16_t {
                return p.norm() > 16.0 ? 0 : p.cross(axis).norm() < radius ? 2 : 1;
              });
    const auto field = fieldOf(labels, 2);
    const Error error = errorOf(720,
                                [&](int n)
                                {
                                  const double turn = 0.1745329 * (n % 36);
                                  const Vector3d out = std::cos(turn) * u + std::sin(turn) * v;
                                  const Vector3d start = 1.2 * (n / 36 - 9.5) * axis;
                                  return borderOnTheWay(*field, start, out, 6.0) - radius;
                                });
    EXPECT_LT(std::abs(error.mean), 0.1) << radius;
    EXPECT_LT(error.rms, 0.2) << radius;
  }
}

TEST(LabelBorders, AreTheSameForAnyNumberOfThreads)
{
  const core::GridGeometry grid = cube(32, 1.0);
  const Labels labels =
      paint(grid,
            [](const Vector3d& p) -> std::uint16_t {
              return p.norm() > 12.0 ? 0 : p.x() < p.y() ? 1 : p.z() < 0.3 * p.y() ? 2 : 3;
            });
  const auto field = fieldOf(labels, 3);
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  const auto again = fieldOf(labels, 3);
  ASSERT_NE(field->borders, nullptr);
  EXPECT_EQ(std::memcmp(field->borders->data(), again->borders->data(), field->borders->size()), 0);
}

// A position belongs to the structure with the largest weight there.
TEST(LabelBorders, WhereThreeMeetBelongToOneOfThem)
{
  const core::GridGeometry grid = cube(24, 1.0);
  const Labels labels = paint(grid,
                              [](const Vector3d& p) -> std::uint16_t
                              {
                                const double turn = std::atan2(p.y() - 0.3, p.x() + 0.2);
                                return p.norm() > 9.0 ? 0 : turn < -1.0 ? 1 : turn < 1.1 ? 2 : 3;
                              });
  const auto field = fieldOf(labels, 3);
  int counts[4] = {0, 0, 0, 0};
  double wrong = 0.0;
  double all = 0.0;
  for (double z = -5.0; z <= 5.0; z += 0.37)
    for (double y = -5.0; y <= 5.0; y += 0.11)
      for (double x = -5.0; x <= 5.0; x += 0.11)
      {
        const double turn = std::atan2(y - 0.3, x + 0.2);
        const int own = structureOf(*field, {x, y, z});
        ASSERT_TRUE(own >= 1 && own <= 3);
        ++counts[own];
        wrong += own != (turn < -1.0 ? 1 : turn < 1.1 ? 2 : 3);
        ++all;
      }
  EXPECT_LT(wrong / all, 0.03); // three borders of 5 mm, each with an error of 0.1 mm
  for (int n = 1; n <= 3; ++n)
    EXPECT_GT(counts[n], 0.25 * all);
}
