#include <cmath>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Presenters/StructureShape.h"

using namespace petrous;
using namespace petrous::presenters;
using namespace petrous::presenters::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.141592653589793;

core::GridGeometry cube(double edge, double voxel, const Vector3d& spacing = Vector3d::Ones())
{
  const Vector3d step = voxel * spacing;
  const auto count = [&](int axis) { return static_cast<int>(edge / step[axis]) + 1; };
  return {{count(0), count(1), count(2)}, step, Vector3d::Constant(-0.5 * edge)};
}

} // namespace

TEST(PrincipalBox, IsTheDiameterOfABallAlongEachAxis)
{
  const auto box = principalBox(*occupancyOf(cube(20, 0.5), ball({1, -2, 0.5}, 6.0)));
  ASSERT_TRUE(box);
  // Half of a voxel's share bends inwards where the surface is curved: by h^2 / (24 R) and what the
  // lattice misses of the very tip, h^2 / (4 R), at each end.
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(box->extents[a], 12.0, 0.2);
  EXPECT_NEAR((box->center - Vector3d(1, -2, 0.5)).norm(), 0.0, 0.02);
}

TEST(PrincipalBox, FindsLengthAndWidthsOfAnObliqueCylinder)
{
  const Vector3d axis = Vector3d(2, 1, -1).normalized();
  const auto box = principalBox(
      *occupancyOf(cube(30, 0.4, {1, 1, 1.5}), cylinder(-9.0 * axis, 9.0 * axis, 3.0)));
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->extents[0], 18.0, 0.4);
  EXPECT_NEAR(box->extents[1], 6.0, 0.3);
  EXPECT_NEAR(box->extents[2], 6.0, 0.3);
  EXPECT_NEAR(std::abs(box->axes.col(0).dot(axis)), 1.0, 1e-3);
}

TEST(CentreLine, OfAStraightTubeIsItsAxis)
{
  for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(1, 2, 3)})
    for (const double radius : {1.0, 2.5})
    {
      const Vector3d axis = direction.normalized();
      const auto line =
          centreLine(*occupancyOf(cube(26, 0.4), cylinder(-10.0 * axis, 10.0 * axis, radius)));
      ASSERT_TRUE(line) << radius;
      EXPECT_NEAR(line->length(), 20.0, 0.25) << radius << " " << direction.transpose();
      for (const Vector3d& point : line->points)
        EXPECT_LT((point - axis.dot(point) * axis).norm(), 0.1);
      for (const double diameter : line->diameters)
        EXPECT_NEAR(diameter, 2.0 * radius, 0.08 * 2.0 * radius);
    }
}

// The bend of a nerve's genu: half a torus of 5 mm, whose line is not drawn inwards.
TEST(CentreLine, OfABentTubeFollowsIt)
{
  constexpr double kBend = 5.0, kRadius = 1.0;
  const auto isInside = [](const Vector3d& at)
  {
    const double across = std::hypot(at.x(), at.y()) - kBend;
    return at.y() > 0.0 && std::hypot(across, at.z()) < kRadius;
  };
  const auto line = centreLine(*occupancyOf(cube(16, 0.25), isInside));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->length(), kPi * kBend, 0.02 * kPi * kBend);
  // Between two places on it a quarter of the circle.
  const auto part = partOf(*line, {kBend / std::sqrt(2.0), kBend / std::sqrt(2.0), 0.3},
                           {-kBend / std::sqrt(2.0), kBend / std::sqrt(2.0), -0.3});
  double length = 0.0;
  for (std::size_t n = 1; n < part.size(); ++n)
    length += (part[n] - part[n - 1]).norm();
  EXPECT_NEAR(length, 0.5 * kPi * kBend, 0.03 * kPi * kBend);
  EXPECT_GT(part.front().x(), part.back().x());
}

TEST(CentreLine, OfABallIsNone)
{
  EXPECT_FALSE(centreLine(*occupancyOf(cube(20, 0.5), ball({0, 0, 0}, 6.0))));
  EXPECT_FALSE(centreLine(*occupancyOf(cube(4, 0.5), [](const Vector3d&) { return false; })));
}

// Along the middle of the hole it would lie where there is nothing of the structure.
TEST(CentreLine, OfARingOrAcrossAHoleIsRefusedInWords)
{
  const auto ring = [](double bend, double radius)
  {
    return [=](const Vector3d& at)
    { return std::hypot(std::hypot(at.x(), at.y()) - bend, at.z()) < radius; };
  };
  const auto bar = [](const Vector3d& at, double half)
  { return std::abs(at.x()) < half && std::abs(at.y()) < 2.0 && std::abs(at.z()) < 1.0; };
  const auto pierced = [&](const Vector3d& at)
  { return bar(at, 8.0) && std::hypot(at.x(), at.y()) > 1.2; };
  const auto pipe = [](const Vector3d& at)
  {
    return std::abs(at.x()) < 8.0 && std::hypot(at.y(), at.z()) < 2.5 &&
           std::hypot(at.y(), at.z()) > 1.5;
  };
  const auto whyNot = [](const Inside& isInside)
  {
    std::string why;
    EXPECT_FALSE(centreLine(*occupancyOf(cube(18, 0.25), isInside), {}, &why));
    return why;
  };
  EXPECT_NE(whyNot(ring(6.0, 1.0)).find("ring"), std::string::npos);
  EXPECT_NE(whyNot(ring(2.2, 1.2)).find("ring"), std::string::npos);
  EXPECT_NE(whyNot(pierced).find("hole"), std::string::npos);
  EXPECT_NE(whyNot(pipe).find("hollow"), std::string::npos);
  EXPECT_NE(whyNot(ball({0, 0, 0}, 6.0)).find("too short"), std::string::npos);
  // Without the hole the bar is a tube.
  const auto whole = [&](const Vector3d& at) { return bar(at, 8.0); };
  std::string why;
  const auto line = centreLine(*occupancyOf(cube(18, 0.25), whole), {}, &why);
  ASSERT_TRUE(line) << why;
  EXPECT_NEAR(line->length(), 16.0, 0.3);
  EXPECT_EQ(why, "");
  // Nor does a hole of three voxels make it none.
  const auto pricked = [&](const Vector3d& at)
  { return bar(at, 8.0) && std::hypot(at.x(), at.y()) > 0.4; };
  const auto past = centreLine(*occupancyOf(cube(18, 0.25), pricked), {}, &why);
  ASSERT_TRUE(past) << why;
  // It goes past the hole in the middle of what is left beside it, 1.2 mm off, and back.
  EXPECT_GT(past->length(), 16.0 - 0.3);
  EXPECT_LT(past->length(), 16.0 + 2.0 * 1.2);
}

// From end to end along the longer branch, not between the two.
TEST(CentreLine, OfWhatBranchesStaysInIt)
{
  const auto stem = cylinder({-9, 0, 0}, {0, 0, 0}, 1.0);
  const auto one = cylinder({-0.5, 0, 0}, {7, 6, 0}, 1.0);
  const auto other = cylinder({-0.5, 0, 0}, {6, -5.5, 0}, 1.0);
  const auto occupancy = occupancyOf(cube(20, 0.25), [&](const Vector3d& at)
                                     { return stem(at) || one(at) || other(at); });
  const auto line = centreLine(*occupancy);
  ASSERT_TRUE(line);
  EXPECT_GT((line->points.front() - line->points.back()).norm(), 11.0);
  for (const Vector3d& point : line->points)
  {
    const bool isBetween = point.x() > 3.0 && std::abs(point.y()) < 1.0;
    EXPECT_FALSE(isBetween) << point.transpose();
  }
}

TEST(CentreLine, IsGivenUpWhenAsked)
{
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(centreLine(*occupancyOf(cube(10, 0.5), cylinder({-4, 0, 0}, {4, 0, 0}, 1.0)),
                          core::Progress(nullptr, token)),
               core::CancelledError);
}

TEST(CentreLine, OfSeveralPiecesIsThatOfTheLargest)
{
  const auto line = centreLine(*occupancyOf(
      cube(26, 0.5), [tube = cylinder({-8, 0, 0}, {8, 0, 0}, 1.5),
                      crumb = cylinder({-8, 8, 0}, {-2, 8, 0}, 1.0)](const Vector3d& at)
      { return tube(at) || crumb(at); }));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->length(), 16.0, 0.4);
}

// The phantom's facial nerve runs along a polyline that is known.
TEST(CentreLine, OfThePhantomsFacialNerveIsItsCanalsAxis)
{
  const phantom::Phantom patient;
  const std::size_t nerve = patient.indexOf("facial_nerve");
  const auto& structure = patient.structures()[nerve];
  const Vector3d size = structure.upper - structure.lower + Vector3d::Constant(2.0);
  constexpr double kVoxel = 0.4;
  const core::GridGeometry grid(
      {static_cast<int>(size[0] / kVoxel) + 1, static_cast<int>(size[1] / kVoxel) + 1,
       static_cast<int>(size[2] / kVoxel) + 1},
      Vector3d::Constant(kVoxel), structure.lower - Vector3d::Constant(1.0));
  const auto occupancy = occupancyOf(grid, [&](const Vector3d& at)
                                     { return patient.signedDistance(nerve, at) < 0.0; });
  const auto line = centreLine(*occupancy);
  ASSERT_TRUE(line);
  // The nerve goes on beyond both ends of its canal: those parts are left out.
  const auto axis = phantom::Phantom::facialCanalAxis();
  double off = 0.0, within = 0.0, length = 0.0;
  std::size_t count = 0;
  for (std::size_t p = 1; p < line->points.size(); ++p)
  {
    double best = 1e9;
    bool isBeyond = true;
    for (std::size_t n = 1; n < axis.size(); ++n)
    {
      const Vector3d edge = axis[n].position - axis[n - 1].position;
      const double along = (line->points[p] - axis[n - 1].position).dot(edge) / edge.squaredNorm();
      const double share = std::clamp(along, 0.0, 1.0);
      const double away = (axis[n - 1].position + share * edge - line->points[p]).norm();
      if (away >= best)
        continue;
      best = away;
      isBeyond = (n == 1 && along < 0.0) || (n + 1 == axis.size() && along > 1.0);
    }
    if (isBeyond)
      continue;
    off += best;
    within += (line->points[p] - line->points[p - 1]).norm();
    ++count;
  }
  for (std::size_t n = 1; n < axis.size(); ++n)
    length += (axis[n].position - axis[n - 1].position).norm();
  ASSERT_GT(count, 30U);
  EXPECT_LT(off / static_cast<double>(count), 0.25);
  EXPECT_NEAR(within, length, 0.06 * length);
}

TEST(ShortestWay, IsTheGapBetweenTwoBalls)
{
  const auto grid = cube(30, 0.5);
  const auto a = occupancyOf(grid, ball({-7, 0, 0}, 4.0));
  const auto b = occupancyOf(grid, ball({5, 3, 1}, 3.0));
  const double gap = Vector3d(12, 3, 1).norm() - 7.0;
  const auto way = shortestWay(*a, volume::SurfaceDistance(b));
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->distance, gap, 0.15); // voxels of 0.5 mm: see shortestWay
  EXPECT_NEAR((way->to - way->from).norm(), way->distance, 0.02);
  EXPECT_NEAR((way->from - Vector3d(-7, 0, 0)).norm(), 4.0, 0.08);
  EXPECT_NEAR((way->to - Vector3d(5, 3, 1)).norm(), 3.0, 0.08);
  const auto back = shortestWay(*b, volume::SurfaceDistance(a));
  EXPECT_NEAR(back->distance, gap, 0.15);
}

TEST(ShortestWay, IsNoneBetweenWhatTouches)
{
  const auto grid = cube(20, 0.5);
  const auto way = shortestWay(*occupancyOf(grid, ball({-2, 0, 0}, 4.0)),
                               volume::SurfaceDistance(occupancyOf(grid, ball({2, 0, 0}, 4.0))));
  ASSERT_TRUE(way);
  EXPECT_EQ(way->distance, 0.0);
}
