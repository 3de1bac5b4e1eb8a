#include "MutualInformation.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "JointHistogram.h"
#include "RigidParametrization.h"
#include "TestBodies.h"

namespace petrous::registration
{
namespace
{

using namespace testing;

struct Scene
{
  Head head;
  core::RigidTransform truth = motion({0, 0, 0}, 6.0, 5.0);
  LevelImage fixed = makeLevel(*imageOf(gridAbout({0, 0, 0}, {130, 150, 116}, {2, 2, 2}),
                                        [this](const Vector3d& p) { return head.ct(p); }),
                               2.0);
  LevelImage moving =
      makeLevel(*imageOf(gridAbout(truth * Vector3d(0, 0, 0), {130, 150, 116}, {2, 2, 2}),
                         [this](const Vector3d& p) { return head.t1(truth.inverse() * p); }),
                2.0);
  FixedSamples samples = drawSamples(fixed, fixed.grid().fullBox(), 20'000, 3, kBins);
};

TEST(JointHistogram, KnowsTwoCoins)
{
  // p = (1/2 0; 1/4 1/4): I = 1/2 log(1/2 / (1/2 3/4)) + 1/4 log(1/4 / (1/2 3/4))
  //                          + 1/4 log(1/4 / (1/2 1/4))
  const JointHistogram joint({{2.0f, 0.0f, 1.0f, 1.0f}}, 2, 2);
  const double expected =
      0.5 * std::log(4.0 / 3.0) + 0.25 * std::log(2.0 / 3.0) + 0.25 * std::log(2.0);
  EXPECT_NEAR(joint.information(), expected, 1e-12);
  EXPECT_DOUBLE_EQ(joint.total, 4.0);
}

TEST(JointHistogram, OfIndependentImagesIsZero)
{
  const JointHistogram joint({{1.0f, 2.0f, 2.0f, 4.0f}}, 2, 2);
  EXPECT_NEAR(joint.information(), 0.0, 1e-12);
}

TEST(MutualInformation, IsLargestWhereTheImagesAgree)
{
  const Scene scene;
  const MutualInformation metric(scene.samples, scene.moving);
  const double there = metric.value(scene.truth);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
    {
      const core::RigidTransform aside(
          scene.truth.rotation(), scene.truth.translation() + sign * 1.5 * Vector3d::Unit(axis));
      EXPECT_LT(metric.value(aside), there) << axis << " " << sign;
      const core::RigidTransform turned(
          Eigen::AngleAxisd(sign * 2.0 * kDegree, Vector3d::Unit(axis)) * scene.truth.rotation(),
          scene.truth.translation());
      EXPECT_LT(metric.value(turned), there) << axis << " " << sign;
    }
}

TEST(MutualInformation, ValueAndValueWithGradientAgree)
{
  const Scene scene;
  const MutualInformation metric(scene.samples, scene.moving);
  double overlap = 0.0;
  const double value = metric.value(scene.truth, &overlap);
  const auto both = metric.withGradient(scene.truth);
  EXPECT_EQ(value, both.information);
  EXPECT_EQ(overlap, both.overlap);
  EXPECT_GT(overlap, 0.8);
}

// Against central differences in each of the six parameters, with no sample leaving the image.
TEST(MutualInformation, GradientIsThatOfTheValue)
{
  const Scene scene;
  const core::IndexBox inner{{15, 15, 12}, {50, 60, 46}};
  const FixedSamples samples = drawSamples(scene.fixed, inner, 20'000, 3, 32);
  const MutualInformation metric(samples, scene.moving, 32);
  const core::RigidTransform base = motion({0, 0, 0}, 3.0, 2.0) * scene.truth;
  const RigidParametrization chart(base, samples.centre, samples.radius);
  PoseVector at;
  at << 2.0, -1.0, 3.0, 0.5, -0.7, 1.1;
  const auto v = metric.withGradient(chart.pose(at));
  ASSERT_NEAR(v.overlap, 1.0, 1e-5);
  const PoseVector slope = chart.gradient(at, v.translation, v.rotation);
  const double step = 0.02;
  for (int n = 0; n < 6; ++n)
  {
    PoseVector up = at;
    PoseVector down = at;
    up[n] += step;
    down[n] -= step;
    const double difference =
        (metric.value(chart.pose(up)) - metric.value(chart.pose(down))) / (2.0 * step);
    EXPECT_NEAR(slope[n], difference, 0.02 * slope.norm()) << n;
  }
}

TEST(MutualInformation, IsTheSameToTheBitForAnyNumberOfThreads)
{
  const Scene scene;
  const MutualInformation metric(scene.samples, scene.moving);
  const auto many = metric.withGradient(scene.truth);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = metric.withGradient(scene.truth);
  EXPECT_EQ(many.information, single.information);
  EXPECT_EQ(many.translation, single.translation);
  EXPECT_EQ(many.rotation, single.rotation);
}

TEST(MutualInformation, LeavesOutWhatHoldsNothing)
{
  const Scene scene;
  LevelImage holed{volume::Volume<float>(scene.moving.grid()), scene.moving.low, scene.moving.high,
                   scene.moving.valid};
  const core::Index3 dims = holed.grid().dims();
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        holed.voxels.at(i, j, k) = i < dims[0] / 2 ? std::numeric_limits<float>::quiet_NaN()
                                                   : scene.moving.voxels.at(i, j, k);
  const auto whole = MutualInformation(scene.samples, scene.moving).withGradient(scene.truth);
  const auto half = MutualInformation(scene.samples, holed).withGradient(scene.truth);
  EXPECT_NEAR(half.overlap, 0.5 * whole.overlap, 0.05);
  EXPECT_GT(half.information, 0.3);
  EXPECT_TRUE(half.translation.allFinite());
}

TEST(MutualInformation, IsZeroWithoutOverlap)
{
  const Scene scene;
  const MutualInformation metric(scene.samples, scene.moving);
  const core::RigidTransform far(Eigen::Quaterniond::Identity(), Vector3d(500, 0, 0));
  const auto v = metric.withGradient(far);
  EXPECT_EQ(v.information, 0.0);
  EXPECT_EQ(v.overlap, 0.0);
  EXPECT_EQ(v.translation, Vector3d::Zero().eval());
}

// Invariant to linear changes of the moving image's values, including inversion.
TEST(MutualInformation, DoesNotAskHowBrightTheImageIs)
{
  const Scene scene;
  LevelImage inverted{volume::Volume<float>(scene.moving.grid()), 100.0f - scene.moving.high,
                      100.0f - scene.moving.low, scene.moving.valid};
  for (std::size_t n = 0; n < inverted.voxels.size(); ++n)
    inverted.voxels.data()[n] = 100.0f - scene.moving.voxels.data()[n];
  EXPECT_NEAR(MutualInformation(scene.samples, inverted).value(scene.truth),
              MutualInformation(scene.samples, scene.moving).value(scene.truth), 2e-3);
}

} // namespace
} // namespace petrous::registration
