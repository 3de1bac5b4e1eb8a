#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/RigidTransform.h"

using namespace petrous::core;
using Eigen::Vector3d;

namespace
{

RigidTransform quarterTurn()
{
  return {Eigen::Quaterniond(Eigen::AngleAxisd(std::acos(0.0), Vector3d::UnitZ())), {1, 2, 3}};
}

} // namespace

TEST(RigidTransform, RotatesThenMoves)
{
  EXPECT_LT((quarterTurn() * Vector3d(1, 0, 0) - Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST(RigidTransform, InverseUndoes)
{
  const Vector3d p(4, -5, 6);
  EXPECT_LT((quarterTurn().inverse() * (quarterTurn() * p) - p).norm(), 1e-12);
}

TEST(RigidTransform, ComposesAsMatricesDo)
{
  const RigidTransform a = quarterTurn();
  const RigidTransform b(Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2), {-7, 0.5, 2});
  EXPECT_LT(((a * b).matrix() - a.matrix() * b.matrix()).norm(), 1e-12);
}

TEST(RigidTransform, StaysARotationOverAMillionSteps)
{
  const RigidTransform step(Eigen::Quaterniond(1.0, 1e-3, 2e-3, -1e-3), {0, 0, 0});
  RigidTransform x;
  for (int n = 0; n < 1000000; ++n)
    x = x * step;
  EXPECT_NEAR(x.rotation().norm(), 1.0, 1e-12);
}

TEST(RigidTransform, RefusesShearScaleAndMirror)
{
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m(0, 1) = 0.01;
  EXPECT_THROW(RigidTransform::fromMatrix(m), InvalidParameter);
  m = Eigen::Matrix4d::Identity() * 2.0;
  EXPECT_THROW(RigidTransform::fromMatrix(m), InvalidParameter);
  m = Eigen::Matrix4d::Identity();
  m(0, 0) = -1.0;
  EXPECT_THROW(RigidTransform::fromMatrix(m), InvalidParameter);
  EXPECT_THROW(RigidTransform(Eigen::Quaterniond(0, 0, 0, 0), Vector3d::Zero()), InvalidParameter);
}

TEST(RigidTransform, ComesBackFromItsMatrix)
{
  const RigidTransform x = quarterTurn();
  EXPECT_LT((RigidTransform::fromMatrix(x.matrix()).matrix() - x.matrix()).norm(), 1e-12);
}
