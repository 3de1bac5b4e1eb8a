#include "petrous/Presenters/ClippingHandles.h"

#include <cmath>

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
