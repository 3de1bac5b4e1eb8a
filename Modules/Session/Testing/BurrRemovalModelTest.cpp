#include "petrous/Session/BurrRemovalModel.h"

#include <random>

#include <gtest/gtest.h>

#include "LawScene.h"
#include "petrous/Core/Error.h"
#include "petrous/Dissection/RemovedVolume.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using dissection::Burr;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

// Counts points of the fields, 8^3 per voxel, wherever the mask was lowered at all.
double measured(const LawScene& scene)
{
  const volume::CutMask& mask = scene.work.mask();
  const core::GridGeometry& grid = mask.geometry();
  const core::IndexBox box = mask.boxOf(scene.work.openBricks());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(0.0, 1.0);
  std::uint64_t gone = 0;
  for (int k = box.lower[2]; k < std::min(box.upper[2], grid.dims()[2] - 1); ++k)
    for (int j = box.lower[1]; j < std::min(box.upper[1], grid.dims()[1] - 1); ++j)
      for (int i = box.lower[0]; i < std::min(box.upper[0], grid.dims()[0] - 1); ++i)
      {
        bool lowered = false;
        for (int c = 0; c < 8; ++c)
          lowered = lowered || mask.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) < 40000;
        for (int n = 0; lowered && n < 512; ++n)
        {
          const Eigen::Vector3d voxel(i + ((n & 7) + jitter(random)) / 8.0,
                                      j + ((n >> 3 & 7) + jitter(random)) / 8.0,
                                      k + ((n >> 6) + jitter(random)) / 8.0);
          gone +=
              mask.sample(voxel) <= 0.5 && scene.tissue.uncut(grid.patientFromVoxel(voxel)) > 0.0;
        }
      }
  return static_cast<double>(gone) * grid.voxelVolume() / 512.0;
}

double total(const RemovalBalance& balance)
{
  return balance.removed + balance.owed + balance.forfeited;
}

LawScene::Setting settingOf(Burr::Kind kind, double thrust, double degrees, double voxel,
                            double tick)
{
  LawScene::Setting setting;
  setting.burr.kind = kind;
  setting.thrust = thrust;
  setting.elevation = degrees * kDegree;
  setting.voxel = voxel;
  setting.tick = tick;
  return setting;
}

} // namespace

struct LawCase
{
  Burr::Kind kind;
  double thrust, degrees, voxel, tick, seconds;
};

class RemovalLaws : public ::testing::TestWithParam<LawCase>
{
};

// The removed volume, measured from the mask by another quadrature, is Eq. (8) or (9) summed over
// the ticks: F_t from the record, r from the removal model, constants from the catalogue.
TEST_P(RemovalLaws, AreWhatIsRemoved)
{
  const LawCase& p = GetParam();
  LawScene scene(settingOf(p.kind, p.thrust, p.degrees, p.voxel, p.tick));
  const double slope = std::tan(-10.0 * kDegree);
  const double pascal = p.kind == Burr::Kind::Cutting ? 3e9 * (0.5 - slope) / (1.0 + 0.5 * slope)
                                                      : 3.0 * 42.5 * 9.807e6 / 0.1;
  double expected = 0.0; // mm^3
  double arms = 0.0;     // mm s
  scene.drill(
      p.seconds,
      [&](const TickRecord& record)
      {
        const double force =
            Eigen::Vector3d(record.burrForce[0], record.burrForce[1], record.burrForce[2]).norm();
        EXPECT_LE(scene.removalModel.arm(), 2.0);
        arms += scene.removalModel.arm() * p.tick;
        const double rate = force * 1e-3 * scene.removalModel.arm() * 2000.0 * kPi / pascal; // m3/s
        expected += 1e9 * rate * p.tick;
      });
  // r_b cos(theta) of the flat surface; more near the pole, where the patch has spread, and less at
  // the equator: the mean of r_b cos(latitude) over a patch of 1 mm is 3 % less than r_b there.
  const double plain = 2.0 * std::cos(p.degrees * kDegree);
  EXPECT_GT(arms / p.seconds, 0.95 * plain);
  if (p.degrees < 60.0)
  {
    EXPECT_LT(arms / p.seconds, 1.03 * plain);
  }
  const RemovalBalance balance = scene.removalModel.balance();
  EXPECT_NEAR(balance.predicted, expected, 0.02 * expected);
  EXPECT_NEAR(total(balance), balance.predicted, 0.02 * balance.predicted);
  EXPECT_LT(balance.owed + balance.forfeited, 0.05 * expected);
  EXPECT_NEAR(measured(scene) + balance.owed + balance.forfeited, expected,
              0.03 * expected + 0.001);
}

INSTANTIATE_TEST_SUITE_P(OverTheirRange, RemovalLaws,
                         ::testing::Values(LawCase{Burr::Kind::Cutting, 1.0, 40.0, 0.3, 1e-3, 0.15},
                                           LawCase{Burr::Kind::Cutting, 0.2, 0.0, 0.2, 1e-3, 0.4},
                                           LawCase{Burr::Kind::Cutting, 5.0, 0.0, 0.4, 2e-3, 0.06},
                                           LawCase{Burr::Kind::Cutting, 5.0, 80.0, 0.3, 5e-4, 0.06},
                                           LawCase{Burr::Kind::Cutting, 1.0, 80.0, 0.2, 2e-3, 0.3},
                                           LawCase{Burr::Kind::Diamond, 5.0, 40.0, 0.3, 1e-3, 0.15},
                                           LawCase{Burr::Kind::Diamond, 1.0, 0.0, 0.2, 2e-3, 0.3},
                                           LawCase{Burr::Kind::Diamond, 0.2, 80.0, 0.4, 1e-3, 1.5},
                                           LawCase{Burr::Kind::Diamond, 5.0, 80.0, 0.2, 5e-4,
                                                   0.1}));

TEST(BurrRemovalModel, TakesTheSameAtAnyTickAndVoxel)
{
  const auto removed = [](double thrust, double degrees, double voxel, double tick, double seconds)
  {
    LawScene scene(settingOf(Burr::Kind::Cutting, thrust, degrees, voxel, tick));
    scene.drill(seconds);
    return total(scene.removalModel.balance());
  };
  for (const double degrees : {0.0, 40.0, 80.0})
  {
    SCOPED_TRACE(degrees);
    const double usual = removed(1.0, degrees, 0.2, 1e-3, 0.3);
    EXPECT_GT(usual, 0.3); // mm^3
    EXPECT_NEAR(removed(1.0, degrees, 0.2, 5e-4, 0.3), usual, 0.02 * usual);
    EXPECT_NEAR(removed(1.0, degrees, 0.15, 1e-3, 0.3), usual, 0.02 * usual);
    EXPECT_NEAR(removed(1.0, degrees, 0.3, 2e-3, 0.3), usual, 0.02 * usual);
    EXPECT_NEAR(removed(1.0, degrees, 0.4, 2e-3, 0.3), usual, 0.02 * usual);
  }
  for (const double degrees : {60.0, 80.0})
  {
    SCOPED_TRACE(degrees);
    const double weak = removed(0.2, degrees, 0.2, 1e-3, 0.5);
    EXPECT_NEAR(removed(0.2, degrees, 0.3, 2e-3, 0.5), weak, 0.02 * weak);
    EXPECT_NEAR(removed(0.2, degrees, 0.4, 1e-3, 0.5), weak, 0.02 * weak);
  }
}

// Shafts at 60 to 90 degrees from the normal, the last parallel to the surface: the approach to the
// bone is the surface's normal, not the shaft.
class FlatShafts : public ::testing::TestWithParam<Burr::Kind>
{
};

TEST_P(FlatShafts, TakeTheSameAtAnyTickAndVoxel)
{
  for (const double degrees : {0.0, 15.0, 30.0}) // of elevation
  {
    const auto removed = [&](double voxel, double tick)
    {
      LawScene scene(settingOf(GetParam(), 1.0, degrees, voxel, tick));
      scene.drill(0.25);
      return total(scene.removalModel.balance());
    };
    SCOPED_TRACE(degrees);
    const double usual = removed(0.2, 1e-3);
    const double law = GetParam() == Burr::Kind::Cutting ? 5.65 : 1.004; // mm3/s at 1 N, 2 mm
    // The mean over a patch of a millimetre is some per cent below r_b cos(theta): see above.
    const double plain = 0.25 * law * std::cos(degrees * kDegree);
    EXPECT_GT(usual, 0.95 * plain);
    EXPECT_LT(usual, 1.02 * plain);
    EXPECT_NEAR(removed(0.15, 1e-3), usual, 0.02 * usual);
    EXPECT_NEAR(removed(0.15, 5e-4), usual, 0.02 * usual);
    EXPECT_NEAR(removed(0.3, 2e-3), usual, 0.02 * usual);
    EXPECT_NEAR(removed(0.4, 1e-3), usual, 0.02 * usual);
  }
}

INSTANTIATE_TEST_SUITE_P(OfBothKinds, FlatShafts,
                         ::testing::Values(Burr::Kind::Cutting, Burr::Kind::Diamond));

// The target is far beyond the tool, so it pulls sideways by more than the thrust for small
// rotations.
TEST(BurrRemovalModel, AWeakThrustDoesNotSwing)
{
  LawScene scene(settingOf(Burr::Kind::Cutting, 0.2, 80.0, 0.2, 1e-3));
  double sum = 0.0;
  scene.drill(1.0,
              [&](const TickRecord& record)
              {
                // The ripples of the hollow are ten degrees steep.
                EXPECT_NEAR(record.elevation, 80.0 * kDegree, 10.0 * kDegree);
                const Eigen::Vector3d force(record.burrForce[0], record.burrForce[1],
                                            record.burrForce[2]);
                EXPECT_NEAR(force.norm(), 0.2, 0.02);
                sum += force.norm();
                // They hardly push it aside.
                const Eigen::Vector3d at = record.proxy.pose().position;
                EXPECT_LT(std::hypot(at.x() - 0.013, at.y() + 0.027), 0.02);
              });
  EXPECT_NEAR(sum / 1000.0, 0.2, 0.002);
}

// 0.05 mm3/s: a seventh of a micrometre per second on the whole hemisphere, less than a step of an
// 8-bit mask in ten ticks.
TEST(BurrRemovalModel, ASlowDiamondBurrDoesNotStall)
{
  LawScene scene(settingOf(Burr::Kind::Diamond, 0.05, 0.0, 0.3, 1e-3));
  scene.drill(0.5);
  const RemovalBalance half = scene.removalModel.balance();
  scene.drill(0.5);
  const RemovalBalance all = scene.removalModel.balance();
  EXPECT_NEAR(all.predicted, 0.05, 0.004);
  EXPECT_NEAR(all.removed - half.removed, 0.025, 0.002);
  EXPECT_NEAR(total(all), all.predicted, 0.02 * all.predicted);
}

TEST(BurrRemovalModel, ABurrThatDoesNotTurnOrDoesNotDrillTakesExactlyNothing)
{
  LawScene::Setting still;
  still.burr.rpm = 0.0;
  LawScene stands(still);
  stands.drill(0.1);
  EXPECT_TRUE(stands.work.mask().untouched());
  EXPECT_EQ(stands.removalModel.balance().predicted, 0.0);

  LawScene idle(LawScene::Setting{});
  const haptics::Pose place{{0.0, 0.0, -1.0}, Eigen::Quaterniond::Identity()};
  for (int n = 0; n < 200; ++n)
    idle.tick(place);
  EXPECT_GT(idle.session.records.back().thrust, 0.5); // it rests on the bone
  EXPECT_TRUE(idle.work.mask().untouched());
  EXPECT_EQ(idle.removalModel.balance().predicted, 0.0);
}

// The laws are linear in the spindle's speed, which the pedal sets.
TEST(BurrRemovalModel, RemovesByTheSpeedThatThePedalAsksFor)
{
  const auto setting = settingOf(Burr::Kind::Diamond, 1.0, 0.0, 0.3, 1e-3);
  LawScene slow(setting);
  slow.session.parameters.drill = ServoParameters::kPedalSpeed;
  const auto pressed = [&slow](const TickRecord&) { slow.session.pedal = 0.25; };
  slow.drill(0.001, pressed); // its first tick is at full speed
  const double first = slow.removalModel.balance().predicted;
  slow.drill(0.4, pressed);
  LawScene full(setting);
  full.session.parameters.drill = ServoParameters::kPedalSpeed;
  full.drill(0.1);
  const double all = full.removalModel.balance().predicted;
  ASSERT_GT(all, 0.05); // mm^3
  EXPECT_NEAR(slow.removalModel.balance().predicted - first, all, 0.05 * all);
  EXPECT_NEAR(slow.removalModel.balance().removed, full.removalModel.balance().removed, 0.1 * all);
}

// Half of the burr meets bone that takes a third of the work: the total work is the sum over the
// volumes, each in its tissue.
TEST(BurrRemovalModel, TissuesDivideTheWorkOfAStep)
{
  LawScene::Setting setting;
  setting.border = 0.0;
  LawScene scene(setting);
  double work = 0.0; // N mm
  scene.drill(0.3,
              [&](const TickRecord&) {
                work += scene.removalModel.thrust() * scene.removalModel.arm() * 2000.0 * kPi *
                        setting.tick;
              });
  const volume::CutMask before(scene.work.mask().geometry());
  const auto taken =
      dissection::measureRemoved(scene.tissue, before, scene.work.mask(), scene.work.openBricks(),
                                 {{"cortical", scene.sides, 1}, {"cellular", scene.sides, 2}});
  ASSERT_EQ(taken.structures.size(), 2u);
  const double spent = resistance(setting.burr, "cortical-bone") * taken.structures[0].volume +
                       resistance(setting.burr, "cellular-bone") * taken.structures[1].volume;
  EXPECT_GT(taken.structures[1].volume, taken.structures[0].volume);
  EXPECT_NEAR(spent, work, 0.03 * work);
  const RemovalBalance balance = scene.removalModel.balance();
  EXPECT_NEAR(total(balance), balance.predicted, 0.02 * balance.predicted);
}

TEST(BurrRemovalModel, WhatIsOwedIsForfeitedWhenContactEnds)
{
  LawScene scene(settingOf(Burr::Kind::Diamond, 0.2, 40.0, 0.3, 1e-3));
  scene.drill(0.2);
  while (!(scene.removalModel.balance().owed > 1e-6))
    scene.drill(0.001);
  const RemovalBalance before = scene.removalModel.balance();
  scene.session.pedal = 0.0;
  scene.tick({{0.0, 0.0, -1.0}, Eigen::Quaterniond::Identity()});
  const RemovalBalance after = scene.removalModel.balance();
  EXPECT_EQ(after.owed, 0.0);
  EXPECT_NEAR(after.forfeited, before.forfeited + before.owed, 1e-12);
  EXPECT_EQ(after.removed, before.removed);
}

// A hole of exactly the burr's size, which the field represents to a hundredth of a voxel, must not
// jam it.
TEST(BurrRemovalModel, DrillsOnBeyondItsEquator)
{
  for (const double degrees : {90.0, 80.0})
  {
    LawScene::Setting setting = settingOf(Burr::Kind::Cutting, 5.0, degrees, 0.3, 1e-3);
    setting.burr.diameter = 2.0;
    LawScene scene(setting);
    scene.drill(0.6);
    EXPECT_LT(scene.session.records.back().proxy.pose().position.z(), -0.6) << degrees;
    EXPECT_LT(scene.removalModel.balance().forfeited, 0.02 * scene.removalModel.balance().predicted)
        << degrees;
  }
}

TEST(BurrRemovalModel, DoesNotBoreOnWhileTheToolIsHeld)
{
  // According to the servo the burr stays in place, whatever is removed.
  LawScene scene(LawScene::Setting{});
  const Eigen::Vector3d at(0.0, 0.0, 2.0);
  for (int n = 0; n < 500; ++n)
  {
    TickRecord record;
    record.input.now = 0.001 * n;
    record.proxy = PoseValues::of({at, Eigen::Quaterniond::Identity()});
    record.thrust = record.burrForce[2] = 3.0;
    record.elevation = 0.0;
    record.drill = record.input.parameters.drill = 1;
    scene.loop.step(record);
  }
  const auto& grid = scene.work.mask().geometry();
  const double deepest = BurrRemovalModel::kMinAhead + 0.05 * 0.3;
  EXPECT_EQ(scene.work.mask().sample(grid.voxelFromPatient({0.0, 0.0, -deepest - 0.9})), 1.0);
  EXPECT_GT(scene.work.mask().sample(grid.voxelFromPatient({0.0, 0.0, -deepest})), 0.5);
  const RemovalBalance balance = scene.removalModel.balance();
  EXPECT_NEAR(total(balance), balance.predicted, 1e-6 * balance.predicted);
  EXPECT_GT(balance.forfeited, 0.5 * balance.predicted);
}

TEST(BurrRemovalModel, RefusesASpindleThatTurnsBack)
{
  LawScene scene(LawScene::Setting{});
  Burr burr;
  burr.rpm = -1.0;
  EXPECT_THROW(BurrRemovalModel(scene.search, burr, 0.3), core::InvalidParameter);
}

// Random points on a cap: those within `rim` of the middle, whose own mean distance from the line
// through the middle is the spread.
TEST(BurrRemovalModel, ArmIsTheMeanOverThePatch)
{
  const double radius = 2.0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  for (const double rim : {0.05, 0.2, 0.5, 1.0})
    for (const double degrees : {0.0, 45.0, 60.0, 73.0, 80.0, 85.0, 88.0, 90.0})
    {
      SCOPED_TRACE(::testing::Message() << "rim " << rim << ", " << degrees << " degrees");
      const Eigen::Vector3d spindle(std::cos(degrees * kDegree), 0.0, std::sin(degrees * kDegree));
      const int draws = 40000;
      double arm = 0.0;
      double spread = 0.0;
      for (int n = 0; n < draws; ++n)
      {
        const double z = 1.0 - (1.0 - std::cos(rim)) * uniform(random);
        const double rho = std::sqrt(1.0 - z * z);
        const double turn = 360.0 * kDegree * uniform(random);
        const Eigen::Vector3d place =
            radius * Eigen::Vector3d(rho * std::cos(turn), rho * std::sin(turn), z);
        arm += place.cross(spindle).norm() / draws;
        spread += radius * rho / draws;
      }
      EXPECT_NEAR(BurrRemovalModel::armOf(radius, degrees * kDegree, spread), arm, 0.01 * arm);
    }
}

// r_b cos(theta) for a point, and the spread at the pole.
TEST(BurrRemovalModel, ArmIsThatOfTheContact)
{
  EXPECT_NEAR(BurrRemovalModel::armOf(2.0, 0.0, 0.0), 2.0, 0.001);
  const double contact = 2.0 * std::cos(60.0 * kDegree);
  EXPECT_NEAR(BurrRemovalModel::armOf(2.0, 60.0 * kDegree, 0.03), contact, 0.003 * contact);
  EXPECT_NEAR(BurrRemovalModel::armOf(2.0, 90.0 * kDegree, 0.7), 0.7, 0.003 * 0.7);
  EXPECT_GT(BurrRemovalModel::armOf(2.0, 90.0 * kDegree, 0.0), 0.01);
  EXPECT_LT(BurrRemovalModel::armOf(2.0, 90.0 * kDegree, 0.0), 0.1);
}
