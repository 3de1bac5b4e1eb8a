#include "petrous/Haptics/ConstrainedProxy.h"

#include <gtest/gtest.h>

#include "ProxyChecks.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kVoxel = 0.3;
constexpr double kRamp = 6.0; // mm over which the union goes from 0 to 1: depth is known that far

// A soft structure, and bone or air round it.
Scene softScene(const SignedDistance& solid, double compliance, const SignedDistance& rigid)
{
  const auto ct = scanOf(rigid, kVoxel, 6.0);
  const core::GridGeometry& grid = ct->geometry();
  auto share = std::make_shared<volume::Volume<float>>(grid);
  auto index = std::make_shared<volume::Volume<std::uint8_t>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const double d = solid(grid.patientFromVoxel(Vector3d(i, j, k)));
        share->at(i, j, k) = static_cast<float>(std::clamp(0.5 + d / kRamp, 0.0, 1.0));
        index->at(i, j, k) = d > -1.0 ? 7 : 0;
      }
  SoftTissue soft;
  soft.index = index;
  soft.compliance[7] = static_cast<float>(compliance);
  return sceneOf(ct, {share}, soft);
}

double air(const Vector3d&)
{
  return -2.0;
}

} // namespace

// One contact, n the way out, D the goal's depth, d the tool's: the coupling pulls with K (D - d)
// and the tissue pushes back with d / c. At rest both are F, so F = D / (c + 1/K) and d = c F.
TEST(ConstrainedProxy, YieldsInSoftTissueAsTwoSpringsInARow)
{
  const double radius = 4.0;
  for (const double compliance : {0.1, 0.5, 2.0})
  {
    const Scene scene = softScene(ball(radius), compliance, air);
    for (const double stiffness : {0.5, 2.0})
    {
      ProxyParameters parameters;
      parameters.stiffness = stiffness;
      ConstrainedProxy proxy(scene.field, pointShell(), parameters);
      const Vector3d out = Vector3d(0.4, -0.2, 0.9).normalized();
      proxy.place(poseAt((radius + 0.5) * out));
      for (const double depth : {0.2, 0.6, 1.2})
      {
        SCOPED_TRACE(::testing::Message()
                     << compliance << " mm/N, " << stiffness << " N/mm, " << depth << " mm");
        const Pose goal = poseAt((radius - depth) * out);
        for (int t = 0; t < 20; ++t)
          proxy.step(goal);
        const ProxyTick& tick = proxy.step(goal);
        const double force = depth / (compliance + 1.0 / stiffness);
        EXPECT_EQ(tick.status, ProxyStatus::Contact);
        ASSERT_EQ(tick.contactCount, 1U);
        EXPECT_TRUE(tick.contacts[0].soft);
        // 2 %, and what 0.02 voxel of the surface's height make.
        const double allowed = 0.02 * force + 0.02 * kVoxel * force / depth;
        EXPECT_NEAR(tick.contacts[0].thrust, force, allowed);
        EXPECT_NEAR(tick.wrench.linear.dot(out), force, allowed);
        EXPECT_LT((tick.wrench.linear - force * out).norm(), 1.5 * allowed);
        const double sunk = radius - tick.pose.position.norm();
        EXPECT_NEAR(sunk, compliance * force, 0.02 * compliance * force + 0.02 * kVoxel);
      }
    }
  }
}

TEST(ConstrainedProxy, IsStoppedByTheBoneBehindSoftTissue)
{
  const double layer = 1.0; // mm of soft tissue on bone that fills z < 0
  const Scene scene =
      softScene([&](const Vector3d& p) { return layer - p.z(); }, 5.0, plane(Vector3d::UnitZ()));
  const PointShell shell = pointShell();
  ConstrainedProxy proxy(scene.field, shell);
  const volume::TissueField rigid(scene.tissue->ct(), {}, nullptr, scene.tissue->parameters());
  proxy.place(poseAt({0.0, 0.0, 3.0}));
  double lowest = 3.0;
  for (int t = 0; t < 400; ++t)
  {
    const ProxyTick& tick = proxy.step(poseAt({0.3, 0.1, 3.0 - 0.012 * t}));
    ASSERT_LE(deepest(rigid, shell, tick.pose), 0.0);
    lowest = std::min(lowest, tick.pose.position.z());
  }
  // Through soft tissue alone it would have sunk 2.3 mm.
  EXPECT_NEAR(lowest, 0.0, 0.05 * kVoxel);
}

TEST(ConstrainedProxy, PassesSoftTissueThatWasCutAwayWithoutForce)
{
  Scene scene = softScene(ball(2.0), 0.2, air);
  ConstrainedProxy proxy(scene.field, pointShell());
  const Pose goal = poseAt({0.0, 0.0, 1.0});
  proxy.place(poseAt({0.0, 0.0, 3.0}));
  proxy.step(goal);
  EXPECT_EQ(proxy.step(goal).status, ProxyStatus::Contact);
  cutBall(scene, {0.0, 0.0, 1.5}, 1.6);
  proxy.step(goal);
  const ProxyTick& tick = proxy.step(goal);
  EXPECT_EQ(tick.status, ProxyStatus::Free);
  EXPECT_LT((tick.pose.position - goal.position).norm(), 2e-3);
}
