#include "petrous/Registration/StillPose.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/Error.h"

namespace petrous::registration
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::array<int, 2> kSize{1920, 1080};

core::CameraPose microscope(double angle, double distance = 250.0)
{
  core::CameraPose camera;
  camera.focalPoint = {-40.0, 5.0, 3.0};
  camera.position = camera.focalPoint + distance * Vector3d(-0.8, 0.35, 0.45).normalized();
  camera.viewUp = {0.1, -0.2, 1.0};
  camera.viewAngle = angle;
  return camera;
}

/// Malleus, incus, canal's wall and the like: about 25 mm across and 15 mm deep.
std::vector<Vector3d> ear()
{
  return {{-40.0, 5.0, 3.0},  {-44.0, 12.0, 9.0}, {-36.0, -4.0, -5.0},
          {-48.0, 8.0, -6.0}, {-33.0, 6.0, 12.0}, {-42.0, -6.0, 6.0}};
}

/// The definition of a perspective picture, apart from the module's own.
Vector2d seen(const core::CameraPose& camera, const Vector3d& p)
{
  const Vector3d into = (camera.focalPoint - camera.position).normalized();
  const Vector3d right = into.cross(camera.viewUp).normalized();
  const Vector3d up = right.cross(into);
  const Vector3d q = p - camera.position;
  const double half = std::tan(0.5 * camera.viewAngle * kDegree);
  const double scale = 0.5 * kSize[1] / (half * q.dot(into));
  return {0.5 * kSize[0] + scale * q.dot(right), 0.5 * kSize[1] - scale * q.dot(up)};
}

std::vector<StillLandmark> still(const core::CameraPose& camera,
                                 const std::vector<Vector3d>& points)
{
  std::vector<StillLandmark> landmarks;
  for (const Vector3d& p : points)
    landmarks.push_back({p, seen(camera, p)});
  return landmarks;
}

double turnBetween(const core::CameraPose& a, const core::CameraPose& b)
{
  const auto axes = [](const core::CameraPose& c)
  {
    Eigen::Matrix3d m;
    m.col(2) = (c.focalPoint - c.position).normalized();
    m.col(0) = m.col(2).cross(c.viewUp).normalized();
    m.col(1) = m.col(2).cross(m.col(0));
    return m;
  };
  return Eigen::AngleAxisd(axes(a).transpose() * axes(b)).angle() / kDegree;
}

TEST(StillPose, IsExactOfExactLandmarks)
{
  for (const auto& [angle, distance] : {std::pair(4.0, 400.0), {12.0, 250.0}, {40.0, 60.0}})
  {
    const core::CameraPose truth = microscope(angle, distance);
    for (const bool given : {true, false})
    {
      if (!given && angle < 10.0)
        continue; // hardly any perspective: not told by six landmarks
      const StillPose pose = poseOfStill(still(truth, ear()), kSize,
                                         given ? std::optional<double>(angle) : std::nullopt);
      EXPECT_LT(turnBetween(pose.camera, truth), 1e-4) << angle << given;
      EXPECT_LT((pose.camera.position - truth.position).norm(), 1e-2) << angle << given;
      EXPECT_NEAR(pose.camera.viewAngle, angle, 1e-4 * angle);
      EXPECT_LT(pose.rms, 1e-5);
      EXPECT_FALSE(pose.ambiguous);
      EXPECT_EQ(pose.viewAngleSigma > 0.0, !given);
    }
  }
}

// From every side, upside down, near: the start is not near the pose.
TEST(StillPose, IsFoundFromEverywhere)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> far(60.0, 400.0);
  for (int round = 0; round < 60; ++round)
  {
    core::CameraPose truth;
    truth.focalPoint = {-40.0, 5.0, 3.0};
    const Vector3d from(normal(random), normal(random), normal(random));
    truth.position = truth.focalPoint + far(random) * from.normalized();
    truth.viewUp = {normal(random), normal(random), normal(random)};
    truth.viewAngle = 20.0;
    const StillPose pose = poseOfStill(still(truth, ear()), kSize, 20.0);
    EXPECT_LT(turnBetween(pose.camera, truth), 1e-3) << round;
    EXPECT_LT((pose.camera.position - truth.position).norm(), 1e-2) << round;
  }
}

// Clicks of half a pixel: the errors are those that are stated.
TEST(StillPose, StatesItsError)
{
  std::mt19937 random(11);
  std::normal_distribution<double> click(0.0, 0.5);
  const core::CameraPose truth = microscope(12.0);
  for (const bool given : {true, false})
  {
    double turns = 0.0;
    double shifts = 0.0;
    double statedTurn = 0.0;
    double statedShift = 0.0;
    constexpr int kRounds = 40;
    for (int round = 0; round < kRounds; ++round)
    {
      auto landmarks = still(truth, ear());
      for (StillLandmark& one : landmarks)
        one.still += Vector2d(click(random), click(random));
      const StillPose pose =
          poseOfStill(landmarks, kSize, given ? std::optional<double>(12.0) : std::nullopt);
      turns += std::pow(turnBetween(pose.camera, truth), 2);
      shifts += (pose.camera.position - truth.position).squaredNorm();
      statedTurn += pose.rotationSigma * pose.rotationSigma;
      statedShift += pose.positionSigma * pose.positionSigma;
    }
    EXPECT_NEAR(std::sqrt(turns / statedTurn), 0.9, 0.3) << given;
    EXPECT_NEAR(std::sqrt(shifts / statedShift), 0.9, 0.35) << given;
    if (given)
    {
      EXPECT_LT(std::sqrt(turns / kRounds), 0.5);  // degrees
      EXPECT_LT(std::sqrt(shifts / kRounds), 2.0); // mm, at 250 mm
    }
  }
}

// No small change of the camera explains the landmarks better.
TEST(StillPose, HasTheLeastSquares)
{
  const core::CameraPose truth = microscope(15.0);
  auto landmarks = still(truth, ear());
  landmarks[1].still += Vector2d(6.0, -3.0);
  landmarks[4].still += Vector2d(-4.0, 5.0);
  const StillPose pose = poseOfStill(landmarks, kSize, 15.0);
  const auto squares = [&](const core::CameraPose& camera)
  {
    double sum = 0.0;
    for (const StillLandmark& one : landmarks)
      sum += (seen(camera, one.patient) - one.still).squaredNorm();
    return sum;
  };
  const double least = squares(pose.camera);
  EXPECT_NEAR(std::sqrt(least / 6.0), pose.rms, 1e-9);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
    {
      core::CameraPose other = pose.camera;
      other.position += sign * 0.05 * Vector3d::Unit(axis);
      EXPECT_GT(squares(other), least);
      other = pose.camera;
      other.focalPoint += sign * 0.05 * Vector3d::Unit(axis);
      EXPECT_GT(squares(other), least);
    }
  EXPECT_GT(pose.residuals[1], pose.residuals[0]);
  // a residual in mm at the depth of the landmarks, 250 mm away
  EXPECT_NEAR(pose.rmsAtLandmarks / pose.rms, 250.0 * std::tan(7.5 * kDegree) / 540.0, 3e-3);
}

// Points of a plane, seen small and askew: a mirrored tilt looks nearly alike.
TEST(StillPose, SaysWhereAnotherPoseFitsAsWell)
{
  core::CameraPose truth = microscope(2.0);
  truth.position = truth.focalPoint + 900.0 * Vector3d(-0.9, 0.3, 0.3).normalized();
  const std::vector<Vector3d> plane{
      {-40.0, 0.0, 0.0}, {-40.0, 8.0, 0.0}, {-40.0, 0.0, 8.0}, {-40.0, 8.0, 8.0}};
  EXPECT_TRUE(poseOfStill(still(truth, plane), kSize, 2.0).ambiguous);
}

TEST(StillPose, RefusesWhatLeavesItOpen)
{
  const core::CameraPose truth = microscope(12.0);
  auto five = still(truth, ear());
  five.pop_back();
  EXPECT_THROW(poseOfStill(five, kSize), core::InvalidParameter);
  EXPECT_NO_THROW(poseOfStill(five, kSize, 12.0));
  five.resize(3);
  EXPECT_THROW(poseOfStill(five, kSize, 12.0), core::InvalidParameter);
  std::vector<Vector3d> line;
  for (const double x : {0.0, 2.0, 5.0, 7.0, 9.0, 14.0})
    line.emplace_back(-40.0 + x, 5.0 + 0.3 * x, 3.0 - 0.2 * x);
  EXPECT_THROW(poseOfStill(still(truth, line), kSize, 12.0), core::InvalidParameter);
  // a plane at right angles to the axis has every angle of view
  const Vector3d into = (truth.focalPoint - truth.position).normalized();
  const Vector3d right = into.cross(truth.viewUp).normalized();
  const Vector3d up = right.cross(into);
  std::vector<Vector3d> flat;
  for (const auto& at : {Vector2d(0, 0), Vector2d(9, 1), Vector2d(-8, 3), Vector2d(2, 9),
                         Vector2d(-3, -7), Vector2d(6, -6)})
    flat.emplace_back(truth.focalPoint + at.x() * right + at.y() * up);
  EXPECT_THROW(poseOfStill(still(truth, flat), kSize), core::InvalidParameter);
  EXPECT_NO_THROW(poseOfStill(still(truth, flat), kSize, 12.0));
  auto broken = still(truth, ear());
  broken[2].still[1] = std::nan("");
  EXPECT_THROW(poseOfStill(broken, kSize), core::InvalidParameter);
  EXPECT_THROW(poseOfStill(still(truth, ear()), {0, 0}), core::InvalidParameter);
  EXPECT_THROW(poseOfStill(still(truth, ear()), kSize, 150.0), core::InvalidParameter);
}

} // namespace
} // namespace petrous::registration
