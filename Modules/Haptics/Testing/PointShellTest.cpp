#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ShellChecks.h"
#include "petrous/Haptics/PointShell.h"

using namespace petrous;
using namespace petrous::haptics::checks;
using Eigen::Vector3d;
using haptics::BurrShape;
using haptics::makeBurrShell;
using haptics::PointShell;

namespace
{

constexpr double kPi = 3.14159265358979323846;

Vector3d randomDirection(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// How much farther the ball reaches than the burr's points, in the worst of 10^4 directions not
// hidden by the shaft: the error in height when pressed against a plane.
double worstDeficit(const PointShell& shell, double radius, double shaftRadius)
{
  std::mt19937 random(5);
  const double neck = std::sqrt(radius * radius - shaftRadius * shaftRadius);
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n)
  {
    const Vector3d direction = randomDirection(random);
    if (radius * direction.z() > neck)
      continue;
    double reach = -radius;
    for (std::size_t i = 0; i < shell.burrCount; ++i)
      reach = std::max(reach, direction.dot(shell.points[i]));
    worst = std::max(worst, radius - reach);
  }
  return worst;
}

} // namespace

TEST(PointShell, BurrIsFeltWithinAFiftiethOfAVoxel)
{
  struct Case
  {
    double radius;
    double shaft;
    double voxel;
  };
  for (const Case& c : {Case{2.0, 1.2, 0.3}, Case{0.5, 0.3, 0.3}, Case{3.0, 1.2, 0.4},
                        Case{1.0, 1.0, 0.2}, Case{0.25, 0.01, 0.1}})
  {
    SCOPED_TRACE(c.radius);
    BurrShape shape;
    shape.radius = c.radius;
    shape.shaftRadius = c.shaft;
    const PointShell shell = makeBurrShell(shape, c.voxel);
    expectConsistent(shell, 2000);
    const double deficit = worstDeficit(shell, c.radius, c.shaft);
    EXPECT_LE(deficit, 0.02 * c.voxel);
    const double stated = shell.burrSpacing * shell.burrSpacing / (2.0 * c.radius);
    EXPECT_LE(deficit, stated * (1.0 + 1e-9));
    EXPECT_GE(deficit, 0.8 * stated) << "the spacing is measured, not guessed high";
    EXPECT_LE(stated, 0.02 * c.voxel);
  }
}

TEST(PointShell, BurrTakesHardlyMorePointsThanAnEvenLattice)
{
  BurrShape shape;
  const PointShell shell = makeBurrShell(shape, 0.3);
  // Cells s^2 sqrt(3)/2 with s^2 = 6 R 0.02 voxel on the sphere without the part that the shaft
  // hides.
  const double area = 2.0 * kPi * 2.0 * (2.0 + 1.6);
  const double ideal = area / (6.0 * 2.0 * 0.02 * 0.3 * std::sqrt(0.75));
  EXPECT_GT(static_cast<double>(shell.burrCount), ideal);
  EXPECT_LT(static_cast<double>(shell.burrCount), 1.25 * ideal);
}

TEST(PointShell, BurrPointsComeFirstAndNoneIsInsideTheShaft)
{
  BurrShape shape;
  shape.radius = 2.5;
  const double neck = std::sqrt(2.5 * 2.5 - 1.2 * 1.2);
  const PointShell shell = makeBurrShell(shape, 0.3);
  for (std::size_t i = 0; i < shell.points.size(); ++i)
  {
    const Vector3d& p = shell.points[i];
    const double axial = std::hypot(p.x(), p.y());
    if (i < shell.burrCount)
    {
      ASSERT_NEAR(p.norm(), 2.5, 1e-12);
      ASSERT_LE(p.z(), neck + 1e-12);
      ASSERT_NEAR((shell.normals[i] - p / 2.5).norm(), 0.0, 1e-12);
    }
    else if (p.z() < 30.0)
    {
      ASSERT_NEAR(axial, 1.2, 1e-12) << "shaft";
      ASSERT_GT(p.z(), neck);
      ASSERT_NEAR((shell.normals[i] - Vector3d(p.x(), p.y(), 0) / 1.2).norm(), 0.0, 1e-12);
    }
    else if (p.z() == 30.0 && axial < 6.0 - 1e-9)
    {
      ASSERT_GE(axial, 1.2 - 1e-9) << "front disc";
      ASSERT_EQ(shell.normals[i], axial < 1.2 + 1e-9 ? shell.normals[i] : Vector3d(0, 0, -1));
    }
    else
    {
      ASSERT_NEAR(axial, 6.0, 1e-12) << "handpiece";
      ASSERT_LE(p.z(), 90.0 + 1e-9);
      ASSERT_GT(shell.normals[i].dot(Vector3d(p.x(), p.y(), 0)), 0.0);
    }
  }
}

TEST(PointShell, SpacingOfABurrIsTheFarthestPlaceOfItsSurface)
{
  BurrShape shape;
  shape.radius = 3.0;
  shape.shaftRadius = 1.5;
  shape.handpieceRadius = 4.0;
  shape.handpieceLength = 20.0;
  const PointShell shell = makeBurrShell(shape, 0.4, 1500);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share;
  const double neck = std::sqrt(9.0 - 2.25);
  double worst = 0.0;
  double worstOnBurr = 0.0;
  for (int n = 0; n < 15000; ++n)
  {
    const Vector3d onBurr = 3.0 * randomDirection(random);
    if (onBurr.z() < neck)
      worstOnBurr = std::max(worstOnBurr, nearest(shell, onBurr));
    const double angle = 2.0 * kPi * share(random);
    const Vector3d ray(std::cos(angle), std::sin(angle), 0.0);
    const Vector3d up(0.0, 0.0, 1.0);
    worst = std::max(worst, nearest(shell, 1.5 * ray + (neck + (30 - neck) * share(random)) * up));
    worst = std::max(worst, nearest(shell, (1.5 + 2.5 * share(random)) * ray + 30.0 * up));
    worst = std::max(worst, nearest(shell, 4.0 * ray + (30.0 + 20.0 * share(random)) * up));
  }
  EXPECT_LE(worst, shell.spacing);
  EXPECT_GE(worst, 0.9 * shell.spacing);
  EXPECT_LE(worstOnBurr, shell.burrSpacing);
  EXPECT_GE(worstOnBurr, 0.9 * shell.burrSpacing);
}

TEST(PointShell, ASmallBudgetIsKeptAndTheBurrGetsMostOfIt)
{
  BurrShape shape;
  shape.radius = 5.0;
  for (const std::size_t budget : {200u, 333u, 1000u})
  {
    const PointShell shell = makeBurrShell(shape, 0.1, budget);
    expectConsistent(shell, budget);
    EXPECT_GE(5 * shell.burrCount, 3 * budget);
    const double stated = shell.burrSpacing * shell.burrSpacing / 10.0;
    EXPECT_GT(stated, 0.02 * 0.1) << "the bound cannot be kept, and that is said";
    EXPECT_LE(worstDeficit(shell, 5.0, 1.2), stated);
  }
}

TEST(PointShell, OddToolsKeepTheBudget)
{
  BurrShape plate;
  plate.handpieceRadius = 50.0;
  plate.handpieceLength = 0.1;
  expectConsistent(makeBurrShell(plate, 0.3, 1200), 1200);
  expectConsistent(makeBurrShell(plate, 10.0, 200), 200);
  BurrShape pin;
  pin.radius = 0.25;
  pin.shaftRadius = 0.25;
  pin.handpieceRadius = 0.25;
  expectConsistent(makeBurrShell(pin, 10.0, 200), 200);
  BurrShape bare;
  bare.handpieceRadius = 0.0;
  const PointShell shell = makeBurrShell(bare, 0.3);
  expectConsistent(shell, 2000);
  EXPECT_NEAR(shell.reach, std::hypot(30.0, 1.2), 1e-9) << "the end of the shaft";
}

TEST(PointShell, NamesTheValueOfABurrThatIsOutOfItsDomain)
{
  const auto with = [](double BurrShape::*value, double is)
  {
    BurrShape shape;
    shape.*value = is;
    return refusal([&] { makeBurrShell(shape, 0.3); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(with(&BurrShape::radius, 0.2),
            "burr: the radius is 0.2 mm; it must lie between 0.25 and 5 mm");
  EXPECT_NE(with(&BurrShape::radius, nan).find("the radius is nan"), std::string::npos);
  EXPECT_NE(with(&BurrShape::shaftRadius, 2.1).find("shaft's radius"), std::string::npos);
  EXPECT_NE(with(&BurrShape::shaftLength, 1.9).find("shaft's length"), std::string::npos);
  EXPECT_NE(with(&BurrShape::handpieceRadius, 1.0).find("handpiece's radius"), std::string::npos);
  EXPECT_NE(with(&BurrShape::handpieceLength, 0.0).find("handpiece's length"), std::string::npos);
  EXPECT_NE(refusal([] { makeBurrShell({}, 0.0); }).find("voxel"), std::string::npos);
  EXPECT_NE(refusal([] { makeBurrShell({}, 0.3, 199); }).find("199"), std::string::npos);
  EXPECT_NE(refusal([] { makeBurrShell({}, 0.3, 20001); }).find("20001"), std::string::npos);
}
