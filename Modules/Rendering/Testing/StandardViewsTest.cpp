#include "petrous/Rendering/StandardViews.h"

#include <tuple>

#include <gtest/gtest.h>

#include "SyntheticScenes.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{
Eigen::Vector3d eyeSide(StandardView view, const core::GridGeometry& grid)
{
  const core::CameraPose pose = standardCamera(view, grid);
  return (pose.position - pose.focalPoint).normalized();
}
core::GridGeometry gridAt(double x)
{
  return synthetic::cube(20, 1.0, Eigen::Matrix3d::Identity(), {x, 5.0, -7.0});
}
} // namespace

TEST(StandardViews, KnowTheirNamesAndNoOthers)
{
  for (const char* name : {"lateral", "left", "right", "superior", "inferior", "anterior",
                           "posterior", "surgical-left", "surgical-right"})
  {
    ASSERT_TRUE(parseView(name)) << name;
    EXPECT_EQ(nameOf(*parseView(name)), name);
  }
  EXPECT_FALSE(parseView("Lateral"));
  EXPECT_FALSE(parseView(""));
}

TEST(StandardViews, LookFromTheSideTheyName)
{
  const core::GridGeometry grid = gridAt(0.0);
  EXPECT_TRUE(eyeSide(StandardView::Left, grid).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE(eyeSide(StandardView::Right, grid).isApprox(Eigen::Vector3d(-1, 0, 0)));
  EXPECT_TRUE(eyeSide(StandardView::Anterior, grid).isApprox(Eigen::Vector3d(0, -1, 0)));
  EXPECT_TRUE(eyeSide(StandardView::Posterior, grid).isApprox(Eigen::Vector3d(0, 1, 0)));
  EXPECT_TRUE(eyeSide(StandardView::Superior, grid).isApprox(Eigen::Vector3d(0, 0, 1)));
  EXPECT_TRUE(eyeSide(StandardView::Inferior, grid).isApprox(Eigen::Vector3d(0, 0, -1)));
}

TEST(StandardViews, LateralIsTheSideOfTheVolumeAndRightNearTheMidline)
{
  EXPECT_GT(eyeSide(StandardView::Lateral, gridAt(40.0)).x(), 0.9);
  EXPECT_GT(eyeSide(StandardView::Lateral, gridAt(10.1)).x(), 0.9);
  EXPECT_LT(eyeSide(StandardView::Lateral, gridAt(9.9)).x(), -0.9);
  EXPECT_LT(eyeSide(StandardView::Lateral, gridAt(-40.0)).x(), -0.9);
}

// On the back, the head turned to the left: the face is away from a surgeon at the right ear, whose
// right hand is towards the feet.
TEST(StandardViews, SurgicalIsTheTurnedHeadSeenFromTheEar)
{
  const Eigen::Vector3d anterior(0, -1, 0);
  const Eigen::Vector3d superior(0, 0, 1);
  for (const auto& [view, ear, right] :
       {std::tuple(StandardView::SurgicalRight, Eigen::Vector3d(-1, 0, 0),
                   Eigen::Vector3d(-superior)),
        std::tuple(StandardView::SurgicalLeft, Eigen::Vector3d(1, 0, 0), superior)})
  {
    const core::CameraPose pose = standardCamera(view, gridAt(0.0));
    const Eigen::Vector3d forward = (pose.focalPoint - pose.position).normalized();
    EXPECT_TRUE(forward.isApprox(-ear));
    EXPECT_TRUE(pose.viewUp.isApprox(anterior));
    EXPECT_TRUE(forward.cross(pose.viewUp).isApprox(right));
  }
}

TEST(StandardViews, FrameTheBoundingSphere)
{
  const core::GridGeometry grid = gridAt(30.0);
  const core::CameraPose pose = standardCamera(StandardView::Posterior, grid);
  const double radius = 0.5 * std::sqrt(3.0) * 19.0;
  const double distance = (pose.position - pose.focalPoint).norm();
  EXPECT_TRUE(pose.focalPoint.isApprox(grid.center()));
  EXPECT_NEAR(std::asin(radius / distance) * 180.0 / M_PI, 15.0, 1e-9);
  EXPECT_EQ(pose.viewAngle, 30.0);
}

TEST(StandardViews, HoldSuperiorUpAndAnteriorUpWhereSeenAlongTheBody)
{
  const core::GridGeometry grid = gridAt(0.0);
  EXPECT_EQ(standardCamera(StandardView::Lateral, grid).viewUp, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(standardCamera(StandardView::Superior, grid).viewUp, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(standardCamera(StandardView::Inferior, grid).viewUp, Eigen::Vector3d(0, -1, 0));
}
