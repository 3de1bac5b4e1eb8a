// Faces, sections and limits of a box against plane geometry.
#include "petrous/Presenters/BoxHandles.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace petrous;
using Eigen::Vector2d;
using Eigen::Vector3d;
using presenters::BoxFaces;
using presenters::BoxInSlice;
using presenters::CropFrame;
using presenters::HandledBox;
using presenters::SliceGeometry;
using presenters::SliceOrientation;

namespace
{

HandledBox boxOf(const Vector3d& low, const Vector3d& high)
{
  HandledBox box;
  box.box = {low, high};
  return box;
}

// 0.5 mm a pixel, the origin of the patient at pixel (100, 100).
SliceGeometry axial(double z)
{
  return {SliceOrientation::Axial, Vector3d(0.0, 0.0, z), 0.5, 201, 201};
}

double areaOf(const BoxInSlice& section)
{
  double twice = 0.0;
  for (const BoxInSlice::Edge& edge : section.edges())
    twice += edge.from[0] * edge.to[1] - edge.from[1] * edge.to[0];
  return 0.5 * std::abs(twice);
}

} // namespace

TEST(BoxInSlice, IsARectangleWhoseEdgesBelongToTheirFaces)
{
  const SliceGeometry slice = axial(3.0);
  const BoxInSlice section(boxOf({-20.0, -10.0, 0.0}, {30.0, 15.0, 8.0}), slice);
  EXPECT_TRUE(section.isSection());
  ASSERT_EQ(section.edges().size(), 4U);
  EXPECT_NEAR(areaOf(section) * 0.25, 50.0 * 25.0, 1e-6); // mm^2
  const auto facesAt = [&](const Vector3d& patient)
  { return section.facesAt(slice.pixelFromPatient(patient), 4.0); };
  const BoxFaces left = facesAt({30.0, 0.0, 3.0});
  EXPECT_TRUE(left.upper[0]);
  EXPECT_FALSE(left.lower[0] || left.lower[1] || left.upper[1] || left.lower[2] || left.upper[2]);
  const BoxFaces corner = facesAt({-20.0, 15.0, 3.0});
  EXPECT_TRUE(corner.lower[0] && corner.upper[1]);
  EXPECT_FALSE(corner.upper[0] || corner.lower[1]);
  EXPECT_FALSE(facesAt({0.0, 0.0, 3.0}).any());
  EXPECT_FALSE(facesAt({30.0, 22.0, 3.0}).any()) << "an edge ends at its corners";
  EXPECT_TRUE(section.contains(slice.pixelFromPatient({0.0, 0.0, 3.0})));
  EXPECT_FALSE(section.contains(slice.pixelFromPatient({31.0, 0.0, 3.0})));
  const BoxFaces inside = section.insideFaces();
  EXPECT_TRUE(inside.lower[0] && inside.upper[0] && inside.lower[1] && inside.upper[1]);
  EXPECT_FALSE(inside.lower[2] || inside.upper[2]);
}

TEST(BoxInSlice, IsTheExtendedBoxBesideIt)
{
  const HandledBox box = boxOf({-20.0, -10.0, 0.0}, {30.0, 15.0, 8.0});
  const BoxInSlice beside(box, axial(9.0));
  EXPECT_FALSE(beside.isSection());
  EXPECT_NEAR(areaOf(beside) * 0.25, 50.0 * 25.0, 1e-6);
  EXPECT_TRUE(BoxInSlice(box, axial(8.0)).isSection()) << "a slice in a face";
}

// A plane across the diagonal of a cube of edge a cuts a regular hexagon of area 3 sqrt(3)/4 a^2.
TEST(BoxInSlice, OfACubeAcrossItsDiagonalIsARegularHexagon)
{
  const Vector3d next = Vector3d(1.0, 1.0, 1.0).normalized();
  const Vector3d right = Vector3d(1.0, -1.0, 0.0).normalized();
  const SliceGeometry slice(SliceOrientation::Axial, {right, next.cross(right), next},
                            Vector3d(5.0, 5.0, 5.0), 0.25, 301, 301);
  const BoxInSlice section(boxOf({0.0, 0.0, 0.0}, {10.0, 10.0, 10.0}), slice);
  ASSERT_EQ(section.edges().size(), 6U);
  EXPECT_NEAR(areaOf(section) * 0.25 * 0.25, 0.75 * std::sqrt(3.0) * 100.0, 1e-4);
  // The middle of each edge lies in the face that it is said to belong to.
  for (const BoxInSlice::Edge& edge : section.edges())
  {
    const Vector2d middle = 0.5 * (edge.from + edge.to);
    const Vector3d patient = slice.patientFromPixel(middle[0], middle[1]);
    EXPECT_NEAR(patient[static_cast<Eigen::Index>(edge.axis)], edge.isUpper ? 10.0 : 0.0, 1e-5);
  }
}

TEST(MovedBox, KeepsWithinItsBoundsAndItsLeastWidth)
{
  const Eigen::AlignedBox3d bounds(Vector3d::Zero(), Vector3d::Constant(100.0));
  const Eigen::AlignedBox3d box(Vector3d::Constant(20.0), Vector3d::Constant(60.0));
  const Vector3d least = Vector3d::Constant(5.0);
  BoxFaces lower;
  lower.lower[0] = true;
  const auto by = [&](const BoxFaces& faces, double step)
  { return presenters::moved(box, faces, Vector3d::Constant(step), bounds, least); };
  EXPECT_EQ(by(lower, 7.5).min(), Vector3d(27.5, 20.0, 20.0));
  EXPECT_EQ(by(lower, 7.5).max(), box.max());
  EXPECT_EQ(by(lower, -50.0).min()[0], 0.0);
  EXPECT_EQ(by(lower, 50.0).min()[0], 55.0);
  BoxFaces upper;
  upper.upper[2] = true;
  EXPECT_EQ(by(upper, 500.0).max(), Vector3d(60.0, 60.0, 100.0));
  EXPECT_EQ(by(upper, -500.0).max(), Vector3d(60.0, 60.0, 25.0));
  BoxFaces both;
  both.lower[1] = both.upper[1] = true;
  EXPECT_EQ(by(both, 70.0).min(), Vector3d(20.0, 60.0, 20.0));
  EXPECT_EQ(by(both, 70.0).max(), Vector3d(60.0, 100.0, 60.0)) << "of the same size";
  EXPECT_EQ(by(both, -30.0).min()[1], 0.0);
}

TEST(FaceHandles, LieInTheMiddleOfTheirFacesAndPointOutwards)
{
  HandledBox box = boxOf({0.0, 2.0, 4.0}, {10.0, 22.0, 34.0});
  const Eigen::AngleAxisd turn(0.5, Vector3d(1.0, 2.0, 3.0).normalized());
  box.patientFromBox.linear() = turn.toRotationMatrix();
  const Vector3d middle = turn * Vector3d(5.0, 12.0, 19.0);
  const double half[] = {5.0, 10.0, 15.0};
  for (const presenters::FaceHandle& handle : presenters::faceHandles(box))
  {
    const double side = handle.isUpper ? 1.0 : -1.0;
    const Vector3d out = side * (turn * Vector3d::Unit(static_cast<Eigen::Index>(handle.axis)));
    EXPECT_LT((handle.normal - out).norm(), 1e-12);
    EXPECT_LT((handle.at - middle - half[handle.axis] * out).norm(), 1e-12);
  }
}

TEST(ClosestAlong, IsTheFootOfTheCommonPerpendicular)
{
  // A line along x through (0, 2, 0), and a ray along y that passes 3 mm above it at x = 7.
  const interaction::PickRay ray{{7.0, -50.0, 3.0}, Vector3d::UnitY()};
  const auto found = presenters::closestAlong({0.0, 2.0, 0.0}, Vector3d::UnitX(), ray);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 7.0, 1e-12);
  // Whatever the two are: the connection is perpendicular to both.
  const Vector3d direction = Vector3d(1.0, -2.0, 0.5).normalized();
  const Vector3d point(3.0, 1.0, -4.0);
  const interaction::PickRay skew{{-20.0, 5.0, 9.0}, Vector3d(2.0, 1.0, 1.0).normalized()};
  const auto along = presenters::closestAlong(point, direction, skew);
  ASSERT_TRUE(along);
  const Vector3d foot = point + *along * direction;
  const Vector3d apart = skew.at(skew.direction.dot(foot - skew.origin)) - foot;
  EXPECT_NEAR(apart.dot(direction), 0.0, 1e-9);
  EXPECT_FALSE(presenters::closestAlong(point, skew.direction, skew));
}

TEST(CropFrame, IsThePatientsForAnImageAlongItsAxesWhicheverWayTheyRun)
{
  Eigen::Matrix3d direction = Eigen::Matrix3d::Zero(); // sagittal slices, from left to right
  direction(1, 0) = 1.0;
  direction(2, 1) = -1.0;
  direction(0, 2) = -1.0;
  const core::GridGeometry grid({40, 60, 30}, {0.5, 0.5, 1.0}, {15.0, -10.0, 20.0}, direction);
  const CropFrame frame(grid);
  const HandledBox whole = frame.box(std::nullopt);
  EXPECT_TRUE(whole.patientFromBox.linear().isApprox(Eigen::Matrix3d::Identity()));
  EXPECT_LT((whole.box.min() - Vector3d(-14.0, -10.0, -9.5)).norm(), 1e-12);
  EXPECT_LT((whole.box.max() - Vector3d(15.0, 9.5, 20.0)).norm(), 1e-12);
  const core::IndexBox some{{4, 10, 2}, {30, 40, 20}};
  const HandledBox part = frame.box(some);
  // Voxels 4 to 29, 10 to 39 and 2 to 19.
  EXPECT_LT((part.box.min() - Vector3d(-4.0, -8.0, 0.5)).norm(), 1e-12);
  EXPECT_LT((part.box.max() - Vector3d(13.0, 4.5, 15.0)).norm(), 1e-12);
  EXPECT_EQ(frame.crop(part.box), some);
  EXPECT_FALSE(frame.crop(whole.box)) << "all of the image";
}

TEST(CropFrame, DragsAFaceByWholeVoxelsWithinTheImageAndFiveMillimetresApart)
{
  const core::GridGeometry grid({50, 50, 50}, {0.4, 0.4, 0.4}, {0.0, 0.0, 0.0});
  const CropFrame frame(grid);
  BoxFaces lower;
  lower.lower[0] = true;
  const auto dragged = [&](double millimetres)
  {
    return frame.dragged(std::nullopt, lower, Vector3d(0.0, 3.0, 7.0),
                         Vector3d(millimetres, 9.0, 7.0));
  };
  EXPECT_EQ(dragged(2.1), (core::IndexBox{{5, 0, 0}, {50, 50, 50}})) << "2 mm are 5 voxels";
  EXPECT_FALSE(dragged(-3.0));
  // 13 voxels of 0.4 mm are the least of 5 mm: the last face lies at voxel 49.
  EXPECT_EQ(dragged(100.0), (core::IndexBox{{36, 0, 0}, {50, 50, 50}}));
  const auto back = frame.dragged(dragged(2.1), lower, Vector3d::Zero(), Vector3d(-2.0, 0.0, 0.0));
  EXPECT_FALSE(back);
}

TEST(CropFrame, OfAThinImageLeavesItsWidth)
{
  const core::GridGeometry grid({50, 50, 4}, {0.4, 0.4, 1.0}, {0.0, 0.0, 0.0});
  const CropFrame frame(grid);
  EXPECT_EQ(frame.least()[2], 3.0);
  BoxFaces upper;
  upper.upper[2] = true;
  EXPECT_FALSE(frame.dragged(std::nullopt, upper, Vector3d::Zero(), Vector3d(0.0, 0.0, -2.0)));
}

TEST(CropFrame, OfATurnedImageFollowsItsAxes)
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Vector3d(0.2, -0.5, 1.0).normalized()).toRotationMatrix();
  const core::GridGeometry grid({50, 60, 70}, {0.5, 0.5, 0.5}, {-3.0, 4.0, 5.0}, turn);
  const CropFrame frame(grid);
  EXPECT_TRUE(frame.bounds().sizes().isApprox(Vector3d(24.5, 29.5, 34.5)));
  BoxFaces upper;
  upper.upper[1] = true;
  const Vector3d step = -4.0 * turn.col(1) + 2.0 * turn.col(0); // across it, it stays
  EXPECT_EQ(frame.dragged(std::nullopt, upper, Vector3d::Zero(), step),
            (core::IndexBox{{0, 0, 0}, {50, 52, 70}}));
}
