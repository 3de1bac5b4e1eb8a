#include <gtest/gtest.h>

#include <cmath>

#include "petrous/Presenters/PointerDrill.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

// Bone where z < 12 mm (x < 10) or z < 6 mm (x > 10): a plateau with a step down.
scene::Case stepCase()
{
  scene::Case value;
  value.name = "step";
  value.ct.geometry = core::GridGeometry({100, 60, 60}, Vector3d::Constant(0.3), Vector3d::Zero());
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 100; ++i)
      {
        const double top = 0.3 * i < 10.0 ? 12.0 : 6.0;
        const double hounsfield = 300.0 + 3000.0 * (top - 0.3 * k);
        ct->at(i, j, k) = static_cast<std::int16_t>(std::clamp(hounsfield, -1000.0, 1600.0));
      }
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  value.dissection = std::make_shared<dissection::Dissection>(value.ct.geometry);
  return value;
}

SightLine downAt(double x)
{
  return {{x, 9.0, 50.0}, {0, 0, -1}};
}

} // namespace

TEST(BurrRest, LiesOnAFlatSurfaceOneRadiusAboveIt)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  EXPECT_NEAR(firstTissue(session.field(), downAt(5)).value(), 38.0, 0.01);
  EXPECT_NEAR(burrRest(session.field(), downAt(5), 2.0).value(), 36.0, 0.01);
}

TEST(BurrRest, FindsNothingPastTheBone)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  EXPECT_FALSE(burrRest(session.field(), {{5, 9, 50}, {0, 0, 1}}, 2.0).has_value());
  EXPECT_FALSE(burrRest(session.field(), {{500, 9, 50}, {0, 0, -1}}, 2.0).has_value());
}

TEST(BurrRest, IsHeldByAnEdgeBesideTheLine)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  // 1 mm beside a step 6 mm high the ball touches the edge with its flank.
  const double rest = burrRest(session.field(), downAt(11.0), 2.0).value();
  EXPECT_LT(rest, 42.0 - 3.0);
}

TEST(PointerDrill, HoldingStillDrillsAtTheFeedRate)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  PointerDrill drill(session, {}, 2.0);
  drill.begin(downAt(5), 0.0, {});
  for (int n = 1; n <= 60; ++n)
    drill.moveTo(downAt(5), n / 60.0);
  ASSERT_TRUE(drill.center());
  // After 1 s the ball's front is about 2 mm below the surface, whatever the frame rate was.
  EXPECT_NEAR(drill.center()->z(), 12.0 + 2.0 - 2.0, 0.35);
  const auto stroke = drill.end();
  ASSERT_TRUE(stroke);
  EXPECT_GT(stroke->info.removed, 0.5 * 3.14159 * 2.0 * 2.0 * (2.0 - 2.0 / 3.0));
}

TEST(PointerDrill, FeedsAtMostOneRadiusAFrame)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  PointerDrill drill(session, {}, 2.0);
  drill.begin(downAt(5), 0.0, {});
  drill.moveTo(downAt(5), 100.0); // the machine was asleep
  EXPECT_NEAR(drill.center()->z(), 12.0, 0.05);
}

TEST(PointerDrill, WithoutFeedOnlyGoesOverTheSurface)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  PointerDrill drill(session, {}, 0.0);
  drill.begin(downAt(3), 0.0, {});
  drill.moveTo(downAt(8), 0.5);
  const auto stroke = drill.end();
  EXPECT_LT(stroke ? stroke->info.removed : 0.0, 0.3);
}

TEST(PointerDrill, DoesNotPloughThroughAStep)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  PointerDrill drill(session, {}, 0.0);
  drill.begin(downAt(20), 0.0, {}); // low
  drill.moveTo(downAt(3), 0.1);     // up over the step in one move of the pointer
  drill.end();
  for (double x = 1.0; x < 8.0; x += 1.0)
    EXPECT_GT(session.field().value({x, 9.0, 11.0}), 0.0) << x;
}

TEST(PointerDrill, StaysAtItsHeightPastTheEdgeOfTheBone)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  PointerDrill drill(session, {}, 0.0);
  drill.begin(downAt(25), 0.0, {});
  const double height = drill.center()->z();
  drill.moveTo(downAt(60), 0.1);
  // It rolls over the edge by less than half a radius, then goes on through the air.
  EXPECT_NEAR(drill.center()->z(), height, 1.0);
}

TEST(PointerDrill, ListsNothingWhenOnlyAirWasMet)
{
  scene::Case value = stepCase();
  DrillSession session(value);
  PointerDrill drill(session, {}, 2.0);
  drill.begin(downAt(500), 0.0, {});
  EXPECT_FALSE(drill.moveTo(downAt(510), 1.0));
  EXPECT_EQ(drill.end(), nullptr);
  EXPECT_THROW(PointerDrill(session, {}, -1.0), core::InvalidParameter);
}
