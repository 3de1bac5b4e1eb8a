#include "RigidParametrization.h"

#include <gtest/gtest.h>

#include "TestBodies.h"

namespace petrous::registration
{
namespace
{

using namespace testing;

TEST(RigidParametrization, ZeroIsItsBase)
{
  const core::RigidTransform base = motion({10, 20, 30}, 12.0, 35.0);
  const RigidParametrization chart(base, {10, 20, 30}, 60.0);
  EXPECT_LT((chart.pose(PoseVector::Zero()).matrix() - base.matrix()).norm(), 1e-12);
}

TEST(RigidParametrization, AMillimetreOfRotationMovesThePointsAtItsRadiusByOne)
{
  const Vector3d centre(10, 20, 30);
  const RigidParametrization chart(motion(centre, 12.0, 35.0), centre, 60.0);
  PoseVector x = PoseVector::Zero();
  x[2] = 1.0; // about z
  const core::RigidTransform base = chart.pose(PoseVector::Zero());
  const core::RigidTransform turned = chart.pose(x);
  EXPECT_LT((turned * centre - base * centre).norm(), 1e-12);
  const Vector3d point = base.inverse() * (base * centre + Vector3d(60, 0, 0));
  EXPECT_NEAR((turned * point - base * point).norm(), 1.0, 1e-4);
}

// For f = a . T(p) at a few points, whose derivatives for small motions are known.
TEST(RigidParametrization, GradientFollowsTheChartFarFromItsBase)
{
  const Vector3d centre(-5, 8, 3);
  const RigidParametrization chart(motion(centre, 4.0, 20.0), centre, 50.0);
  const Vector3d a(0.3, -1.2, 0.7);
  const Vector3d point(30, -20, 15);
  const auto f = [&](const PoseVector& x) { return a.dot(chart.pose(x) * point); };
  PoseVector x;
  x << 20.0, -14.0, 9.0, 1.0, 2.0, 3.0;
  const core::RigidTransform pose = chart.pose(x);
  const Vector3d arm = pose * point - pose * centre;
  const PoseVector slope = chart.gradient(x, a, arm.cross(a));
  for (int n = 0; n < 6; ++n)
  {
    PoseVector up = x;
    PoseVector down = x;
    up[n] += 1e-4;
    down[n] -= 1e-4;
    EXPECT_NEAR(slope[n], (f(up) - f(down)) / 2e-4, 1e-6) << n;
  }
}

TEST(PoseDistance, BoundsWhereThePointsGo)
{
  const Vector3d centre(1, 2, 3);
  const core::RigidTransform a = motion(centre, 5.0, 12.0);
  const core::RigidTransform b = motion(centre, 2.0, -9.0, {1, 0, 0});
  const double bound = poseDistance(a, b, centre, 40.0);
  for (int n = 0; n < 100; ++n)
  {
    const Vector3d p =
        centre + 40.0 * Vector3d(std::sin(n), std::cos(3.0 * n), std::sin(7.0 * n)).normalized();
    EXPECT_LE((a * p - b * p).norm(), bound + 1e-9);
  }
}

TEST(MeanPose, IsHalfWayBetweenTwo)
{
  const Vector3d centre(7, -3, 20);
  const core::RigidTransform base = motion(centre, 3.0, 50.0);
  const Vector3d axis = Vector3d(1, 2, -1).normalized();
  const auto turned = [&](double degrees, double shift)
  {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, axis)) * base.rotation();
    return core::RigidTransform(q, base * centre + shift * Vector3d::UnitX() - q * centre);
  };
  const core::RigidTransform mean = meanPose({turned(4.0, 1.0), turned(-2.0, 0.0)}, centre);
  EXPECT_LT((mean.matrix() - turned(1.0, 0.5).matrix()).norm(), 1e-9);
}

} // namespace
} // namespace petrous::registration
