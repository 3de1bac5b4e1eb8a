#include <cmath>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/Measuring.h"

using namespace petrous;
using namespace petrous::presenters;
using namespace petrous::presenters::testing;
using Eigen::Vector3d;
using Kind = scene::Measurement::Kind;

namespace
{

constexpr double kPi = 3.141592653589793;

scene::Case twoBallsAndATube()
{
  const core::GridGeometry grid({81, 61, 61}, Vector3d(0.4, 0.4, 0.5), Vector3d(-16, -12, -15));
  return shapeCase(grid, {{"left", ball({-8, 0, 0}, 4.0)},
                          {"right", ball({8, 3, 0}, 3.0)},
                          {"canal", cylinder({-10, -8, -8}, {10, -8, -8}, 2.0)}});
}

/// Of coarse voxels, registered to 1.5 mm.
void addT2(scene::Case& value)
{
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = core::GridGeometry({10, 10, 10}, Vector3d(1.0, 1.2, 3.0), Vector3d::Zero());
  mr.registration.emplace();
  mr.registration->error = scene::RegistrationError{};
  mr.registration->error->p95 = 1.5;
  value.mr.push_back(mr);
}

scene::Measurement made(Kind kind, std::vector<Vector3d> points, const std::string& image = {})
{
  scene::Measurement one;
  one.kind = kind;
  one.name = "one";
  one.points = std::move(points);
  one.image = image;
  return one;
}

const Quantity& named(const std::vector<Quantity>& all, const std::string& name)
{
  for (const Quantity& one : all)
    if (one.name == name)
      return one;
  ADD_FAILURE() << "no " << name;
  return all.front();
}

} // namespace

TEST(Quantity, IsWrittenAsItsUncertaintyDeserves)
{
  EXPECT_EQ(toString({"", 12.345, "mm", 0.353, {}}), "12.35 mm ± 0.35");
  EXPECT_EQ(toString({"", 90.0, "°", 1.84, {}}), "90.0° ± 1.8");
  EXPECT_EQ(toString({"", 1234.5, "mm³", 84.2, {}}), "1234 mm³ ± 84");
  EXPECT_EQ(toString({"", -0.001, "mm", 0.3, {}}), "0.00 mm ± 0.30");
  EXPECT_EQ(toString({"", 3.0, "mm", std::nullopt, {}}), "3.00 mm, uncertainty unknown");
  EXPECT_EQ(toString({"", std::nullopt, "mm²", std::nullopt, {}}), "unknown");
}

// Points of several images: each has its own voxels, and the registration lies between them.
TEST(Uncertainty, OfPointsOnSeveralImagesIsThatOfTheWorseAndOfTheRegistration)
{
  scene::Case value = twoBallsAndATube(); // 0.4 x 0.4 x 0.5 mm
  addT2(value);
  const auto of = [&](std::vector<std::string> images)
  {
    scene::Measurement one = made(Kind::Distance, {{1, 2, 3}, {11, 2, 3}});
    scene::setImages(one, std::move(images));
    return quantitiesOf(value, one)[0];
  };
  EXPECT_NEAR(*of({"", ""}).uncertainty, std::sqrt(2.0) * 0.2, 1e-6);
  EXPECT_NEAR(*of({"T2", "T2"}).uncertainty, std::sqrt(2.0) * 0.5, 1e-6);
  EXPECT_NEAR(*of({"", "T2"}).uncertainty, std::sqrt(0.2 * 0.2 + 0.5 * 0.5 + 1.5 * 1.5), 1e-6);
  const std::string remark = of({"", "T2"}).remark;
  EXPECT_NE(remark.find("point 1 set on the CT"), std::string::npos) << remark;
  EXPECT_NE(remark.find("point 2 set on the MR 'T2', voxels 1.00 x 1.20 x 3.00 mm"),
            std::string::npos);
  EXPECT_NE(remark.find("registered to 1.50 mm"), std::string::npos);
  value.mr[0].registration->error->p95 = 0.01; // as good as none: still no better than the MR
  EXPECT_NEAR(*of({"", "T2"}).uncertainty, std::sqrt(2.0) * 0.5, 1e-6);
  value.mr[0].registration->error.reset();
  EXPECT_FALSE(of({"", "T2"}).uncertainty);
  EXPECT_NE(of({"", "T2"}).remark.find("error unknown"), std::string::npos);
  EXPECT_FALSE(of({"", "gone"}).uncertainty);
}

// Kept as a measurement, a distance between two images states what it did.
TEST(Between, KnowsTheImagesThatItComparesAndTheRegistrationBetweenThem)
{
  scene::Case value = twoBallsAndATube();
  addT2(value);
  value.measurements = {made(Kind::Mark, {{1, 2, 3}}), made(Kind::Mark, {{4, 6, 3}}, "T2")};
  value.measurements[1].name = "other";
  const Between between = distanceBetween(value, "one", "other");
  EXPECT_EQ(between.images[0], "");
  EXPECT_EQ(between.images[1], "T2");
  scene::Measurement kept = made(Kind::Distance, {between.from, between.to});
  scene::setImages(kept, {between.images[0], between.images[1]});
  ASSERT_TRUE(between.distance.uncertainty);
  EXPECT_NEAR(*quantitiesOf(value, kept)[0].uncertainty, *between.distance.uncertainty, 1e-9);
  EXPECT_GT(*between.distance.uncertainty, 1.5);
  EXPECT_EQ(distanceBetween(value, "left", "other").images[1], "T2");
}

// Without a spread two points of the MR are taken to shift alike with it.
TEST(Uncertainty, OfAnAngleTakesTheRegistrationOfWhatMovesTogether)
{
  scene::Case value = twoBallsAndATube();
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = core::GridGeometry({9, 9, 9}, Vector3d(1e-3, 1e-3, 1e-3), Vector3d::Zero());
  mr.registration.emplace();
  mr.registration->error = scene::RegistrationError{};
  mr.registration->error->p95 = 1.0;
  value.mr.push_back(mr);
  value.ct.geometry = core::GridGeometry({9, 9, 9}, Vector3d(1e-3, 1e-3, 1e-3), Vector3d::Zero());
  const auto of = [&](std::vector<std::string> images)
  {
    scene::Measurement one = made(Kind::Angle, {{10, 0, 0}, {0, 0, 0}, {0, 10, 0}});
    scene::setImages(one, std::move(images));
    return *quantitiesOf(value, one)[0].uncertainty;
  };
  constexpr double kDegree = 180.0 / kPi;
  // An end moves by 1 mm at 10 mm, or the vertex along the diagonal.
  EXPECT_NEAR(of({"T2", "", ""}), 0.1 * kDegree, 0.02);
  EXPECT_NEAR(of({"", "T2", ""}), std::sqrt(2.0) * 0.1 * kDegree, 0.02);
  EXPECT_NEAR(of({"T2", "", "T2"}), std::sqrt(2.0) * 0.1 * kDegree, 0.02);
}

// An end and the vertex turn together about the z axis by 0.01 rad: the angle changes by as much
// where the axis goes through the vertex or the end, and not at all where it goes through the other
// end, which is then seen from both as before. 1.96 deviations.
TEST(Uncertainty, OfAnAngleHasTheTurnOfWhatMovesTogether)
{
  scene::Case value = twoBallsAndATube();
  value.ct.geometry = core::GridGeometry({9, 9, 9}, Vector3d(1e-3, 1e-3, 1e-3), Vector3d::Zero());
  addT2(value);
  value.mr[0].geometry = value.ct.geometry;
  const Vector3d end(20, 0, 0), vertex(0, 0, 0), other(0, 10, 0);
  const auto turnedAbout = [&](const Vector3d& about, const Vector3d& shift = Vector3d::Zero())
  {
    value.mr[0].registration->error->spread = core::RigidSpread{about};
    core::RigidSpread::Moments& moments = value.mr[0].registration->error->spread->moments;
    moments(5, 5) = 0.01 * 0.01;
    moments.topLeftCorner<3, 3>() = shift.cwiseAbs2().asDiagonal();
    scene::Measurement one = made(Kind::Angle, {end, vertex, other});
    scene::setImages(one, {"T2", "T2", ""});
    return *quantitiesOf(value, one)[0].uncertainty;
  };
  const double turn = 1.96 * 0.01 * 180.0 / kPi;
  EXPECT_NEAR(turnedAbout(vertex), turn, 0.02 * turn);
  EXPECT_NEAR(turnedAbout(end), turn, 0.02 * turn) << "the vertex moves along its other leg";
  EXPECT_LT(turnedAbout(other), 0.02);
  EXPECT_LT(turnedAbout(other, Vector3d(0.0, 1.0, 0.0)), 0.02) << "along the leg";
  EXPECT_NEAR(turnedAbout(other, Vector3d(0.1, 0.0, 0.0)), turn, 0.02 * turn);
}

// Its voxels are on the CT's grid, and yet it lies as well as the MR that it was made from.
TEST(Between, CountsTheRegistrationOfWhatWasMadeFromAnMrUntilThatIsMoved)
{
  scene::Case value = twoBallsAndATube();
  addT2(value);
  value.mr[0].registered = true;
  const double alone = distanceBetween(value, "left", "right").distance.uncertainty.value_or(0.0);
  ASSERT_GT(alone, 0.0);
  scene::findStructure(value, "left")->readings = {scene::readingOf(value.mr[0])};
  const Between made = distanceBetween(value, "left", "right");
  ASSERT_TRUE(made.distance.uncertainty);
  EXPECT_NEAR(*made.distance.uncertainty, std::hypot(alone, 1.5), 1e-6);
  EXPECT_NE(made.distance.remark.find("made from the MR 'T2'"), std::string::npos);
  // In itself it is as large as it is.
  EXPECT_TRUE(named(dimensionsOf(value, "left"), "longest extent").uncertainty);
  value.mr[0].mrFromCt = core::RigidTransform(Eigen::Quaterniond::Identity(), {10.0, 0.0, 0.0});
  const Between moved = distanceBetween(value, "left", "right");
  EXPECT_EQ(moved.distance.value, made.distance.value) << "it stays where it is";
  EXPECT_FALSE(moved.distance.uncertainty);
  EXPECT_NE(moved.distance.remark.find("lies elsewhere since"), std::string::npos)
      << moved.distance.remark;
  scene::Measurement kept;
  kept.kind = Kind::Distance;
  kept.name = "kept";
  kept.points = {moved.from, moved.to};
  scene::setImages(kept, {moved.images[0], moved.images[1]});
  EXPECT_FALSE(quantitiesOf(value, kept)[0].uncertainty);
}

// Points on the MR stay where they are when it is moved, and its registration tells of them no
// more.
TEST(Between, KnowsNoErrorOfAMarkWhoseMrWasMoved)
{
  scene::Case value = twoBallsAndATube();
  addT2(value);
  value.mr[0].registered = true;
  value.measurements = {made(Kind::Mark, {{1, 2, 3}}), made(Kind::Mark, {{4, 6, 3}}, "T2"),
                        made(Kind::Mark, {{4, 6, 9}}, "T2")};
  value.measurements[1].name = "other";
  value.measurements[2].name = "third";
  for (scene::Measurement& one : value.measurements)
    scene::setReadings(value, one);
  scene::Measurement line = made(Kind::Distance, {{1, 2, 3}, {4, 6, 3}});
  scene::setImages(line, {"T2", "T2"});
  scene::setReadings(value, line);
  const auto between = [&value](const char* a, const char* b)
  { return distanceBetween(value, a, b).distance; };
  const auto moves = [](const Quantity& quantity)
  {
    return !quantity.uncertainty &&
           quantity.remark.find("lies elsewhere since") != std::string::npos;
  };
  EXPECT_TRUE(between("one", "other").uncertainty);
  EXPECT_TRUE(between("other", "third").uncertainty);
  EXPECT_TRUE(quantitiesOf(value, value.measurements[1])[0].uncertainty);
  EXPECT_TRUE(quantitiesOf(value, line)[0].uncertainty);

  value.mr[0].mrFromCt = core::RigidTransform(Eigen::Quaterniond::Identity(), {10.0, 0.0, 0.0});
  EXPECT_TRUE(moves(between("one", "other"))) << between("one", "other").remark;
  EXPECT_EQ(between("one", "other").value, 5.0);
  EXPECT_TRUE(moves(quantitiesOf(value, value.measurements[1])[0]));
  EXPECT_TRUE(quantitiesOf(value, line)[0].uncertainty) << "both points lay in one image";
  // One set anew: they do not lie in one image any more.
  scene::setReadings(value, value.measurements[2]);
  EXPECT_TRUE(moves(between("other", "third"))) << between("other", "third").remark;
  scene::setReadings(value, line, 1);
  EXPECT_TRUE(moves(quantitiesOf(value, line)[0])) << quantitiesOf(value, line)[0].remark;
}

// A canal 20 mm long that may be turned about its end next to the mark: its greatest error is that
// at the other end, in the number as in the remark.
TEST(Between, CountsTheErrorOfAStructureThatItStates)
{
  scene::Case value = twoBallsAndATube();
  addT2(value);
  value.mr[0].registered = true;
  value.mr[0].registration->error->spread = core::RigidSpread{{-10, -8, -8}};
  value.mr[0].registration->error->spread->moments(5, 5) = 0.01 * 0.01;
  value.labels[0].drawnOn = "T2";
  value.measurements = {made(Kind::Mark, {{-9, -8, 0}})};
  const Quantity distance = distanceBetween(value, "one", "canal").distance;
  ASSERT_TRUE(distance.uncertainty);
  // The mark half a voxel off along z, the canal half of its longest edge.
  const double registration = std::sqrt(std::pow(*distance.uncertainty, 2) - 2.0 * 0.25 * 0.25);
  EXPECT_GT(registration, 0.98 * 1.96 * 0.01 * 20.0);
  EXPECT_LT(registration, 1.02 * 1.96 * 0.01 * std::hypot(21.0, 3.5));
  const std::string before = "registered to ";
  const std::size_t at = distance.remark.find(before);
  ASSERT_NE(at, std::string::npos) << distance.remark;
  const auto stated = core::parseDouble(distance.remark.substr(at + before.size(), 4));
  ASSERT_TRUE(stated) << distance.remark;
  EXPECT_NEAR(registration, *stated, 0.02);
  // Of a mark on the MR the remark states it, too.
  value.measurements.push_back(made(Kind::Mark, {{10, -8, -8}}, "T2"));
  value.measurements[1].name = "other";
  EXPECT_NE(distanceBetween(value, "one", "other").distance.remark.find("registered to 0.3"),
            std::string::npos);
}

TEST(Quantity, OfWhatFollowedARemovedStructureSaysSo)
{
  const scene::Case value = twoBallsAndATube();
  scene::Measurement along = made(Kind::Length, {{0, 0, 0}, {10, 0, 0}});
  along.structure = "canal";
  along.structureGone = true; // and another is called so
  EXPECT_NE(quantitiesOf(value, along)[0].remark.find("which was removed"), std::string::npos);
  scene::Measurement wall = made(Kind::Thickness, {{0, 0, 0}, {0, 0, 3}});
  wall.structure = "air_cells";
  EXPECT_NE(quantitiesOf(value, wall)[0].remark.find("to 'air cells'"), std::string::npos)
      << quantitiesOf(value, wall)[0].remark;
  wall.structure = "canal";
  EXPECT_TRUE(quantitiesOf(value, wall)[0].uncertainty);
  wall.structureGone = true;
  EXPECT_FALSE(quantitiesOf(value, wall)[0].uncertainty) << "nobody knows on what it was drawn";
}

// Each of the two points may lie half a voxel off along each axis.
TEST(Uncertainty, OfADistanceIsHalfAVoxelAtEachEnd)
{
  const scene::Case value = twoBallsAndATube(); // 0.4 x 0.4 x 0.5 mm
  const auto of = [&](const Vector3d& way)
  {
    return *quantitiesOf(value, made(Kind::Distance, {{1, 2, 3}, Vector3d(1, 2, 3) + way}))[0]
                .uncertainty;
  };
  EXPECT_NEAR(of({10, 0, 0}), std::sqrt(2.0) * 0.2, 1e-6);
  EXPECT_NEAR(of({0, 0, 7}), std::sqrt(2.0) * 0.25, 1e-6);
  EXPECT_NEAR(of({3, 0, 4}), std::sqrt(2.0 * (0.36 * 0.04 + 0.64 * 0.0625)), 1e-6);
  EXPECT_FALSE(quantitiesOf(value, made(Kind::Distance, {{1, 2, 3}, {1, 2, 3}}))[0].uncertainty);
}

// By the formulas of error propagation: the angle at B of legs a and c; a square's area.
TEST(Uncertainty, OfAnAngleAndAnAreaFollowsFromThePoints)
{
  scene::Case value = twoBallsAndATube();
  value.ct.geometry = core::GridGeometry({10, 10, 10}, Vector3d::Constant(0.6), Vector3d::Zero());
  constexpr double kA = 8.0, kC = 5.0, kHalf = 0.3;
  const auto angle = quantitiesOf(value, made(Kind::Angle, {{kA, 0, 0}, {0, 0, 0}, {0, kC, 0}}))[0];
  EXPECT_DOUBLE_EQ(*angle.value, 90.0);
  // d/dA = 1/a, d/dC = 1/c, both across their legs; d/dB = -(1/a, 1/c) across each.
  const double rad = kHalf * std::sqrt(2.0 * (1.0 / (kA * kA) + 1.0 / (kC * kC)));
  EXPECT_NEAR(*angle.uncertainty, rad * 180.0 / kPi, 1e-4);
  const auto area =
      quantitiesOf(value, made(Kind::Area, {{0, 0, 0}, {kA, 0, 0}, {kA, kA, 0}, {0, kA, 0}}))[0];
  EXPECT_DOUBLE_EQ(*area.value, kA * kA);
  // Each corner moves the area by half of its diagonal: 4 (h a sqrt(2) / 2)^2.
  EXPECT_NEAR(*area.uncertainty, kHalf * kA * std::sqrt(2.0), 1e-4);
  const auto crossed =
      quantitiesOf(value, made(Kind::Area, {{0, 0, 0}, {8, 8, 0}, {8, 0, 0}, {0, 8, 0}}))[0];
  EXPECT_FALSE(crossed.value);
  EXPECT_EQ(toString(crossed), "unknown");
}

TEST(Uncertainty, OfAMarkOnAnMrHasItsRegistration)
{
  scene::Case value = twoBallsAndATube();
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = core::GridGeometry({10, 10, 10}, Vector3d(0.8, 0.8, 1.2), Vector3d::Zero());
  mr.mrFromCt = {Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitX())), {1, 2, 3}};
  mr.registered = true;
  mr.registration = scene::Registration();
  value.mr = {mr};
  const scene::Measurement mark = made(Kind::Mark, {{1, 2, 3}}, "T2");
  EXPECT_FALSE(quantitiesOf(value, mark)[0].uncertainty) << "its registration's error is unknown";
  EXPECT_NE(summaryOf(value, mark).find("unknown"), std::string::npos);
  value.mr[0].registration->error = scene::RegistrationError{{1, 2, 13}, "incus", 0.2, 0.5, 0.9};
  const auto known = quantitiesOf(value, mark);
  // The MR's slices lie along the patient's y, a quarter turn from its own z.
  EXPECT_NEAR(*known[0].uncertainty, std::hypot(0.4, 0.5), 1e-9);
  EXPECT_NEAR(*known[1].uncertainty, std::hypot(0.6, 0.5), 1e-9);
  EXPECT_NEAR(*known[2].uncertainty, std::hypot(0.4, 0.5), 1e-9);
  EXPECT_NE(known[0].remark.find("10 mm from here"), std::string::npos) << known[0].remark;
  // With its spread, 10 mm from where it is held, about the x axis alone: 1.96 deviations.
  value.mr[0].registration->error->spread = core::RigidSpread{{1, 2, 13}};
  value.mr[0].registration->error->spread->moments(3, 3) = 0.1 * 0.1;
  const auto here = quantitiesOf(value, mark);
  EXPECT_NEAR(*here[0].uncertainty, std::hypot(0.4, 1.96), 0.04);
  EXPECT_NE(here[0].remark.find(" mm (p95) here"), std::string::npos) << here[0].remark;
  // Within one image its registration moves all alike.
  const auto distance = quantitiesOf(value, made(Kind::Distance, {{0, 0, 0}, {9, 0, 0}}, "T2"))[0];
  EXPECT_NEAR(*distance.uncertainty, std::sqrt(2.0) * 0.4, 1e-6);
  value.mr.clear();
  EXPECT_FALSE(quantitiesOf(value, mark)[0].uncertainty);
}

TEST(Measuring, AWallToWhatWasDrawnOnAnMrHasNoUncertaintyOfTheCtAlone)
{
  scene::Case value = twoBallsAndATube();
  scene::Measurement wall = made(Kind::Thickness, {{0, 0, 0}, {0, 0, 2}, {0, 0, 1.5}});
  wall.structure = "canal";
  for (const Quantity& one : quantitiesOf(value, wall))
    EXPECT_TRUE(one.uncertainty) << one.name;
  value.labels[0].drawnOn = "T2";
  const auto quantities = quantitiesOf(value, wall);
  ASSERT_EQ(quantities.size(), 2U);
  for (const Quantity& one : quantities)
    EXPECT_FALSE(one.uncertainty) << one.name;
  EXPECT_NE(quantities[0].remark.find("drawn on the MR 'T2'"), std::string::npos);
}

TEST(Measuring, FindsTheGapBetweenStructuresMarksAndPoints)
{
  scene::Case value = twoBallsAndATube();
  const double gap = Vector3d(16, 3, 0).norm() - 7.0;
  const Between balls = distanceBetween(value, "left", "right");
  EXPECT_NEAR(*balls.distance.value, gap, 0.25); // their voxels are 0.5 mm
  // Both surfaces half of the longest edge.
  EXPECT_NEAR(*balls.distance.uncertainty, std::sqrt(2.0) * 0.25, 1e-9);
  const Between back = distanceBetween(value, "right", "left");
  EXPECT_NEAR(*back.distance.value, *balls.distance.value, 0.03);
  EXPECT_NEAR((back.from - balls.to).norm(), 0.0, 0.3);
  value.measurements = {made(Kind::Mark, {{-8, 0, 9}})};
  EXPECT_NEAR(*distanceBetween(value, "one", "left").distance.value, 5.0, 0.25);
  EXPECT_NEAR(*distanceBetween(value, "left", "one").distance.value, 5.0, 0.25);
  EXPECT_DOUBLE_EQ(*distanceBetween(value, "one", "one").distance.value, 0.0);
  EXPECT_FALSE(distanceBetween(value, "one", "one").distance.uncertainty);
  EXPECT_THROW(distanceBetween(value, "left", "middle"), core::InvalidParameter);
}

TEST(Measuring, StatesTheDimensionsOfACanal)
{
  const scene::Case value = twoBallsAndATube();
  const auto canal = dimensionsOf(value, "canal");
  // Of the lattice 59 points lie within the circle, in 49 sections: coarse voxels, and their
  // volume.
  EXPECT_NEAR(*named(canal, "volume").value, 59 * 49 * 0.4 * 0.4 * 0.5, 1e-9);
  EXPECT_NEAR(*named(canal, "volume").value, kPi * 4.0 * 20.0, 0.1 * kPi * 80.0);
  EXPECT_GT(*named(canal, "volume").uncertainty, 0.0);
  EXPECT_NEAR(*named(canal, "longest extent").value, 20.0, 0.4);
  EXPECT_NEAR(*named(canal, "second extent").value, 4.0, 0.4);
  EXPECT_NEAR(*named(canal, "third extent").value, 4.0, 0.4);
  EXPECT_NEAR(*named(canal, "largest thickness").value, 4.0, 0.6); // the lattice's inner circle
  EXPECT_NEAR(*named(canal, "length of the centre line").value, 20.0, 0.4);
  EXPECT_NEAR(*named(canal, "median diameter").value, 4.0, 0.25);
  EXPECT_NEAR(*named(canal, "longest extent").uncertainty, std::sqrt(2.0) * 0.25, 1e-9);
  const auto bulb = dimensionsOf(value, "left");
  EXPECT_FALSE(named(bulb, "length of the centre line").value);
  EXPECT_THROW(dimensionsOf(value, "none"), core::InvalidParameter);
}

TEST(Measuring, FollowsAStructureBetweenTwoPoints)
{
  const scene::Case value = twoBallsAndATube();
  const auto whole = alongStructure(value, "canal");
  EXPECT_NEAR(*scene::valueOf(whole.kind, whole.points), 20.0, 0.4);
  const auto part = alongStructure(value, "canal", {{6, -7, -8}, {-3, -9, -8.5}});
  EXPECT_NEAR(*scene::valueOf(part.kind, part.points), 9.0, 0.3);
  EXPECT_EQ(part.structure, "canal");
  // The ends alone are uncertain, each half a voxel along the line, which runs along x.
  EXPECT_NEAR(*quantitiesOf(value, part)[0].uncertainty, std::sqrt(2.0) * 0.2, 0.01);
  EXPECT_THROW(alongStructure(value, "left"), core::InvalidParameter);
}

TEST(Measuring, WritesATableThatIsReadAgain)
{
  scene::Case value = twoBallsAndATube();
  value.measurements = {made(Kind::Distance, {{0, 0, 0}, {0, 0, 2.5}}),
                        made(Kind::Mark, {{-1.25, 2, 3}})};
  value.measurements[0].name = "=HYPERLINK(\"x\"), a";
  value.measurements[1].name = "b";
  const auto rows = core::csvRows(measurementsCsv(value), "t", ',');
  ASSERT_GE(rows.size(), 8U);
  EXPECT_EQ(rows[0].cells, kMeasurementColumns);
  EXPECT_EQ(rows[1].cells[0], "'=HYPERLINK(\"x\"), a");
  EXPECT_EQ(rows[1].cells[3], "2.5");
  EXPECT_EQ(rows[1].cells[4], "mm");
  EXPECT_NEAR(*core::parseDouble(rows[1].cells[5]), std::sqrt(2.0) * 0.25, 1e-6);
  EXPECT_EQ(rows[2].cells[3], "-1.25");
  EXPECT_EQ(rows[5].cells[0], "left");
  EXPECT_EQ(rows[5].cells[5], "unknown");
}

TEST(Measuring, KnowsWhetherItsTableWouldBeEmpty)
{
  scene::Case value = twoBallsAndATube();
  EXPECT_TRUE(hasMeasurementRows(value)) << "the volumes of structures";
  value.labels.clear();
  EXPECT_FALSE(hasMeasurementRows(value));
  const std::string table = measurementsCsv(value);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1) << "the header alone: " << table;
  value.measurements = {made(Kind::Mark, {{-1.25, 2, 3}})};
  EXPECT_TRUE(hasMeasurementRows(value));
}
