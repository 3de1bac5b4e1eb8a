#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ProxyChecks.h"
#include "ShellChecks.h"
#include "petrous/Haptics/PointShell.h"

using namespace petrous;
using namespace petrous::haptics::checks;
using namespace petrous::haptics::testing;
using Eigen::Vector3d;
using haptics::makeInstrumentShell;
using haptics::PointShell;

namespace
{

constexpr double kPi = 3.14159265358979323846;

/// A cone of half angle `slope` (radius per mm) with its tip at the origin, closed by a disc at
/// z = `length`: long slivers and a fan, as a CAD program writes them.
core::TriangleMesh cone(double slope, double length, int sides = 48)
{
  core::TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0F, 0.0F, 0.0F);
  mesh.vertices.emplace_back(0.0F, 0.0F, static_cast<float>(length));
  for (int n = 0; n < sides; ++n)
  {
    const double turn = 2.0 * kPi * n / sides;
    mesh.vertices.push_back(
        Vector3d(slope * length * std::cos(turn), slope * length * std::sin(turn), length)
            .cast<float>());
  }
  for (int n = 0; n < sides; ++n)
  {
    const auto here = static_cast<std::uint32_t>(2 + n);
    const auto next = static_cast<std::uint32_t>(2 + (n + 1) % sides);
    mesh.triangles.push_back({0, next, here});
    mesh.triangles.push_back({1, here, next});
  }
  return mesh;
}

/// An axis-parallel box, corners counter-clockwise seen from outside.
void addBox(core::TriangleMesh& mesh, const Vector3d& low, const Vector3d& high)
{
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int n = 0; n < 8; ++n)
    mesh.vertices.push_back(
        Vector3d(n & 1 ? high.x() : low.x(), n & 2 ? high.y() : low.y(), n & 4 ? high.z() : low.z())
            .cast<float>());
  for (const std::array<std::uint32_t, 4>& face : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                                   {4, 5, 7, 6},
                                                   {0, 1, 5, 4},
                                                   {2, 6, 7, 3},
                                                   {0, 4, 6, 2},
                                                   {1, 3, 7, 5}})
  {
    mesh.triangles.push_back({first + face[0], first + face[1], first + face[2]});
    mesh.triangles.push_back({first + face[0], first + face[2], first + face[3]});
  }
}

core::TriangleMesh box(const Vector3d& low, const Vector3d& high)
{
  core::TriangleMesh mesh;
  addBox(mesh, low, high);
  return mesh;
}

// Outward normal of the box at a point of one of its faces' insides; zero at edges.
Vector3d outwardOf(const Vector3d& low, const Vector3d& high, const Vector3d& point)
{
  Vector3d sum = Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(point[axis] - low[axis]) < 1e-6)
      sum -= Vector3d::Unit(axis);
    if (std::abs(point[axis] - high[axis]) < 1e-6)
      sum += Vector3d::Unit(axis);
  }
  return std::abs(sum.norm() - 1.0) < 1e-9 ? sum : Vector3d(Vector3d::Zero());
}

} // namespace

TEST(InstrumentShell, CoversTheSurfaceAsItSaysAndNotMuchWorseThanALattice)
{
  const double length = 60.0;
  const double slope = 0.05;
  const PointShell shell = makeInstrumentShell(cone(slope, length));
  expectConsistent(shell, 2000);
  EXPECT_EQ(shell.points.size(), 2000U);
  EXPECT_EQ(shell.burrCount, shell.points.size());
  double worst = 0.0;
  for (double z = 0.05; z < length; z += 0.31)
    for (double turn = 0.0; turn < 2.0 * kPi; turn += 0.13)
    {
      // On the facets: where the circle's chord is, a little within it.
      const double sector = 2.0 * kPi / 48;
      const double within = std::fmod(turn, sector) - 0.5 * sector;
      const double radius = slope * z * std::cos(0.5 * sector) / std::cos(within);
      worst =
          std::max(worst, nearest(shell, {radius * std::cos(turn), radius * std::sin(turn), z}));
    }
  EXPECT_LE(worst, shell.spacing);
  EXPECT_GE(worst, 0.8 * shell.spacing) << "the stated error is nearly reached";
  // N points whose covering discs form the thinnest lattice cover an area A with the radius
  // sqrt(2 A / (3 sqrt(3) N)) (Kershner 1939); farthest points with at most twice that, where
  // spacing is even. It is denser at the tip.
  const double area = kPi * slope * length * (std::hypot(length, slope * length) + slope * length);
  EXPECT_LT(shell.spacing, 3.0 * std::sqrt(2.0 * area / (3.0 * std::sqrt(3.0) * 2000.0)));
  double atTip = 0.0;
  for (double z = 0.05; z < haptics::kInstrumentTip; z += 0.031)
    atTip = std::max(atTip, nearest(shell, {slope * z, 0.0, z}));
  EXPECT_LE(atTip, shell.burrSpacing);
  EXPECT_LT(shell.burrSpacing, 0.7 * shell.spacing);
}

TEST(InstrumentShell, BeginsAtTheTipWhoseNormalIsTheAxis)
{
  const PointShell shell = makeInstrumentShell(cone(0.1, 40.0));
  EXPECT_EQ(shell.points.front(), Vector3d(0.0, 0.0, 0.0));
  EXPECT_LT((shell.normals.front() + Vector3d::UnitZ()).norm(), 1e-5);
  EXPECT_NEAR(shell.reach, std::hypot(40.0, 4.0), 1e-5);
}

TEST(InstrumentShell, NormalsLeadOutwardsWhicheverWayTheTrianglesFace)
{
  const Vector3d low(-1.0, -2.0, 0.0);
  const Vector3d high(1.5, 2.0, 30.0);
  for (const int flipped : {0, 1, 2}) // none, all, every other
  {
    SCOPED_TRACE(flipped);
    core::TriangleMesh mesh = box(low, high);
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
      if (flipped == 1 || (flipped == 2 && n % 2 == 1))
        std::swap(mesh.triangles[n][1], mesh.triangles[n][2]);
    const PointShell shell = makeInstrumentShell(mesh);
    std::size_t judged = 0;
    for (std::size_t n = 0; n < shell.points.size(); ++n)
    {
      const Vector3d outward = outwardOf(low, high, shell.points[n]);
      if (outward.isZero())
        continue;
      ++judged;
      ASSERT_LT((shell.normals[n] - outward).norm(), 1e-6) << n;
    }
    EXPECT_GT(judged, 1000U);
  }
}

TEST(InstrumentShell, ASmallInstrumentHasNoMorePointsThanItNeeds)
{
  const PointShell shell =
      makeInstrumentShell(box(Vector3d(-0.5, -0.5, 0.0), Vector3d(0.5, 0.5, 1.0)));
  EXPECT_LT(shell.points.size(), 1500U);
  EXPECT_LT(shell.spacing, 0.13);
}

TEST(InstrumentShell, RefusesWhatHasNoSurface)
{
  EXPECT_NE(refusal([] { makeInstrumentShell({}); }), "");
  core::TriangleMesh flat;
  flat.vertices.assign(3, Eigen::Vector3f::Zero());
  flat.triangles.push_back({0, 1, 2});
  EXPECT_NE(refusal([&] { makeInstrumentShell(flat); }).find("no area"), std::string::npos);
  flat.triangles.push_back({0, 1, 7});
  EXPECT_NE(refusal([&] { makeInstrumentShell(flat); }), "");
  EXPECT_NE(refusal([] { makeInstrumentShell(cone(0.1, 10.0), 100); }).find("200 to 20000"),
            std::string::npos);
}

// The whole thrust is the tip's: 1 mm beyond the surface with 1 N/mm.
TEST(InstrumentShell, RestsOnBoneWithItsTipAndBearsTheForce)
{
  const double h = 0.3;
  const Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), h, 7.0));
  const PointShell shell = makeInstrumentShell(cone(0.2, 5.0));
  haptics::ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt({0.1, -0.2, 1.5}));
  haptics::ProxyTick tick;
  for (int n = 0; n <= 250; ++n)
  {
    tick = proxy.step(poseAt({0.1, -0.2, std::max(1.5 - 0.0125 * n, -1.0)}));
    ASSERT_LE(deepest(*scene.tissue, shell, proxy.pose()), 1e-6) << n;
  }
  EXPECT_EQ(tick.status, haptics::ProxyStatus::Contact);
  EXPECT_NEAR(proxy.pose().position.z(), 0.0, 0.05 * h);
  EXPECT_NEAR(tick.wrench.linear.z(), 1.0, 0.03);
  EXPECT_NEAR(tick.thrust, tick.wrench.linear.norm(), 0.03);
}

// Deeper than a voxel the field's slope says nothing of the depth, and there is no ball to bound
// it.
TEST(InstrumentShell, ItsDepthIsUnknownBeyondAVoxelOfTissue)
{
  const double h = 0.3;
  const Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), h, 7.0));
  const PointShell shell = makeInstrumentShell(cone(0.2, 5.0));
  haptics::ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt({0.1, -0.2, -3.0}));
  haptics::ProxyTick tick = proxy.step(poseAt({0.1, -0.2, -3.0}));
  ASSERT_EQ(tick.status, haptics::ProxyStatus::Inside);
  EXPECT_TRUE(std::isnan(tick.penetration)) << tick.penetration;
  proxy.place(poseAt({0.1, -0.2, -0.5 * h}));
  tick = proxy.step(poseAt({0.1, -0.2, -0.5 * h}));
  ASSERT_EQ(tick.status, haptics::ProxyStatus::Inside);
  EXPECT_NEAR(tick.penetration, 0.5 * h, 0.05 * h);
}

// A long instrument is as dense at its tip as a short one, and its handle makes do with less.
TEST(InstrumentShell, ALongHandleLeavesTheTipItsPoints)
{
  core::TriangleMesh mesh = box(Vector3d(-0.8, -0.8, 0.0), Vector3d(0.8, 0.8, 60.0));
  addBox(mesh, Vector3d(-4.0, -4.0, 60.0), Vector3d(4.0, 4.0, 160.0));
  const PointShell shell = makeInstrumentShell(mesh);
  expectConsistent(shell, 2000);
  EXPECT_LT(shell.burrSpacing, 0.6);
  EXPECT_LT(shell.spacing, 2.5);
  double atTip = 0.0;
  for (double x = -0.8; x <= 0.8; x += 0.05)
    for (double y = -0.8; y <= 0.8; y += 0.05)
      atTip = std::max(atTip, nearest(shell, {x, y, 0.0}));
  EXPECT_LT(atTip, 0.25);
}

// The end of a blade comes down on a right-angled cone of bone, which enters up to the distance of
// its apex to the nearest point, however the blade slides.
TEST(InstrumentShell, ASpikeMeetsAPointOfTheTipBeforeItSinksInByMoreThanStated)
{
  const double h = 0.15;
  const Scene scene = sceneOf(
      scanOf([](const Vector3d& p) { return -(p.z() + std::hypot(p.x(), p.y())) / std::sqrt(2.0); },
             h, 3.0));
  const PointShell shell =
      makeInstrumentShell(box(Vector3d(-1.5, -1.0, 0.0), Vector3d(1.5, 1.0, 80.0)));
  EXPECT_LT(shell.burrSpacing, 0.5);
  for (const Vector3d& from : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.13, -0.21, 0.0),
                               Vector3d(-0.37, 0.11, 0.0), Vector3d(0.6, 0.4, 0.0)})
  {
    SCOPED_TRACE(from.transpose());
    haptics::ConstrainedProxy proxy(scene.field, shell);
    proxy.place(poseAt(from + Vector3d(0.0, 0.0, 0.5)));
    for (int n = 0; n <= 120; ++n)
      proxy.step(poseAt(from + Vector3d(0.0, 0.0, 0.5 - 0.0125 * n)));
    const haptics::Pose pose = proxy.pose();
    const Vector3d apex = pose.rotation.conjugate() * Vector3d(-pose.position);
    EXPECT_LE(apex.z(), shell.burrSpacing + 0.3 * h);
    EXPECT_LE(apex.z(), 0.25 + 0.3 * h) << "as dense as the tip itself";
    EXPECT_GE(apex.z(), -0.3 * h) << "it is not held off";
  }
}

// The flat side of a blade comes down on a plate of bone on edge, as thin as two voxels.
TEST(InstrumentShell, ABladeRestsOnARidgeThatIsNoThinnerThanItsPointsAreApart)
{
  const double h = 0.3;
  const Scene scene = sceneOf(
      scanOf([](const Vector3d& p) { return std::min(0.3 - std::abs(p.x()), -p.z()); }, h, 9.0));
  const PointShell shell =
      makeInstrumentShell(box(Vector3d(-4.0, -1.0, 0.0), Vector3d(4.0, 1.0, 4.0)), 400);
  ASSERT_GT(shell.spacing, h) << "else the test shows nothing";
  haptics::ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt({0.0, 0.0, 4.0}));
  for (int n = 0; n <= 600; ++n)
    proxy.step(poseAt({0.0, 0.0, std::max(4.0 - 0.0125 * n, -2.0)}));
  EXPECT_LE(proxy.pose().position.z(), 0.1 * h);
  EXPECT_GE(proxy.pose().position.z(), -shell.spacing);
}
