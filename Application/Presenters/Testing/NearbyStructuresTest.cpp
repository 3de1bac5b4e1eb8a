#include "petrous/Presenters/NearbyStructures.h"

#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Scene/ApplyRegistration.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using State = NearbyStructure::State;

namespace
{

const Vector3d kNerve(4.0, -3.0, 10.0);
const Vector3d kVessel(16.0, -3.0, 10.0);
constexpr double kVoxel = 0.4;          // mm
constexpr double kSlice = 0.8;          // mm
constexpr double kRadius = 3.0;         // mm, of both spheres
constexpr double kBias = 0.25 * kSlice; // distance of the smoothed voxel surface from the sphere

// Two spheres in slices spaced twice the pixel size.
scene::Case balls()
{
  scene::Case value;
  const core::GridGeometry grid({70, 40, 25}, {kVoxel, kVoxel, kSlice}, {-4.0, -11.0, 0.0});
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 25; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 70; ++i)
      {
        const Vector3d at = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        voxels->at(i, j, k) = (at - kNerve).norm() < kRadius    ? 3
                              : (at - kVessel).norm() < kRadius ? 7
                                                                : 0;
      }
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  scene::StructurePart nerve;
  nerve.name = "facial_nerve";
  nerve.index = 3;
  nerve.look.warning = 2.0;
  scene::StructurePart vessel;
  vessel.name = "carotid";
  vessel.index = 7;
  part.structures = {nerve, vessel};
  value.labels.push_back(part);
  return value;
}

std::shared_ptr<const dissection::Stroke> stroke(const std::string& name, double volume)
{
  dissection::Stroke stroke;
  stroke.info.structures = {{name, volume}};
  return std::make_shared<const dissection::Stroke>(stroke);
}

} // namespace

TEST(NearbyStructures, TellDistancesOfTheBurrsBallTheNearestFirst)
{
  const scene::Case value = balls();
  NearbyStructures nearby(value);
  nearby.surfaces();
  const Vector3d place = kNerve + Vector3d(0.0, 0.0, 7.0);
  const auto near = nearby.around(value, place, 2.0, 50.0);
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].name, "facial_nerve");
  EXPECT_NEAR(near[0].distance, 7.0 - kRadius - 2.0, kBias);
  EXPECT_EQ(near[1].name, "carotid");
  EXPECT_NEAR(near[1].distance, (place - kVessel).norm() - kRadius - 2.0, kBias);
  // Half the slice spacing.
  EXPECT_NEAR(near[0].uncertainty.millimetres(), 0.5 * kSlice, 1e-12);
  EXPECT_EQ(nearby.around(value, place, 2.0, 4.0).size(), 1U) << "the other one is too far";
}

TEST(NearbyStructures, WarnWithinTheDistanceAndTellOfATouch)
{
  scene::Case value = balls();
  NearbyStructures nearby(value);
  nearby.surfaces();
  const auto stateAt = [&](double away)
  {
    const auto near = nearby.around(value, kNerve + Vector3d(0.0, away, 0.0), 1.0, 50.0);
    EXPECT_EQ(near.front().name, "facial_nerve");
    return near.front().state;
  };
  // 2 mm, and the 0.4 mm by which the surface may be nearer.
  EXPECT_EQ(stateAt(kRadius + 1.0 + 2.7), State::Clear);
  EXPECT_EQ(stateAt(kRadius + 1.0 + 2.1), State::Warned);
  EXPECT_EQ(stateAt(kRadius + 1.0 - 0.3), State::Touched);
  EXPECT_EQ(stateAt(0.0), State::Touched);
  // For warnings only, nothing farther is searched.
  const auto alone = [&](double away)
  { return nearby.around(value, kNerve + Vector3d(0.0, away, 0.0), 1.0, 0.0).size(); };
  EXPECT_EQ(alone(kRadius + 1.0 + 2.7), 0U);
  EXPECT_EQ(alone(kRadius + 1.0 + 2.1), 1U);
  EXPECT_EQ(alone(kRadius + 1.0 - 0.3), 1U);
  value.labels[0].structures[0].look.warning = 0.0; // the case's current value is used
  EXPECT_EQ(stateAt(kRadius + 1.0 + 0.2), State::Clear) << "without one nothing is warned of";
}

// Of a structure without a warning distance, too, and between the points that are felt.
TEST(NearbyStructures, WarnOfWhatAnInstrumentMayReach)
{
  const scene::Case value = balls();
  NearbyStructures nearby(value);
  nearby.surfaces();
  haptics::PointShell needle; // across the vessel, a point 1 mm before and behind its middle
  for (int n = -5; n < 5; ++n)
    needle.points.emplace_back(0.0, 0.0, 2.0 * n + 1.0);
  needle.burrSpacing = needle.spacing = 1.0;
  needle.reach = 10.0;
  const MeasuredTool tool(needle);
  const auto stateAt = [&](double aside) -> std::optional<State>
  {
    const haptics::Pose pose{kVessel + Vector3d(0.0, aside, 0.0), Eigen::Quaterniond::Identity()};
    for (const NearbyStructure& near : nearby.around(value, tool, pose, 0.0))
      if (near.name == "carotid")
        return near.state;
    return std::nullopt;
  };
  EXPECT_EQ(stateAt(0.0), State::Touched);
  EXPECT_EQ(stateAt(kRadius - 0.1), State::Warned); // pierces it between two points
  EXPECT_EQ(stateAt(kRadius + 0.3), State::Warned);
  EXPECT_EQ(stateAt(kRadius + 2.0), std::nullopt);
}

// What is skipped where only warnings are wanted could not have been in one.
TEST(NearbyStructures, WarnOfTheSameWhetherAllIsMeasuredOrWarningsAlone)
{
  scene::Case value = balls();
  NearbyStructures nearby(value);
  nearby.surfaces();
  haptics::PointShell needle;
  for (int n = 0; n <= 100; ++n)
    needle.points.emplace_back(0.0, 0.0, 0.4 * n);
  needle.burrSpacing = 0.2;
  needle.spacing = 1.1;
  needle.reach = 40.0;
  const MeasuredTool tools[] = {MeasuredTool(needle), MeasuredTool(1.0)};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> inBox(-1.0, 1.0);
  int warned = 0, silent = 0;
  const auto compare = [&](int poses)
  {
    for (int n = 0; n < poses; ++n)
      for (const MeasuredTool& tool : tools)
      {
        const haptics::Pose pose{
            kNerve + 9.0 * Vector3d(inBox(random), inBox(random), inBox(random)),
            Eigen::Quaterniond(inBox(random), inBox(random), inBox(random), inBox(random))
                .normalized()};
        const auto states = [&](double reach)
        {
          std::map<std::string, State> result;
          for (const NearbyStructure& near : nearby.around(value, tool, pose, reach))
            if (near.state != State::Clear)
              result[near.name] = near.state;
          return result;
        };
        const auto alone = states(0.0);
        EXPECT_EQ(alone, states(20.0));
        ++(alone.empty() ? silent : warned);
      }
  };
  compare(300);
  value.labels[0].structures[0].look.shown = false;
  value.labels[0].structures[1].look.solid = false; // of a lumen without a distance never
  compare(300);
  EXPECT_GT(warned, 100);
  EXPECT_GT(silent, 100);
}

TEST(NearbyStructures, KnowWhetherAnythingCanBeWarnedOf)
{
  scene::Case value = balls();
  EXPECT_TRUE(canBeWarnedOf(value));
  appearance::StructureAppearance& nerve = value.labels[0].structures[0].look;
  appearance::StructureAppearance& vessel = value.labels[0].structures[1].look;
  vessel.shown = false;
  nerve.shown = false;
  EXPECT_TRUE(canBeWarnedOf(value)) << "hidden, but with a distance";
  nerve.warning = 0.0;
  EXPECT_FALSE(canBeWarnedOf(value));
  vessel.shown = true;
  EXPECT_TRUE(canBeWarnedOf(value)) << "it can be touched";
  vessel.solid = false;
  EXPECT_FALSE(canBeWarnedOf(value)) << "a lumen is opened";
  EXPECT_FALSE(canBeWarnedOf({}));
}

TEST(NearbyStructures, WarnOfWhatARegistrationMayHaveDisplaced)
{
  scene::Case value = balls();
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = value.labels[0].labels.get()->voxels->geometry();
  value.mr.push_back(mr);
  const auto stateAt = [&](const scene::Registration& how)
  {
    scene::applyRegistration(value, "T2", {}, how);
    NearbyStructures nearby(value);
    nearby.surfaces();
    return nearby.around(value, kNerve + Vector3d(0.0, kRadius + 1.0 + 3.2, 0.0), 1.0, 50.0)
        .front()
        .state;
  };
  scene::Registration how;
  how.error = scene::RegistrationError{kNerve, "here", 0.1, 0.3, 1};
  EXPECT_EQ(stateAt(how), State::Clear);
  how.error->p95 = 1.5;
  EXPECT_EQ(stateAt(how), State::Warned) << "3.2 mm less 1.55";
}

TEST(NearbyStructures, WarnOfWhatIsHidden)
{
  scene::Case value = balls();
  value.labels[0].structures[0].look.shown = false;
  NearbyStructures nearby(value);
  nearby.surfaces();
  const auto at = [&](double away)
  { return nearby.around(value, kNerve + Vector3d(-away, 0.0, 0.0), 1.0, 50.0); };
  ASSERT_EQ(at(kRadius + 1.0 + 1.0).size(), 2U);
  EXPECT_EQ(at(kRadius + 1.0 + 1.0).front().name, "facial_nerve");
  EXPECT_EQ(at(kRadius + 1.0 + 1.0).front().state, State::Warned);
  EXPECT_EQ(at(0.0).front().state, State::Touched);
  ASSERT_EQ(at(kRadius + 1.0 + 5.0).size(), 1U) << "it is not listed otherwise";
  EXPECT_EQ(at(kRadius + 1.0 + 5.0).front().name, "carotid");
}

TEST(NearbyStructures, LeaveOutWhatIsHiddenWithoutAWarningDistance)
{
  scene::Case value = balls();
  value.labels[0].structures[0].look.shown = false;
  value.labels[0].structures[0].look.warning = 0.0;
  NearbyStructures nearby(value);
  nearby.surfaces();
  const auto near = nearby.around(value, kNerve, 1.0, 50.0);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].name, "carotid");
  const auto resources = nearby.surfaces().resources();
  EXPECT_EQ(resources.size(), 1U) << "nobody measures what is neither shown nor warned of";
  EXPECT_GT(resources.at("labels.distance.carotid"), 1000U);
}

TEST(NearbyStructures, MeasureInTheBackgroundWhatIsWarnedOfLater)
{
  scene::Case value = balls();
  appearance::StructureAppearance& look = value.labels[0].structures[0].look;
  look.shown = false;
  look.warning = 0.0;
  NearbyStructures nearby(value);
  nearby.surfaces();
  const Vector3d place = kNerve + Vector3d(-kRadius - 1.0 - 1.0, 0.0, 0.0);
  const auto names = [&]
  {
    std::vector<std::string> all;
    for (const NearbyStructure& one : nearby.around(value, place, 1.0, 50.0))
      all.push_back(one.name);
    return all;
  };
  const std::vector<std::string> vessel{"carotid"};
  EXPECT_EQ(names(), vessel);
  EXPECT_EQ(toString(nearby.unmeasured()), "");
  look.warning = 2.0;
  EXPECT_EQ(names(), vessel) << "the others go on";
  EXPECT_EQ(nearby.unmeasured().pending, std::vector<std::string>{"facial_nerve"});
  EXPECT_EQ(toString(nearby.unmeasured()), "no warnings of facial nerve yet: still being measured");
  for (int n = 0; n < 1000 && !nearby.unmeasured().pending.empty(); ++n)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    names();
  }
  ASSERT_EQ(toString(nearby.unmeasured()), "");
  const auto near = nearby.around(value, place, 1.0, 50.0);
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].name, "facial_nerve");
  EXPECT_EQ(near[0].state, State::Warned);
  EXPECT_NEAR(near[0].distance, 1.0, kBias);
  EXPECT_EQ(nearby.surfaces().resources().size(), 2U);
}

// The distance of an occupancy of more than 65535 voxels along an axis cannot be measured.
TEST(NearbyStructures, NameWhatCannotBeMeasuredAndGoOnWithTheOthers)
{
  const Vector3d place = kNerve + Vector3d(-kRadius - 1.0 - 1.0, 0.0, 0.0);
  for (const bool fromTheStart : {true, false})
  {
    scene::Case value = balls();
    value.labels[0].structures[0].look.shown = fromTheStart;
    value.labels[0].structures[0].look.warning = fromTheStart ? 2.0 : 0.0;
    const core::GridGeometry grid({65540, 3, 3}, {0.1, 0.1, 0.1}, {-4.0, -11.0, 0.0});
    scene::LabelPart part;
    part.drawnOn = "";
    part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(
        std::make_shared<const volume::Volume<std::uint16_t>>(grid, std::uint16_t{1}), {}));
    scene::StructurePart wire;
    wire.name = "long_wire";
    wire.index = 1;
    wire.look.shown = fromTheStart;
    part.structures = {wire};
    value.labels.push_back(part);
    NearbyStructures nearby(value);
    nearby.surfaces();
    value.labels[0].structures[0].look.warning = 2.0;
    value.labels[1].structures[0].look.shown = true;
    std::vector<NearbyStructure> near;
    const auto ask = [&] { near = nearby.around(value, place, 1.0, 50.0); };
    ASSERT_NO_THROW(ask());
    for (int n = 0; n < 1000 && !nearby.unmeasured().pending.empty(); ++n)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      ASSERT_NO_THROW(ask());
    }
    for (int frame = 0; frame < 3; ++frame)
    {
      ASSERT_NO_THROW(ask());
      ASSERT_EQ(near.size(), 2U);
      EXPECT_EQ(near[0].name, "facial_nerve");
      EXPECT_EQ(near[0].state, State::Warned);
      EXPECT_EQ(toString(nearby.unmeasured()), "no warnings of long wire: cannot be measured");
    }
  }
}

TEST(NearbyStructures, NameAFewOfManyThatAreUnmeasured)
{
  EXPECT_EQ(toString(UnmeasuredStructures{{"a", "b", "c", "d", "e"}, {"f"}}),
            "no warnings of a, b, c and 2 more yet: still being measured\n"
            "no warnings of f: cannot be measured");
}

TEST(NearbyStructures, KeepWhatIsInjuredHoweverFar)
{
  scene::Case value = balls();
  value.dissection = dissection::Dissection(
      {stroke("carotid", 0.5), stroke("carotid", 0.25), stroke("facial_nerve", 4.0)},
      dissection::History::line(3, 2));
  NearbyStructures nearby(value);
  nearby.surfaces();
  const auto near = nearby.around(value, kNerve + Vector3d(-30.0, 0.0, 0.0), 1.0, 5.0);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].name, "carotid");
  EXPECT_NEAR(near[0].injured, 0.75, 1e-12);
  EXPECT_EQ(injuredVolumes(value).size(), 1U) << "the third stroke is undone";
}

TEST(NearbyStructures, ALumenIsOpenedAndNotInjured)
{
  scene::Case value = balls();
  appearance::StructureAppearance& look = value.labels[0].structures[1].look;
  look.solid = false;
  value.dissection = dissection::Dissection({stroke("carotid", 0.5), stroke("facial_nerve", 0.001)},
                                            dissection::History::line(2, 2));
  NearbyStructures nearby(value);
  nearby.surfaces();
  const auto within = [&] { return nearby.around(value, kVessel, 1.0, 50.0); };
  ASSERT_EQ(within().front().name, "carotid");
  EXPECT_EQ(within().front().state, State::Clear);
  EXPECT_EQ(within().front().injured, 0.0);
  EXPECT_EQ(injuredVolumes(value), (std::map<std::string, double>{{"facial_nerve", 0.001}}));
  const std::string warnings = warningsOf(within());
  EXPECT_EQ(warnings.find("carotid"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("injured, under 0.01 mm³"), std::string::npos) << warnings;
  look.warning = 1.0; // a warning distance is set
  EXPECT_EQ(within().front().state, State::Touched);
  EXPECT_NE(warningsOf(within()).find("carotid touched"), std::string::npos);
}

TEST(NearbyStructures, AreThereAfterAWhile)
{
  const scene::Case value = balls();
  NearbyStructures nearby(value);
  for (int n = 0; n < 1000 && !nearby.ready(); ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(nearby.ready());
  EXPECT_EQ(nearby.around(value, kNerve, 1.0, 50.0).size(), 2U);
}

TEST(SurfaceUncertainty, KnowsTheMrThatAStructureWasDrawnOn)
{
  scene::Case value = balls();
  const auto uncertainty = [&value] { return StructureSurfaces(value).uncertainty(0); };
  SurfaceUncertainty found = uncertainty();
  EXPECT_TRUE(found.drawnOn.empty());
  EXPECT_FALSE(found.incomplete());
  EXPECT_EQ(toString(found), "voxels 0.40 x 0.40 x 0.80 mm, slices 0.80 mm apart");

  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = value.labels[0].labels.get()->voxels->geometry();
  value.mr.push_back(mr);
  EXPECT_EQ(StructureSurfaces(value).count(), 0U) << "nobody knows where they are";

  scene::applyRegistration(value, "T2", {}, {});
  found = uncertainty();
  EXPECT_EQ(found.drawnOn, "T2");
  EXPECT_TRUE(found.incomplete());
  EXPECT_FALSE(found.registration);
  EXPECT_EQ(toString(found), "voxels 0.40 x 0.40 x 0.80 mm, slices 0.80 mm apart; drawn on the MR "
                             "'T2', registered, its error unknown");
  NearbyStructure near;
  near.name = "facial_nerve";
  near.distance = 1.84;
  near.uncertainty = found;
  EXPECT_EQ(toString(near), "facial nerve 1.8 mm ± 0.4; registration's error unknown");

  scene::Registration how;
  how.error = scene::RegistrationError{kNerve + Vector3d(0.0, 0.0, 14.0), "the incus", 0.1, 0.3, 1};
  scene::applyRegistration(value, "T2", {}, how);
  found = uncertainty();
  EXPECT_FALSE(found.incomplete());
  EXPECT_NEAR(found.millimetres(), 0.5, 1e-12);
  near.uncertainty = found;
  EXPECT_EQ(toString(near),
            "facial nerve 1.8 mm ± 0.5; registration 0.3 mm (p95), but 14 mm from here");
  EXPECT_NE(toString(found).find("'T2'; registered to 0.30 mm (p95) at the incus, 14 mm from here, "
                                 "where it may be more"),
            std::string::npos)
      << toString(found);

  value.labels[0].drawnOn = ""; // declared to be the CT's
  EXPECT_TRUE(uncertainty().drawnOn.empty());
}

// Rotation about the x axis alone, through a place 60 mm away: 1.96 deviations at the corner of the
// structure's box that is farthest from that axis.
TEST(SurfaceUncertainty, IsTheRegistrationsWhereTheStructureLies)
{
  constexpr double kTurn = 0.01; // rad
  scene::Case value = balls();
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = value.labels[0].labels.get()->voxels->geometry();
  value.mr.push_back(mr);
  const auto p95At = [&value](const Vector3d& about)
  {
    scene::Registration how;
    how.error = scene::RegistrationError{about, "the incus", 0.01, 0.02, 0.03};
    how.error->spread = core::RigidSpread{about};
    how.error->spread->moments(3, 3) = kTurn * kTurn;
    scene::applyRegistration(value, "T2", {}, how);
    const SurfaceUncertainty found = StructureSurfaces(value).uncertainty(0);
    EXPECT_TRUE(found.registration && found.registration->place.empty());
    EXPECT_NEAR(found.millimetres(), std::hypot(0.5 * kSlice, found.registration->p95), 1e-12);
    return found.registration->p95;
  };
  for (const double away : {60.0, 120.0})
  {
    // The box reaches at least to the sphere, and no more than two voxels beyond it.
    const double least = std::hypot(away + kRadius, kRadius);
    const double most = std::hypot(away + kRadius + 2.0 * kVoxel, kRadius + 2.0 * kSlice);
    const double found = p95At(kNerve + Vector3d(25.0, away, 0.0));
    EXPECT_GT(found, 0.98 * 1.96 * kTurn * (least - kVoxel));
    EXPECT_LT(found, 1.02 * 1.96 * kTurn * most);
  }
  EXPECT_GT(p95At(kNerve + Vector3d(0.0, 80.0, 0.0)), 1.5) << "not the 0.02 mm of the incus";

  NearbyStructure near;
  near.name = "facial_nerve";
  near.distance = 1.84;
  near.uncertainty = StructureSurfaces(value).uncertainty(0);
  const std::string error = core::fixedText(near.uncertainty.registration->p95, 2);
  EXPECT_NE(toString(near.uncertainty).find("'T2'; registered to " + error + " mm (p95) here"),
            std::string::npos)
      << toString(near.uncertainty);
  EXPECT_NE(toString(near).find("; registration 1."), std::string::npos) << toString(near);

  // 3.2 mm off the surface, and a warning distance of 2 mm: by more than 1.2 mm of uncertainty.
  const auto state = [&]
  {
    NearbyStructures nearby(value);
    nearby.surfaces();
    return nearby.around(value, kNerve - Vector3d(0.0, 0.0, kRadius + 1.0 + 3.2), 1.0, 50.0)
        .front()
        .state;
  };
  EXPECT_EQ(state(), State::Warned);
  p95At(kNerve);
  EXPECT_EQ(state(), State::Clear);
}

TEST(NearbyStructures, AreWhereTheirMrLiesOnTheCt)
{
  scene::Case value = balls();
  const core::RigidTransform mrFromCt(Eigen::Quaterniond(0.9, 0.3, -0.1, 0.2), {5.0, -9.0, 20.0});
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = value.labels[0].labels.get()->voxels->geometry();
  value.mr.push_back(mr);
  scene::applyRegistration(value, "T2", mrFromCt, {});
  NearbyStructures nearby(value);
  nearby.surfaces();
  const auto near = nearby.around(value, mrFromCt.inverse() * kNerve, 1.0, 5.0);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].name, "facial_nerve");
  EXPECT_EQ(near[0].state, State::Touched);
  EXPECT_TRUE(nearby.around(value, mrFromCt * kNerve, 1.0, 5.0).empty());
}
