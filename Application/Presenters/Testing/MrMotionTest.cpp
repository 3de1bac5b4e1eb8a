#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "petrous/Presenters/LandmarkList.h"
#include "petrous/Presenters/MrMotion.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{
const core::RigidTransform kSome{
    Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, 2, -2).normalized())),
    Vector3d(11, -4, 7)};
}

// Where a point of the MR appears on the CT: the inverse of X_MC.
TEST(MrMotion, ShiftMovesThePictureByTheMillimetresGiven)
{
  const Vector3d inMr(3, 9, -20);
  const Vector3d before = kSome.inverse() * inMr;
  const Vector3d after = shifted(kSome, {0.1, -1.0, 2.0}).inverse() * inMr;
  EXPECT_LT((after - before - Vector3d(0.1, -1.0, 2.0)).norm(), 1e-12);
}

TEST(MrMotion, TurnLeavesItsCentreAndTurnsTheRestRightHanded)
{
  const Vector3d about(5, 6, 7);
  const auto after = turned(kSome, Vector3d::UnitZ(), 90.0, about);
  EXPECT_LT((after.inverse() * (kSome * about) - about).norm(), 1e-12);
  // Ten millimetres to the left of it go to ten millimetres behind it: x to y about z.
  const Vector3d left = about + Vector3d(10, 0, 0);
  const Vector3d seen = after.inverse() * (kSome * left);
  EXPECT_LT((seen - about - Vector3d(0, 10, 0)).norm(), 1e-12);
}

TEST(MrMotion, BringsAPointOfTheMrToOneOfTheCtWithoutTurning)
{
  const auto after = broughtTo(kSome, {1, 2, 3}, {-30, 0, 5});
  EXPECT_LT((after * Vector3d(-30, 0, 5) - Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT(after.rotation().angularDistance(kSome.rotation()), 1e-12);
}

TEST(MrMotion, DifferenceIsTheShiftAtThePlaceAndTheTurn)
{
  const Vector3d at(5, 6, 7);
  const auto moved = turned(shifted(kSome, {0, 3, 4}), Vector3d::UnitX(), 2.5, at);
  const MrDifference d = difference(kSome, moved, at);
  EXPECT_NEAR(d.shift, 5.0, 1e-9);
  EXPECT_NEAR(d.turn, 2.5, 1e-9);
}

TEST(LandmarkList, PairsAPointOfTheCtWithTheNextOfTheMr)
{
  LandmarkList list;
  list.addMr({1, 1, 1}); // there is no CT point for it
  EXPECT_TRUE(list.rows().empty());
  list.addCt({0, 0, 0});
  list.addCt({5, 0, 0}); // replaces the first
  ASSERT_EQ(list.rows().size(), 1U);
  EXPECT_EQ(list.pairs(), 0U);
  EXPECT_FALSE(list.residual(0, {}).has_value());
  list.addMr({5, 3, 4});
  EXPECT_EQ(list.pairs(), 1U);
  EXPECT_DOUBLE_EQ(*list.residual(0, {}), 5.0);
  EXPECT_DOUBLE_EQ(*list.residual(0, {Eigen::Quaterniond::Identity(), {0, 3, 4}}), 0.0);
  list.remove(7);
  EXPECT_EQ(list.pairs(), 1U);
  list.remove(0);
  EXPECT_TRUE(list.rows().empty());
}
