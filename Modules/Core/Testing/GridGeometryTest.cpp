#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/GridGeometry.h"

using namespace petrous::core;
using Eigen::Vector3d;

namespace
{

GridGeometry oblique()
{
  const Eigen::Matrix3d direction =
      Eigen::AngleAxisd(0.4, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return {{40, 30, 20}, {0.45, 0.5, 1.25}, {-100.0, 35.5, 712.25}, direction};
}

} // namespace

TEST(GridGeometry, PutsTheFirstVoxelAtTheOrigin)
{
  EXPECT_LT((oblique().patientFromVoxel(Vector3d::Zero()) - Vector3d(-100.0, 35.5, 712.25)).norm(),
            1e-12);
}

TEST(GridGeometry, StepsOneSpacingAlongEachAxis)
{
  const GridGeometry grid = oblique();
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector3d step = grid.patientFromVoxel(Vector3d::Unit(axis)) - grid.origin();
    EXPECT_NEAR(step.norm(), grid.spacing()[axis], 1e-12);
    EXPECT_NEAR(step.normalized().dot(grid.direction().col(axis)), 1.0, 1e-12);
  }
}

TEST(GridGeometry, GoesToThePatientAndBackExactly)
{
  const GridGeometry grid = oblique();
  const Vector3d voxel(3.25, 17.5, 11.125);
  EXPECT_LT((grid.voxelFromPatient(grid.patientFromVoxel(voxel)) - voxel).norm(), 1e-10);
}

TEST(GridGeometry, AcceptsALeftHandedGrid)
{
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  flip(2, 2) = -1.0;
  const GridGeometry grid({2, 2, 2}, Vector3d::Ones(), Vector3d::Zero(), flip);
  EXPECT_DOUBLE_EQ(grid.patientFromVoxel({0, 0, 1})[2], -1.0);
}

TEST(GridGeometry, RefusesWhatIsNoGrid)
{
  const Vector3d one = Vector3d::Ones();
  const Vector3d zero = Vector3d::Zero();
  EXPECT_THROW(GridGeometry({0, 2, 2}, one, zero), InvalidParameter);
  EXPECT_THROW(GridGeometry({2, 2, 2}, {1, 0, 1}, zero), InvalidParameter);
  EXPECT_THROW(GridGeometry({2, 2, 2}, one, {0, std::numeric_limits<double>::quiet_NaN(), 0}),
               InvalidParameter);
  Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
  sheared(0, 2) = 0.1;
  EXPECT_THROW(GridGeometry({2, 2, 2}, one, zero, sheared), InvalidParameter);
}

TEST(GridGeometry, CropsWithoutMovingAVoxel)
{
  const GridGeometry grid = oblique();
  const GridGeometry part = grid.cropped({{5, 6, 7}, {15, 20, 19}});
  EXPECT_EQ(part.dims(), (Index3{10, 14, 12}));
  EXPECT_LT((part.patientFromVoxel({2, 3, 4}) - grid.patientFromVoxel({7, 9, 11})).norm(), 1e-10);
  EXPECT_THROW(grid.cropped({{35, 0, 0}, {41, 5, 5}}), InvalidParameter);
  EXPECT_THROW(grid.cropped({{5, 5, 5}, {5, 9, 9}}), InvalidParameter);
}

TEST(GridGeometry, CoversAPatientBoxTightly)
{
  const GridGeometry grid({11, 11, 11}, Vector3d::Constant(2.0), Vector3d::Zero());
  EXPECT_EQ(grid.boxCovering({4.0, 4.1, 3.9}, {8.0, 8.0, 8.1}), (IndexBox{{2, 2, 1}, {5, 5, 6}}));
  EXPECT_TRUE(grid.boxCovering({21, 0, 0}, {30, 5, 5}).empty());
  EXPECT_EQ(grid.boxCovering({-9, -9, -9}, {99, 99, 99}), grid.fullBox());
}

TEST(GridGeometry, BoundsHoldEveryCorner)
{
  const GridGeometry grid = oblique();
  const PatientBox bounds = grid.patientBounds();
  for (const double i : {0.0, 39.0})
    for (const double k : {0.0, 19.0})
    {
      const Vector3d p = grid.patientFromVoxel({i, 29.0, k});
      EXPECT_LT(bounds.exteriorDistance(p), 1e-9);
    }
}

TEST(IndexBox, UnitesAndIntersects)
{
  const IndexBox a{{0, 0, 0}, {4, 4, 4}};
  const IndexBox b{{2, 3, 1}, {6, 5, 2}};
  EXPECT_EQ(a.intersected(b), (IndexBox{{2, 3, 1}, {4, 4, 2}}));
  EXPECT_EQ(a.united(b), (IndexBox{{0, 0, 0}, {6, 5, 4}}));
  EXPECT_EQ(a.united(IndexBox{}), a);
  EXPECT_TRUE(a.intersected({{9, 9, 9}, {10, 10, 10}}).empty());
  EXPECT_EQ(b.count(), 8u);
}

TEST(SameGrid, ComparesCorners)
{
  const GridGeometry grid = oblique();
  const GridGeometry moved(grid.dims(), grid.spacing(), grid.origin() + Vector3d(0, 0, 0.01),
                           grid.direction());
  EXPECT_TRUE(sameGrid(grid, grid));
  EXPECT_FALSE(sameGrid(grid, moved));
  EXPECT_TRUE(sameGrid(grid, moved, 0.02));
}
