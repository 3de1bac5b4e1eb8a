#include <gtest/gtest.h>

#include "petrous/Interaction/OrbitCamera.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{
// Looks from posterior, superior up: the patient's right is on the right.
core::CameraPose fromBehind()
{
  core::CameraPose camera;
  camera.position = {0, 100, 0};
  camera.focalPoint = {0, 0, 0};
  camera.viewUp = {0, 0, 1};
  return camera;
}
} // namespace

TEST(OrbitCamera, TurnsWhatIsInFrontToTheRight)
{
  const auto next = interaction::turned(fromBehind(), 90.0, 0.0);
  // Screen right is forward x up = (0,-1,0) x (0,0,1) = (-1,0,0); the camera moves to the left.
  EXPECT_LT((next.position - Vector3d(100, 0, 0)).norm(), 1e-9);
  EXPECT_LT((next.viewUp - Vector3d(0, 0, 1)).norm(), 1e-9);
}

// What was up goes to the right.
TEST(OrbitCamera, RollsThePictureClockwise)
{
  const auto next = interaction::rolled(fromBehind(), 90.0);
  EXPECT_EQ(next.position, fromBehind().position);
  const auto edges = interaction::edgeDirections(next);
  EXPECT_EQ(edges.right, "S");
  EXPECT_EQ(edges.bottom, interaction::edgeDirections(fromBehind()).right);
}

TEST(OrbitCamera, TurnsOverThePoleWithoutAStop)
{
  auto camera = fromBehind();
  for (int n = 0; n < 36; ++n)
    camera = interaction::turned(camera, 0.0, 10.0);
  EXPECT_LT((camera.position - Vector3d(0, 100, 0)).norm(), 1e-6);
  EXPECT_LT((camera.viewUp - Vector3d(0, 0, 1)).norm(), 1e-9);
  const auto above = interaction::turned(fromBehind(), 0.0, 90.0);
  EXPECT_LT((above.position - Vector3d(0, 0, 100)).norm(), 1e-9);
}

TEST(OrbitCamera, ZoomsToTheFocalPointWithinItsLimits)
{
  EXPECT_NEAR(interaction::zoomed(fromBehind(), 2.0).position.y(), 50.0, 1e-9);
  EXPECT_NEAR(interaction::zoomed(fromBehind(), 1e9).position.y(), 1.0, 1e-9);
  EXPECT_NEAR(interaction::zoomed(fromBehind(), 0.0).position.y(), 100.0, 1e-9);
  auto parallel = fromBehind();
  parallel.parallelScale = 40.0;
  EXPECT_NEAR(*interaction::zoomed(parallel, 2.0).parallelScale, 20.0, 1e-12);
}

TEST(OrbitCamera, ShiftMovesThePatientWithThePointer)
{
  auto camera = fromBehind();
  camera.parallelScale = 50.0; // the picture is 100 mm high
  const auto next = interaction::shifted(camera, 0.25, 0.5);
  EXPECT_LT((next.focalPoint - Vector3d(25, 0, 50)).norm(), 1e-9);
  EXPECT_LT((next.position - next.focalPoint - Vector3d(0, 100, 0)).norm(), 1e-9);
}

TEST(OrbitCamera, NamesThePatientsDirectionsAtThePicturesEdges)
{
  const auto edges = interaction::edgeDirections(fromBehind());
  EXPECT_EQ(edges.right, "R");
  EXPECT_EQ(edges.left, "L");
  EXPECT_EQ(edges.top, "S");
  EXPECT_EQ(edges.bottom, "I");
  EXPECT_EQ(interaction::directionLetters({0.1, -0.6, 0.8}), "SA");
  EXPECT_EQ(interaction::directionLetters({0, 0, 0}), "");
}
