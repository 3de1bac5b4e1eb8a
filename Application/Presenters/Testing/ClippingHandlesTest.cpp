#include "petrous/Presenters/ClippingHandles.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

using namespace petrous;
using Eigen::Vector3d;
using scene::ViewState;

TEST(ClippingChange, IsCalledByWhatItChanges)
{
  const ViewState::Clipping none;
  ViewState::Clipping box;
  box.crop = core::IndexBox{{0, 0, 0}, {5, 5, 5}};
  ViewState::Clipping plane;
  plane.planes.push_back({Vector3d::Zero(), Vector3d::UnitX()});
  EXPECT_EQ(presenters::clippingChange(none, box), "crop box");
  EXPECT_EQ(presenters::clippingChange(box, none), "crop box");
  EXPECT_EQ(presenters::clippingChange(none, plane), "clipping plane");
  EXPECT_EQ(presenters::clippingChange(box, plane), "what is cut away");
}

TEST(MovedPlane, GoesAlongItsNormalAndStaysInTheImage)
{
  // A cube of 10 mm between its outermost voxel centres, and a plane across its diagonal.
  const core::GridGeometry grid({11, 11, 11}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  const Vector3d normal = Vector3d(1.0, 1.0, 1.0).normalized();
  const ViewState::Clipping::Plane plane{Vector3d::Constant(5.0), normal};
  const auto by = [&](double step) { return presenters::movedPlane(plane, step, grid); };
  EXPECT_LT((by(0.5).point - (plane.point + 0.5 * normal)).norm(), 1e-12);
  EXPECT_EQ(by(0.5).normal, normal);
  EXPECT_LT((by(100.0).point - Vector3d::Constant(10.0)).norm(), 1e-9);
  EXPECT_LT((by(-100.0).point - Vector3d::Zero()).norm(), 1e-9);
}

TEST(PlaneCenter, IsItsPointOrBelowTheMiddleOfTheImage)
{
  const core::GridGeometry grid({11, 11, 11}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  const ViewState::Clipping::Plane inside{Vector3d(1.0, 2.0, 3.0), Vector3d::UnitZ()};
  EXPECT_EQ(presenters::planeCenter(inside, grid), inside.point);
  const ViewState::Clipping::Plane far{Vector3d(-500.0, 900.0, 3.0), Vector3d::UnitZ()};
  EXPECT_LT((presenters::planeCenter(far, grid) - Vector3d(5.0, 5.0, 3.0)).norm(), 1e-12);
}

// Against the definition: both ends lie on the plane and on the picture's edge, and a step to the
// side that stays is above the plane.
TEST(LineInSlice, LiesOnThePlaneAcrossThePicture)
{
  const presenters::SliceGeometry slice(presenters::SliceOrientation::Coronal, {3.0, -4.0, 5.0},
                                        0.25, 300, 200);
  int found = 0;
  for (int n = 0; n < 40; ++n)
  {
    const Vector3d normal = Vector3d(std::sin(1.1 * n), std::cos(2.3 * n), std::sin(0.7 * n + 1.0));
    const ViewState::Clipping::Plane plane{
        slice.center() + Vector3d(10.0 * std::cos(n), 3.0, 9.0 * std::sin(3.0 * n)),
        normal.normalized()};
    const auto line = presenters::lineInSlice(plane, slice);
    const auto heightAt = [&](const Eigen::Vector2d& pixel)
    { return plane.normal.dot(slice.patientFromPixel(pixel[0], pixel[1]) - plane.point); };
    if (!line)
    {
      // Then all corners are on one side.
      const double first = heightAt({0.0, 0.0});
      for (const Eigen::Vector2d& corner :
           {Eigen::Vector2d(300.0, 0.0), Eigen::Vector2d(0.0, 200.0),
            Eigen::Vector2d(300.0, 200.0)})
        EXPECT_GT(first * heightAt(corner), 0.0) << n;
      continue;
    }
    ++found;
    for (const Eigen::Vector2d& end : {line->from, line->to})
    {
      EXPECT_NEAR(heightAt(end), 0.0, 1e-6) << n;
      const double toEdge = std::min(
          {std::abs(end[0]), std::abs(end[0] - 300.0), std::abs(end[1]), std::abs(end[1] - 200.0)});
      EXPECT_NEAR(toEdge, 0.0, 1e-6) << n;
    }
    EXPECT_GT(heightAt(0.5 * (line->from + line->to) + line->kept), 0.0) << n;
    EXPECT_NEAR(line->kept.norm(), 1.0, 1e-12);
  }
  EXPECT_GT(found, 10);
}

TEST(LineInSlice, IsNoneInParallel)
{
  const presenters::SliceGeometry slice(presenters::SliceOrientation::Axial, {0.0, 0.0, 5.0}, 0.25,
                                        300, 200);
  EXPECT_FALSE(presenters::lineInSlice({{0.0, 0.0, 5.0}, Vector3d::UnitZ()}, slice));
  EXPECT_FALSE(presenters::lineInSlice({{400.0, 0.0, 5.0}, Vector3d::UnitX()}, slice)) << "outside";
  EXPECT_TRUE(presenters::lineInSlice({{1.0, 0.0, 5.0}, Vector3d::UnitX()}, slice));
}

// The tissue is what lies below z = 6 mm.
TEST(DepthOfAPlane, IsThatBehindTheSurfaceAlongItsNormal)
{
  const core::GridGeometry grid({11, 11, 11}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  const auto tissue = [](const interaction::PickRay& line) -> std::optional<double>
  {
    if (!(line.direction.z() < -1e-9))
      return std::nullopt;
    return (6.0 - line.origin.z()) / line.direction.z();
  };
  const auto depth = [&](const Vector3d& point, const Vector3d& normal) {
    return presenters::depthOf({point, normal.normalized()}, grid, tissue);
  };
  ASSERT_TRUE(depth({5.0, 5.0, 3.5}, -Vector3d::UnitZ()));
  EXPECT_NEAR(*depth({5.0, 5.0, 3.5}, -Vector3d::UnitZ()), 2.5, 1e-9);
  EXPECT_NEAR(*depth({5.0, 5.0, 8.0}, -Vector3d::UnitZ()), -2.0, 1e-9) << "in the air before it";
  EXPECT_NEAR(*depth({5.0, 5.0, 3.0}, {1.0, 0.0, -1.0}), 3.0 * std::sqrt(2.0), 1e-9) << "along it";
  EXPECT_FALSE(depth({5.0, 5.0, 3.0}, Vector3d::UnitX()));
}

TEST(PartAt, IsAnEndOrTheLineWithinReach)
{
  const presenters::CutLine line{{0.0, 100.0}, {300.0, 100.0}, {0.0, 1.0}};
  const auto ends = presenters::endsOf(line);
  ASSERT_EQ(ends.size(), 2U);
  for (const Eigen::Vector2d& end : ends)
  {
    EXPECT_EQ(end[1], 100.0);
    EXPECT_GT(end[0], 20.0) << "not under the letters at the picture's edge";
    EXPECT_LT(end[0], 280.0);
    EXPECT_EQ(presenters::partAt(line, end + Eigen::Vector2d(3.0, 3.0), 6.0),
              presenters::CutPart::End);
  }
  EXPECT_EQ(presenters::partAt(line, {150.0, 104.0}, 6.0), presenters::CutPart::Line);
  EXPECT_FALSE(presenters::partAt(line, {150.0, 108.0}, 6.0));
  EXPECT_FALSE(presenters::partAt(line, {310.0, 100.0}, 6.0)) << "beyond the line";
  EXPECT_TRUE(presenters::endsOf({{0.0, 40.0}, {40.0, 0.0}, {0.7, 0.7}}).empty());
}

// Against the definition: the line turns in the slice by the angle of the drag, about a point that
// stays on it, whatever the plane's slope.
TEST(TurnedPlane, FollowsTheEndThatIsDraggedInASlice)
{
  const core::GridGeometry grid({101, 101, 101}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  const presenters::SliceGeometry slice(presenters::SliceOrientation::Sagittal,
                                        Vector3d::Constant(50.0), 0.25, 500, 400);
  const Vector3d axis = slice.axes().right.cross(slice.axes().down);
  for (int n = 0; n < 12; ++n)
  {
    const Vector3d normal = Vector3d(0.4 * std::sin(n), std::cos(2.3 * n), std::sin(0.7 * n));
    const ViewState::Clipping::Plane plane{
        slice.center() + Vector3d(4.0, 5.0 * std::cos(n), 5.0 * std::sin(2.0 * n)),
        normal.normalized()};
    const auto line = presenters::lineInSlice(plane, slice);
    ASSERT_TRUE(line) << n;
    const Eigen::Vector2d end = presenters::endsOf(*line)[n % 2 ? 1 : 0];
    const Vector3d pivot = presenters::pivotInSlice(plane, grid, slice);
    EXPECT_NEAR(plane.normal.dot(pivot - plane.point), 0.0, 1e-9) << n;
    EXPECT_NEAR(slice.axes().next.dot(pivot - slice.center()), 0.0, 1e-9) << n;
    const Vector3d from = slice.patientFromPixel(end[0], end[1]);
    const Vector3d to = from + 3.0 * slice.axes().right - 4.0 * slice.axes().down;
    const double angle = presenters::draggedAngle(axis, pivot, from, to);
    const auto turned = presenters::turnedPlane(plane, axis, pivot, angle, grid);
    EXPECT_NEAR(turned.normal.dot(to - turned.point), 0.0, 1e-9) << n << ": under the pointer";
    EXPECT_NEAR(turned.normal.dot(pivot - turned.point), 0.0, 1e-9) << n;
    EXPECT_NEAR(turned.normal.dot(axis), plane.normal.dot(axis), 1e-12) << n << ": as steep";
    EXPECT_NEAR(turned.normal.norm(), 1.0, 1e-12);
  }
  // Clockwise as it is seen: what points to the right points down.
  EXPECT_NEAR(presenters::draggedAngle(axis, slice.center(), slice.center() + slice.axes().right,
                                       slice.center() + slice.axes().down),
              0.5 * 3.14159265358979323846, 1e-12);
}

TEST(TurnedPlane, StillCutsTheImage)
{
  const core::GridGeometry grid({11, 11, 11}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  const ViewState::Clipping::Plane plane{{1.0, 5.0, 5.0}, Vector3d::UnitX()};
  // About a point far above the image, in the plane: by 60 degrees it would leave it.
  const auto turned = presenters::turnedPlane(plane, Vector3d::UnitY(), {1.0, 5.0, 60.0},
                                              3.14159265358979323846 / 3.0, grid);
  EXPECT_NEAR(turned.normal.dot(plane.normal), 0.5, 1e-12);
  double least = 1e9;
  double most = -1e9;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3d at(corner & 1 ? 10.0 : 0.0, corner & 2 ? 10.0 : 0.0, corner & 4 ? 10.0 : 0.0);
    least = std::min(least, turned.normal.dot(at - turned.point));
    most = std::max(most, turned.normal.dot(at - turned.point));
  }
  EXPECT_LE(least, 1e-9);
  EXPECT_GE(most, -1e-9);
}
