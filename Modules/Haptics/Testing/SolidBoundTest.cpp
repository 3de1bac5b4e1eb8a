#include <gtest/gtest.h>

#include "SolidChecks.h"
#include "SurfaceSamples.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

// Bone with cells of about a millimetre everywhere.
double cells(const Vector3d& p)
{
  return 0.25 *
         (std::sin(4.1 * p.x()) + std::sin(3.7 * p.y() + 0.4) + std::sin(4.6 * p.z() - 0.3) + 0.3);
}

Scene cellularBone(double h)
{
  return sceneOf(scanOn(boxOf({6.0, 6.0, 3.0}, h, {0.31, 0.13, 0.47}),
                        [](const Vector3d& p) { return std::min(cells(p), -p.z()); }));
}

// Maximum cost of a tick: its own bound, the search's, and, for the last stretch, every point and
// every sample that the tool may meet a few times.
std::size_t bound(const PointShell& shell)
{
  return static_cast<std::size_t>(ProxyParameters().samples) + SurfaceSamples::kMaxWork +
         2 * shell.points.size() + SurfaceSamples::kMaxSamples / SurfaceSamples::kUnit;
}

} // namespace

// Moved along and rotated over the bone that it lies on; 1 m/s is a jerk of the hand.
TEST(SolidBound, HandpieceOnCellularBoneCostsNoMoreAtAnySpeed)
{
  const BurrShape shape;
  for (const double h : {0.1, 0.3})
  {
    const Scene scene = cellularBone(h);
    for (const double speed : {0.02, 1.0}) // m/s, i.e. mm per tick
    {
      SCOPED_TRACE(::testing::Message() << "h " << h << ", " << speed << " m/s");
      const PointShell& shell = sharedShell(shape, h);
      ConstrainedProxy proxy(scene.field, shell);
      const auto pose = [](double x, double z, double turn)
      {
        return poseAt({x - 60.0, 0.07, z},
                      kAlongX * Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())));
      };
      proxy.place(pose(0.0, 6.5, 0.2));
      std::size_t most = 0;
      double reported = 0.0;
      double way = 0.0;
      for (int t = 0; t < 600; ++t)
      {
        const double s = speed * t;
        const Vector3d before = proxy.pose().position;
        const ProxyTick& tick = proxy.step(
            pose(2.0 * std::sin(0.5 * s), 6.5 - std::min(2.0, 0.1 * t), 0.2 + 0.02 * std::sin(s)));
        most = std::max(most, tick.samples);
        reported = std::max(reported, tick.penetration);
        way += (tick.pose.position - before).norm();
        if (t % 200 == 199)
        {
          EXPECT_LE(deepestBone(scene, shape, 1.2, tick.pose, 3.0), kMax);
        }
      }
      EXPECT_LE(most, bound(shell));
      EXPECT_LE(reported, kMax);
      EXPECT_GT(way, 2.0) << "it must go on";
    }
  }
}

// A tool led through the bone from outside, and one placed inside it.
TEST(SolidBound, AToolInTissueCostsNoMore)
{
  const double h = 0.2;
  const BurrShape shape;
  const PointShell& shell = sharedShell(shape, h);
  const Scene scene = cellularBone(h);
  ConstrainedProxy proxy(scene.field, shell);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  std::size_t most = 0;
  for (int n = 0; n < 40; ++n)
  {
    proxy.place(poseAt({uniform(random), uniform(random), uniform(random) - 34.0}));
    for (int t = 0; t < 10; ++t)
      most = std::max(most, proxy.step(poseAt({uniform(random), 0.1 * t, -34.0})).samples);
  }
  EXPECT_LE(most, bound(shell));
}

// While the search is unfinished the tool waits, and continues later.
TEST(SolidBound, WaitsForWhatWasNotSearched)
{
  const double h = 0.1;
  const BurrShape shape;
  const Scene scene = cellularBone(h);
  ConstrainedProxy proxy(scene.field, sharedShell(shape, h));
  const auto pose = [](double z) { return poseAt({-60.0, 0.07, z}, kAlongX); };
  proxy.place(pose(9.0));
  const ProxyTick* tick = nullptr;
  for (int t = 0; t < 400; ++t)
  {
    tick = &proxy.step(pose(4.0)); // at once
    ASSERT_LE(tick->penetration, kMax);
  }
  EXPECT_LE(deepestBone(scene, shape, 1.2, tick->pose, 3.0), kMax);
  EXPECT_EQ(tick->status, ProxyStatus::Contact);
  EXPECT_NEAR((tick->pose * Vector3d(0.0, 0.0, 60.0)).z(), 6.0, 0.3);
}
