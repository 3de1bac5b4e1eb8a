#include "petrous/Session/SurfaceApproach.h"

#include <gtest/gtest.h>

#include "LawBlock.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Vector3d;

namespace
{

// A ball of bone of 6 mm about the origin, cut by the scan's face at x = 4 mm.
volume::TissueField ballCut()
{
  const core::GridGeometry grid({55, 73, 73}, Vector3d::Constant(0.25), {-9.5, -9.0, -9.0});
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < 73; ++k)
    for (int j = 0; j < 73; ++j)
      for (int i = 0; i < 55; ++i)
      {
        const double depth = 6.0 - grid.patientFromVoxel(Vector3d(i, j, k)).norm();
        voxels->at(i, j, k) =
            static_cast<std::int16_t>(std::clamp(300.0 + 800.0 * depth, -1000.0, 1800.0));
      }
  return {std::make_shared<volume::IntensityVolume>(std::move(voxels)), {}, nullptr, {}};
}

} // namespace

TEST(SurfaceApproach, IsTheWayToTheNearestPointOfTheSurface)
{
  const auto field = ballCut();
  SurfaceApproach approach(field);
  for (const Vector3d& direction : {Vector3d(-1.0, 0.2, 0.1), Vector3d(0.1, 1.0, 0.0),
                                    Vector3d(-0.3, -0.4, 0.9), Vector3d(0.0, 0.0, -1.0)})
  {
    const Vector3d out = direction.normalized();
    for (const double height : {3.0, 0.4, 0.02, -0.02, -0.5, -2.0})
    {
      approach.forget();
      const Vector3d way = approach.at((6.0 + height) * out);
      EXPECT_NEAR(way.norm(), std::abs(height), 0.03) << height;
      EXPECT_GT(way.normalized().dot(-out), 0.98) << height; // into the bone, also from inside
    }
  }
}

// There may be more bone beyond the scan: its face is not a surface to press on.
TEST(SurfaceApproach, DoesNotKnowTheFacesOfTheScan)
{
  const auto field = ballCut();
  SurfaceApproach approach(field);
  const double rim = std::sqrt(20.0); // of the cut ball, on the face
  const Vector3d inside = approach.at({3.6, 0.0, 2.0});
  EXPECT_NEAR(inside.norm(), std::hypot(0.4, rim - 2.0), 0.05);
  const Vector3d face = approach.at({4.0, 0.0, 4.0});
  EXPECT_NEAR(face.norm(), rim - 4.0, 0.05);
  const Vector3d beyond = approach.at({5.0, 0.0, 0.0});
  EXPECT_NEAR(beyond.norm(), std::hypot(1.0, rim), 0.05);
}

TEST(SurfaceApproach, IsNothingFarFromAllTissue)
{
  const auto field = ballCut();
  SurfaceApproach approach(field);
  EXPECT_TRUE(approach.at({-6.0 - SurfaceApproach::kReach - 1.0, 0.0, 0.0}).isZero());
  EXPECT_FALSE(approach.at({-6.0 - SurfaceApproach::kReach + 1.0, 0.0, 0.0}).isZero());
}

TEST(SurfaceApproach, FollowsAPlaceThatMoves)
{
  const auto field = ballCut();
  SurfaceApproach approach(field);
  for (int n = 0; n <= 400; ++n)
  {
    const Vector3d place(-8.0, -4.0 + 0.02 * n, 0.3);
    const Vector3d way = approach.at(place);
    EXPECT_NEAR(way.norm(), place.norm() - 6.0, 0.06 * (place.norm() - 6.0) + 0.03) << n;
    EXPECT_GT(way.normalized().dot(-place.normalized()), 0.99) << n;
  }
}
