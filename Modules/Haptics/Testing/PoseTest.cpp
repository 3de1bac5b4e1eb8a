#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Haptics/Pose.h"

using namespace petrous::haptics;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

Vector3d randomDirection(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Pose randomPose(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Pose pose{{30.0 * normal(random), 30.0 * normal(random), 30.0 * normal(random)},
            Quaterniond(normal(random), normal(random), normal(random), normal(random))};
  pose.rotation.normalize();
  return pose;
}

} // namespace

TEST(Pose, RotationVectorAndQuaternionAreInverse)
{
  std::mt19937 random(1);
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-8, 9.9e-5, 1e-4, 1.01e-4, 2e-4, 2.01e-4, 1e-3,
                             0.1, 1.0, 0.5 * kPi, 3.0, kPi - 1e-3, kPi - 1e-6, kPi - 1e-9})
    for (int n = 0; n < 200; ++n)
    {
      const Vector3d vector = angle * randomDirection(random);
      const Vector3d back = rotationVector(rotationFrom(vector));
      ASSERT_LE((back - vector).norm(), 1e-14 * std::max(1.0, angle)) << angle;
      ASSERT_LE((back - vector).norm(), 1e-14 * angle) << angle << ": relative, too";
    }
}

TEST(Pose, QuaternionOfARotationVectorTurnsAsRodriguesSays)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angles(0.0, kPi);
  for (int n = 0; n < 1000; ++n)
  {
    const Vector3d axis = randomDirection(random);
    const double angle = n % 2 == 0 ? angles(random) : 1e-4 * angles(random);
    const Vector3d p = randomDirection(random);
    const Vector3d turned = std::cos(angle) * p + std::sin(angle) * axis.cross(p) +
                            (1.0 - std::cos(angle)) * axis.dot(p) * axis;
    ASSERT_LE((rotationFrom(angle * axis) * p - turned).norm(), 1e-14);
  }
}

TEST(Pose, BothSignsOfAQuaternionGiveTheShorterTurn)
{
  std::mt19937 random(3);
  for (int n = 0; n < 1000; ++n)
  {
    Quaterniond q = randomPose(random).rotation;
    const Vector3d vector = rotationVector(q);
    EXPECT_LE(vector.norm(), kPi + 1e-14);
    q.coeffs() *= -1.0;
    EXPECT_EQ(rotationVector(q), vector);
    EXPECT_LE((rotationFrom(vector).toRotationMatrix() - q.toRotationMatrix()).norm(), 1e-14);
  }
  EXPECT_EQ(rotationVector(Quaterniond(-1, 0, 0, 0)).norm(), 0.0);
}

TEST(Pose, MovedAndMotionBetweenAreInverse)
{
  std::mt19937 random(4);
  for (int n = 0; n < 1000; ++n)
  {
    const Pose from = randomPose(random);
    const Pose to = randomPose(random);
    const Pose back = moved(from, motionBetween(from, to));
    ASSERT_LE((back.position - to.position).norm(), 1e-13);
    ASSERT_LE((back.rotation.toRotationMatrix() - to.rotation.toRotationMatrix()).norm(), 2e-14);
    ASSERT_NEAR(back.rotation.norm(), 1.0, 1e-15);
  }
}

TEST(Pose, FractionsOfAMotionLieOnItsPath)
{
  std::mt19937 random(5);
  for (int n = 0; n < 200; ++n)
  {
    const Pose from = randomPose(random);
    const Motion motion = motionBetween(from, randomPose(random));
    const Motion half = motionBetween(from, moved(from, motion, 0.5));
    ASSERT_LE((half.linear - 0.5 * motion.linear).norm(), 1e-13);
    ASSERT_LE((half.angular - 0.5 * motion.angular).norm(), 2e-14);
    ASSERT_LE(motionBetween(from, moved(from, motion, 0.0)).angular.norm(), 1e-15);
  }
}

TEST(Pose, MotionTurnsInTheOuterFrame)
{
  const Pose from{{1, 2, 3}, rotationFrom({0.5 * kPi, 0, 0})};
  const Pose to = moved(from, {{0, 0, 4}, {0, 0, 0.5 * kPi}});
  // The body's y axis points along the outer z; a rotation about z does not change it.
  EXPECT_LE((to.rotation * Vector3d(0, 1, 0) - Vector3d(0, 0, 1)).norm(), 1e-15);
  EXPECT_LE((to.rotation * Vector3d(1, 0, 0) - Vector3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(to.position, Vector3d(1, 2, 7));
  EXPECT_LE((to * Vector3d(1, 0, 0) - Vector3d(1, 3, 7)).norm(), 1e-15);
}

TEST(Pose, KnowsWhatIsNoPose)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Pose{}.finite());
  EXPECT_FALSE((Pose{{0, nan, 0}, Quaterniond::Identity()}).finite());
  EXPECT_FALSE(
      (Pose{{0, 0, std::numeric_limits<double>::infinity()}, Quaterniond::Identity()}).finite());
  EXPECT_FALSE((Pose{{0, 0, 0}, Quaterniond(1, nan, 0, 0)}).finite());
  EXPECT_FALSE((Pose{{0, 0, 0}, Quaterniond(0, 0, 0, 0)}).finite());
  EXPECT_FALSE((Wrench{{0, 0, 0}, {nan, 0, 0}}).finite());
}
