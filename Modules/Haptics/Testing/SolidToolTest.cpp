#include <gtest/gtest.h>

#include "SolidChecks.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

// A needle of the given width, up to z = 0.
SignedDistance spike(double width, const Matrix3d& turn = Matrix3d::Identity())
{
  return [=](const Vector3d& at)
  {
    const Vector3d p = turn.transpose() * at;
    return std::min(0.5 * width - std::hypot(p.x(), p.y()), -p.z());
  };
}

} // namespace

TEST(SolidTool, ShaftDoesNotSinkIntoAPlateOnEdge)
{
  const BurrShape shape; // burr of 2 mm, shaft of 1.2 mm
  for (const double h : {0.15, 0.19, 0.3})
    for (const double thickness : {0.2, 0.3, 0.4, 1.0})
    {
      if (thickness < h)
        continue;
      for (const double at : {10.0, 10.37})
      {
        SCOPED_TRACE(::testing::Message() << "h " << h << ", plate " << thickness << ", at " << at);
        const Scene scene =
            sceneOf(scanOn(boxOf({2.0, 2.0, 4.0}, h, {0.31, 0.13, 0.47}), plateOnEdge(thickness)));
        const Dragged result = drag(scene, shape, 1.2, at);
        EXPECT_LE(result.deepest, kMax);
        EXPECT_LE(result.reported, kMax);
      }
    }
}

TEST(SolidTool, ShaftDoesNotSinkIntoObliquePlatesRidgesAndSpikes)
{
  const BurrShape shape;
  const Matrix3d turn =
      Eigen::AngleAxisd(0.5, Vector3d(0.4, 1.0, 0.3).normalized()).toRotationMatrix();
  const Matrix3d about = Eigen::AngleAxisd(0.8, Vector3d::UnitZ()).toRotationMatrix();
  for (const double h : {0.1, 0.2, 0.4})
  {
    const std::pair<const char*, SignedDistance> bones[] = {
        {"oblique plate", plateOnEdge(h, turn)},
        {"plate at an angle to the shaft", plateOnEdge(h, about)},
        {"plate along the shaft",
         plateOnEdge(h, Eigen::AngleAxisd(1.55, Vector3d::UnitZ()).toRotationMatrix())},
        {"spike", spike(1.5 * h, Matrix3d::Identity())},
        {"oblique spike", spike(1.5 * h, turn)}};
    for (const auto& [name, bone] : bones)
    {
      SCOPED_TRACE(::testing::Message() << name << ", h " << h);
      const Scene scene = sceneOf(scanOn(boxOf({2.0, 2.0, 4.0}, h, {0.2, 0.4, 0.1}), bone));
      const Dragged result = drag(scene, shape, 1.2, 10.2, 6.0);
      EXPECT_LE(result.deepest, kMax);
      EXPECT_LE(result.reported, kMax);
    }
  }
}

TEST(SolidTool, BurrDoesNotTakeASpikeBetweenItsPoints)
{
  BurrShape shape;
  shape.radius = 3.5;
  for (const double h : {0.15, 0.3})
    for (const double across : {0.0, 0.4, 1.1})
    {
      SCOPED_TRACE(::testing::Message() << "h " << h << ", " << across << " mm beside the middle");
      const Scene scene =
          sceneOf(scanOn(boxOf({2.0, 2.0, 4.0}, h, {0.31, 0.13, 0.47}), spike(1.5 * h)));
      const Dragged result = drag(scene, shape, 3.5, across, 6.0);
      EXPECT_LE(result.deepest, kMax);
      EXPECT_LE(result.reported, kMax);
    }
}

TEST(SolidTool, HandpieceDoesNotSinkIntoAThinPlate)
{
  const BurrShape shape; // a handpiece of 6 mm from 30 to 90 mm
  for (const double h : {0.15, 0.3})
    for (const double at : {40.0, 41.3})
    {
      SCOPED_TRACE(::testing::Message() << "h " << h << ", at " << at);
      const Scene scene =
          sceneOf(scanOn(boxOf({2.0, 2.0, 4.0}, h, {0.31, 0.13, 0.47}), plateOnEdge(0.6)));
      const Dragged result = drag(scene, shape, 6.0, at);
      EXPECT_LE(result.deepest, kMax);
      EXPECT_LE(result.reported, kMax);
    }
}

// The face of the handpiece beside the shaft, pushed along the tool's axis.
TEST(SolidTool, HandpiecesFaceDoesNotSinkOverASpike)
{
  const BurrShape shape;
  const double h = 0.2;
  for (const double across : {2.0, 3.3, 4.6, 5.8})
  {
    SCOPED_TRACE(across);
    const Scene scene =
        sceneOf(scanOn(boxOf({2.0, 2.0, 4.0}, h, {0.31, 0.13, 0.47}), spike(2.0 * h)));
    ConstrainedProxy proxy(scene.field, sharedShell(shape, h));
    const auto pose = [&](double z) { return poseAt({across, 0.1, z - shape.shaftLength}); };
    proxy.place(pose(0.5));
    const ProxyTick* tick = nullptr;
    for (int t = 1; t <= 300; ++t)
      tick = &proxy.step(pose(0.5 - 0.01 * t));
    EXPECT_LE(deepestBone(scene, shape, 1.2, tick->pose, 8.0), kMax);
    EXPECT_LE(tick->penetration, kMax);
  }
}

// A ridge under the shaft, `lever` from the burr's centre. The exact solution is the minimum energy
// of the coupling with the axis one radius from the ridge.
TEST(SolidTool, ARidgeUnderTheShaftTurnsTheToolAsItShould)
{
  const double h = 0.3;
  const double radius = 1.2;
  const double pressed = 1.0; // mm
  const SignedDistance roof = [](const Vector3d& p)
  { return std::sqrt(0.5) * (-p.z() - std::abs(p.x())); };
  const Scene scene = sceneOf(scanOn(boxOf({3.0, 2.0, 4.0}, h, {0.31, 0.13, 0.47}), roof));
  double top = -1.0;
  for (double x = -h; x <= h; x += 0.01 * h)
    for (double z = top; z < 0.1; z += 1e-4)
      if (scene.tissue->value({x, 0.07, z}) > 0.0)
        top = z;
  const ProxyParameters coupling;
  for (const double lever : {6.3, 12.0, 17.7, 24.45})
  {
    SCOPED_TRACE(lever);
    ConstrainedProxy proxy(scene.field, sharedShell({}, h));
    const auto pose = [&](double z) { return poseAt({-lever, 0.07, z}, kAlongX); };
    const double touch = top + radius;
    proxy.place(pose(touch + 0.2));
    const ProxyTick* tick = nullptr;
    for (int t = 1; t <= 500; ++t)
      tick = &proxy.step(pose(touch + std::max(0.2 - 0.01 * t, -pressed)));
    // Force on the tool `force` along the axis' normal, in equilibrium with the springs.
    double low = 0.0;
    double high = 2.0;
    double angle = 0.0; // of the tool's far end, upwards
    for (int n = 0; n < 60; ++n)
    {
      const double force = 0.5 * (low + high);
      double side = 0.0;
      double up = 0.0;
      for (int m = 0; m < 50; ++m)
      {
        const double above = touch - pressed + up - top;
        side = -force * std::sin(angle) / coupling.stiffness;
        up = force * std::cos(angle) / coupling.stiffness;
        angle = force * (std::cos(angle) * (lever - side) - std::sin(angle) * above) /
                coupling.angularStiffness;
      }
      const double distance =
          std::sin(angle) * (lever - side) + std::cos(angle) * (touch - pressed + up - top);
      (distance < radius ? low : high) = force;
    }
    const double exact = coupling.angularStiffness * angle;
    EXPECT_NEAR(tick->wrench.angular.norm(), exact, 0.01 * exact);
  }
}

// Whatever stops the tool is rendered: the wrench of the contacts balances the coupling.
TEST(SolidTool, WhateverStopsTheToolIsFelt)
{
  const double h = 0.2;
  const BurrShape shape;
  // Bone with caves that ends before the scan does.
  const Scene scene = sceneOf(scanOn(boxOf({3.0, 3.0, 3.0}, h, {0.31, 0.13, 0.47}),
                                     [](const Vector3d& p)
                                     {
                                       const double caves = std::sin(2.1 * p.x()) +
                                                            std::sin(1.7 * p.y() + 0.4) +
                                                            std::sin(2.6 * p.z() - 0.3) - 0.6;
                                       return std::min(0.4 * caves, 2.4 - p.cwiseAbs().maxCoeff());
                                     }));
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  ConstrainedProxy proxy(scene.field, sharedShell(shape, h));
  for (int n = 0; n < 12; ++n)
  {
    SCOPED_TRACE(n);
    const Vector3d toward = draw().normalized();
    const Vector3d axis = toward.cross(draw()).normalized();
    const Quaterniond along = Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
    const auto pose = [&](double way) { return poseAt(-12.0 * axis - way * toward, along); };
    proxy.place(pose(7.0));
    const ProxyTick* tick = nullptr;
    for (int t = 1; t <= 400; ++t)
      tick = &proxy.step(pose(std::max(7.0 - 0.02 * t, 0.0)));
    for (int t = 0; t < 60; ++t)
      tick = &proxy.step(pose(0.0));
    ASSERT_NE(tick->status, ProxyStatus::Inside);
    const Motion stretch = motionBetween(tick->pose, pose(0.0));
    EXPECT_GT(stretch.linear.norm(), 0.05) << "the bone must hold it";
    EXPECT_LT((tick->wrench.linear + stretch.linear).norm(), 0.05 * stretch.linear.norm() + 0.02);
    EXPECT_LE(deepestBone(scene, shape, 1.2, tick->pose, 4.0), kMax);
    EXPECT_LE(tick->penetration, kMax);
  }
}
