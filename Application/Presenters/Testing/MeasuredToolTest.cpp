#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Presenters/MeasuredTool.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

const Vector3d kBall(3.0, -4.0, 5.0);
constexpr double kBallRadius = 2.0;

double toBall(const Vector3d& patient)
{
  return (patient - kBall).norm() - kBallRadius;
}

double clamped(const Vector3d& patient, double most)
{
  return std::clamp(toBall(patient), -most, most);
}

haptics::Pose poseAt(const Vector3d& position,
                     const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity())
{
  return {position, rotation};
}

/// Along +z of frame T, 40 mm long, a point each 0.4 mm, the first at the tip.
haptics::PointShell needle()
{
  haptics::PointShell shell;
  for (int n = 0; n <= 100; ++n)
    shell.points.emplace_back(0.0, 0.0, 0.4 * n);
  shell.burrSpacing = 0.2;
  shell.spacing = 0.5; // more than there is, to tell them apart
  shell.reach = 40.0;
  return shell;
}

} // namespace

TEST(MeasuredTool, OfABurrIsItsBall)
{
  const MeasuredTool burr(1.5);
  EXPECT_FALSE(burr.isInstrument());
  const auto at = burr.distance(poseAt(kBall + Vector3d(0.0, 0.0, 10.0)), clamped, 50.0);
  EXPECT_NEAR(at.millimetres, 10.0 - kBallRadius - 1.5, 1e-12);
  EXPECT_EQ(at.sampling, 0.0);
  EXPECT_LT(burr.distance(poseAt(kBall), clamped, 50.0).millimetres, 0.0);
  EXPECT_GE(burr.distance(poseAt(kBall + Vector3d(0.0, 0.0, 10.0)), clamped, 3.0).millimetres, 3.0);
}

TEST(MeasuredTool, OfAnInstrumentIsTheNearestOfItsPoints)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inBox(-1.0, 1.0);
  haptics::PointShell shell;
  for (int n = 0; n < 2000; ++n)
    shell.points.emplace_back(4.0 * inBox(random), 4.0 * inBox(random),
                              40.0 * (1.0 + inBox(random)));
  shell.burrSpacing = 0.1;
  shell.spacing = 1.0;
  const MeasuredTool tool(shell);
  int near = 0;
  for (int n = 0; n < 200; ++n)
  {
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond(inBox(random), inBox(random), inBox(random), inBox(random)).normalized();
    const auto pose =
        poseAt(kBall + 60.0 * Vector3d(inBox(random), inBox(random), inBox(random)), rotation);
    double nearest = 1e9;
    for (const Vector3d& point : shell.points)
      nearest = std::min(nearest, toBall(pose * point));
    int asked = 0;
    const auto found = tool.distance(
        pose,
        [&asked](const Vector3d& patient, double most)
        {
          ++asked;
          return clamped(patient, most);
        },
        30.0);
    if (nearest >= 30.0)
      EXPECT_GE(found.millimetres, 30.0);
    else if (nearest <= 0.0)
      EXPECT_LE(found.millimetres, 0.0);
    else
    {
      EXPECT_NEAR(found.millimetres, nearest, 1e-12);
      ++near;
    }
    EXPECT_LT(asked, 1000) << "half of the points";
  }
  EXPECT_GT(near, 20);
}

// A bound that is too small, as volume::SurfaceDistance::bound is by up to a cell's diagonal, rules
// out less, but nothing that matters.
TEST(MeasuredTool, GivesTheSameWithACheaperBound)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> inBox(-1.0, 1.0);
  haptics::PointShell shell;
  for (int n = 0; n < 2000; ++n)
  {
    const double z = 80.0 * std::pow(0.5 * (1.0 + inBox(random)), 2);
    shell.points.emplace_back(1.5 * inBox(random), 1.5 * inBox(random), z);
  }
  shell.burrSpacing = 0.1;
  shell.spacing = 1.3;
  const MeasuredTool tool(shell);
  const auto bound = [](const Vector3d& patient, double most)
  {
    const double away = toBall(patient);
    const double less = 0.25 * (1.0 + std::sin(50.0 * patient.x())); // 0 to 0.5 mm
    return away <= 0.0 ? -most : std::min(most, std::max(0.0, away - less));
  };
  int near = 0, tips = 0, shafts = 0;
  for (int n = 0; n < 400; ++n)
  {
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond(inBox(random), inBox(random), inBox(random), inBox(random)).normalized();
    const auto pose =
        poseAt(kBall + 30.0 * Vector3d(inBox(random), inBox(random), inBox(random)), rotation);
    // The truth: of all points.
    double tip = 1e9, shaft = 1e9;
    for (const Vector3d& point : shell.points)
    {
      double& least = point.norm() <= haptics::kInstrumentTip - shell.spacing ? tip : shaft;
      least = std::min(least, toBall(pose * point));
    }
    const double nearest = std::min(tip, shaft);
    const double least = std::min(tip - shell.burrSpacing, shaft - shell.spacing);
    int asked = 0, askedAlone = 0;
    const auto counted = [](int& count)
    {
      return [&count](const Vector3d& patient, double most)
      {
        ++count;
        return clamped(patient, most);
      };
    };
    const auto found = tool.distance(pose, counted(asked), 20.0, bound);
    const auto alone = tool.distance(pose, counted(askedAlone), 20.0);
    EXPECT_LT(asked, 400) << "of 2000";
    if (nearest >= 20.0)
    {
      EXPECT_GE(found.millimetres, 20.0);
      continue;
    }
    if (nearest <= 0.0)
    {
      EXPECT_LE(found.millimetres, 0.0);
      EXPECT_LE(alone.millimetres, 0.0);
      continue;
    }
    ++near;
    ++(tip < shaft ? tips : shafts);
    EXPECT_NEAR(found.millimetres, nearest, 1e-12);
    EXPECT_NEAR(alone.millimetres, nearest, 1e-12);
    if (std::max(tip, shaft) < 20.0)
    {
      EXPECT_NEAR(found.millimetres - found.sampling, least, 1e-12);
    }
  }
  EXPECT_GT(near, 50);
  EXPECT_GT(tips, 5);
  EXPECT_GT(shafts, 5);
}

TEST(MeasuredTool, StatesByHowMuchPlacesBetweenThePointsMayBeNearer)
{
  const MeasuredTool tool(needle());
  EXPECT_TRUE(tool.isInstrument());
  EXPECT_EQ(tool.sampling(), 0.5);
  EXPECT_EQ(tool.reach(), 40.0);
  // The tip above the ball, and the shaft beside it, each 3 mm from its surface.
  const auto tip =
      tool.distance(poseAt(kBall + Vector3d(0.0, 0.0, kBallRadius + 3.0)), clamped, 20.0);
  EXPECT_NEAR(tip.millimetres, 3.0, 1e-12);
  EXPECT_NEAR(tip.sampling, 0.2, 1e-12);
  const auto shaft =
      tool.distance(poseAt(kBall + Vector3d(kBallRadius + 3.0, 0.0, -20.0)), clamped, 20.0);
  EXPECT_NEAR(shaft.millimetres, 3.0, 1e-12);
  EXPECT_NEAR(shaft.sampling, 0.5, 1e-12);
  // Turned about, the shaft points down through the ball.
  const Eigen::Quaterniond down(Eigen::AngleAxisd(3.14159265358979323846, Vector3d::UnitX()));
  EXPECT_LE(
      tool.distance(poseAt(kBall + Vector3d(0.0, 0.0, 10.0), down), clamped, 20.0).millimetres,
      0.0);
}

// The truth: of a segment, with all of its places.
TEST(MeasuredTool, NeverOverestimatesByMoreThanItStates)
{
  const MeasuredTool tool(needle());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> inBox(-1.0, 1.0);
  double largest = 0.0;
  for (int n = 0; n < 500; ++n)
  {
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond(inBox(random), inBox(random), inBox(random), inBox(random)).normalized();
    const auto pose =
        poseAt(kBall + 15.0 * Vector3d(inBox(random), inBox(random), inBox(random)), rotation);
    const Vector3d along = rotation * Vector3d::UnitZ();
    const double foot = std::clamp((kBall - pose.position).dot(along), 0.0, 40.0);
    const double truth = toBall(pose.position + foot * along);
    const auto found = tool.distance(pose, clamped, 50.0);
    if (found.millimetres <= 0.0)
    {
      EXPECT_LE(truth, 1e-9);
      continue;
    }
    if (truth <= 0.0) // it pierces between two points
    {
      EXPECT_LE(found.millimetres - found.sampling, 1e-9);
      continue;
    }
    EXPECT_GE(found.millimetres, truth - 1e-9);
    EXPECT_LE(found.millimetres - found.sampling, truth + 1e-9);
    largest = std::max(largest, found.millimetres - truth);
  }
  EXPECT_GT(largest, 0.0);
}
