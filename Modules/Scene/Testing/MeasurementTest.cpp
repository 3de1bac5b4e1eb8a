#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <Eigen/Geometry>

#include "DrilledCase.h"
#include "petrous/Core/Error.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using namespace petrous::scene;
using Eigen::Vector3d;
using Kind = Measurement::Kind;

namespace
{

constexpr double kPi = 3.141592653589793;

Case emptyCase()
{
  Case value;
  value.name = "ear";
  return value;
}

Measurement made(Kind kind, const std::string& name, std::vector<Vector3d> points)
{
  Measurement one;
  one.kind = kind;
  one.name = name;
  one.points = std::move(points);
  return one;
}

/// One of each kind, with numbers that only doubles hold.
Case measuredCase()
{
  Case value = emptyCase();
  const Vector3d a(1.0 / 3.0, -2.5e-7, 30.000000000000004);
  const Vector3d b = a + Vector3d(1, 2, 0);
  const Vector3d c = a + Vector3d(0, 2, 1.0 / 7.0);
  value.measurements = {
      made(Kind::Mark, "Foramen mastoideum ü", {a}), made(Kind::Distance, "a to b", {a, b}),
      made(Kind::Length, "nerve", {a, b, c, a}),     made(Kind::Angle, "angle 1", {a, b, c}),
      made(Kind::Area, "area 1", {a, b, c}),         made(Kind::Thickness, "wall", {a, b, c})};
  value.measurements[1].shown = false;
  value.measurements[2].structure = "facial_nerve";
  value.measurements[2].structureGone = true;
  value.measurements[3].image = "T2";
  setImages(value.measurements[4], {"", "T2", "FLAIR"});
  value.measurements[4].readings = {
      {"T2", core::RigidTransform(Eigen::Quaterniond(0.6, 0.8, 0.0, 0.0), {1.0 / 3.0, 2.0, -7.0})},
      {"FLAIR", core::RigidTransform(), true}};
  return value;
}

nlohmann::json manifestOf(const Case& value)
{
  return nlohmann::json::parse(toManifest(value));
}

std::string refusalOf(const nlohmann::json& j)
{
  try
  {
    fromManifest(j.dump(), "ear.json");
  }
  catch (const ManifestError& error)
  {
    EXPECT_EQ(error.reason, ManifestError::Reason::Damaged);
    return error.what();
  }
  return {};
}

} // namespace

TEST(Measurement, HasTheValueOfItsPoints)
{
  EXPECT_DOUBLE_EQ(*valueOf(Kind::Distance, {{1, 2, 3}, {4, 6, 15}}), 13.0);
  EXPECT_DOUBLE_EQ(*valueOf(Kind::Length, {{0, 0, 0}, {3, 4, 0}, {3, 4, 12}}), 17.0);
  EXPECT_FALSE(valueOf(Kind::Mark, {{1, 2, 3}}));
  // A thickness is that along the normal, its second point, not the shortest.
  EXPECT_DOUBLE_EQ(*valueOf(Kind::Thickness, {{0, 0, 0}, {0, 0, 5}, {0, 0, 4}}), 5.0);
  for (const double degrees : {1e-6, 1.0, 45.0, 90.0, 120.0, 180.0})
  {
    const double t = degrees * kPi / 180.0;
    EXPECT_NEAR(*valueOf(Kind::Angle, {Vector3d(5, 5, 6), Vector3d(5, 5, 5),
                                       Vector3d(5, 5 + 7 * std::sin(t), 5 + 7 * std::cos(t))}),
                degrees, 1e-9);
  }
  EXPECT_FALSE(valueOf(Kind::Angle, {{1, 1, 1}, {1, 1, 1}, {2, 1, 1}}));
}

TEST(Measurement, HasTheAreaOfAPolygonInAnyPlane)
{
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 3).normalized()));
  const auto placed = [&turn](std::vector<Vector3d> points)
  {
    for (Vector3d& point : points)
      point = turn * point + Vector3d(100, -50, 700);
    return points;
  };
  EXPECT_NEAR(*valueOf(Kind::Area, placed({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}})), 12.0,
              1e-9);
  // Not convex: an L.
  EXPECT_NEAR(*valueOf(Kind::Area,
                       placed({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 5, 0}, {0, 5, 0}})),
              8.0, 1e-9);
  std::vector<Vector3d> circle;
  for (int n = 0; n < 720; ++n)
    circle.emplace_back(6 * std::cos(n * kPi / 360), 6 * std::sin(n * kPi / 360), 0.0);
  EXPECT_NEAR(*valueOf(Kind::Area, placed(circle)), 36.0 * kPi, 0.01);
  EXPECT_NEAR(offPlane(placed(circle)), 0.0, 1e-9);
  EXPECT_NEAR(offPlane(placed({{0, 0, 1}, {4, 0, -1}, {4, 3, 1}, {0, 3, -1}})), 1.0, 1e-9);
}

TEST(Measurement, HasNoAreaWhereEdgesCross)
{
  EXPECT_FALSE(valueOf(Kind::Area, {{0, 0, 0}, {4, 3, 0}, {4, 0, 0}, {0, 3, 0}}));
  EXPECT_FALSE(valueOf(Kind::Area, {{0, 0, 0}, {4, 3, 0}, {4, 0, 0}, {0, 5, 0}}));
}

TEST(Measurement, TakesAFreeName)
{
  const std::vector<Measurement> there{made(Kind::Mark, "Mark", {{0, 0, 0}}),
                                       made(Kind::Mark, "mark 2", {{0, 0, 0}})};
  EXPECT_EQ(freeMeasurementName(there, "mark"), "mark 3");
  EXPECT_EQ(freeMeasurementName(there, "angle"), "angle");
  // As long as one may be, and no letter cut in two.
  std::string longest;
  for (int n = 0; n < 50; ++n)
    longest += "ü";
  const std::string next = freeMeasurementName({made(Kind::Mark, longest, {{0, 0, 0}})}, longest);
  EXPECT_LE(next.size(), Measurement::kLongestName);
  EXPECT_NO_THROW(checkMeasurements({made(Kind::Mark, next, {{0, 0, 0}})}));
}

TEST(MeasurementManifest, KeepsEachKindToTheBit)
{
  const Case value = measuredCase();
  const std::string text = toManifest(value);
  EXPECT_EQ(manifestOf(value).at("petrous_case"), 7) << "older programs would lose them";
  const Case back = fromManifest(text, "ear.json");
  ASSERT_EQ(back.measurements.size(), value.measurements.size());
  for (std::size_t n = 0; n < value.measurements.size(); ++n)
    EXPECT_EQ(back.measurements[n], value.measurements[n]) << n;
  EXPECT_EQ(toManifest(back), text);
}

// A case of each earlier format opens without measurements, and is written in its format again.
TEST(MeasurementManifest, LeavesEachEarlierFormatAsItIs)
{
  Case value = emptyCase();
  const auto plain = manifestOf(value);
  EXPECT_EQ(plain.at("petrous_case"), 3);
  EXPECT_FALSE(plain.contains("measurements"));
  for (int format = 1; format <= 6; ++format)
  {
    auto j = plain;
    j["petrous_case"] = format;
    if (format == 1)
    {
      j["dissection"].erase("history");
      j["dissection"]["applied"] = 0;
    }
    if (format == 5)
      j["description"] = {{"note", "five"}};
    if (format == 6)
      j["view"] = {{"light", {{"falloff_mm", 100.0}, {"wetness", 0.5}}}};
    Case back = fromManifest(j.dump(), "ear.json");
    EXPECT_TRUE(back.measurements.empty()) << format;
    EXPECT_EQ(manifestOf(back).at("petrous_case"), format < 5 ? 3 : format) << format;
    back.measurements = measuredCase().measurements;
    const Case again = fromManifest(toManifest(back), "ear.json");
    EXPECT_EQ(again.measurements.size(), 6U) << format;
    EXPECT_EQ(again.description, back.description) << format;
  }
}

TEST(Measurement, KnowsTheImageOfEachPoint)
{
  Measurement one = made(Kind::Distance, "one", {{0, 0, 0}, {1, 0, 0}});
  setImages(one, {"T2", "T2"});
  EXPECT_EQ(one.image, "T2");
  EXPECT_TRUE(one.images.empty());
  EXPECT_EQ(imageOf(one, 1), "T2");
  setImages(one, {"", "T2"});
  EXPECT_EQ(imageOf(one, 0), "");
  EXPECT_EQ(imageOf(one, 1), "T2");
  one.images.pop_back();
  EXPECT_THROW(checkMeasurements({one}), core::InvalidParameter);
}

// Points stay where they were set: the error of an MR that moved since is not theirs.
TEST(Measurement, KnowsWhereTheMrLayWhenItsPointsWereSet)
{
  Case value = emptyCase();
  ImagePart mr;
  mr.name = "T2";
  mr.registered = true;
  value.mr.push_back(mr);
  Measurement one = made(Kind::Distance, "one", {{0, 0, 0}, {1, 0, 0}});
  setReadings(value, one);
  EXPECT_TRUE(one.readings.empty()) << "both on the CT";
  setImages(one, {"T2", "T2"});
  EXPECT_EQ(outdatedPoints(value, one, "T2"), "") << "of an older case";
  setReadings(value, one);
  EXPECT_EQ(one.readings, MrReadings{readingOf(value.mr[0])});
  EXPECT_EQ(outdatedPoints(value, one, "T2"), "");

  value.mr[0].mrFromCt = core::RigidTransform(Eigen::Quaterniond::Identity(), {0.0, 0.5, 0.0});
  EXPECT_EQ(
      outdatedPoints(value, one, "T2"),
      "the MR 'T2', on which points were set, lies elsewhere since: their error is not known");
  EXPECT_EQ(outdatedPoints(value, one, "T1"), "") << "no point was set on it";
  setReadings(value, one, 1); // that point alone is set anew
  EXPECT_EQ(one.readings.size(), 2U);
  EXPECT_NE(outdatedPoints(value, one, "T2"), "");
  setReadings(value, one, 0);
  setReadings(value, one);
  EXPECT_EQ(one.readings, MrReadings{readingOf(value.mr[0])});
  EXPECT_EQ(outdatedPoints(value, one, "T2"), "");

  Measurement mark = made(Kind::Mark, "mark", {{0, 0, 0}});
  setImages(mark, {"T2"});
  setReadings(value, mark);
  value.mr[0].mrFromCt = core::RigidTransform();
  EXPECT_NE(outdatedPoints(value, mark, "T2"), "");
  setReadings(value, mark, 0); // it has no other point
  EXPECT_EQ(outdatedPoints(value, mark, "T2"), "");

  value.measurements = {mark};
  removePart(value, "T2");
  value.mr.push_back(mr);
  EXPECT_NE(outdatedPoints(value, value.measurements[0], "T2").find("not in the case any more"),
            std::string::npos)
      << "another one of its name";
  setImages(mark, {""});
  setReadings(value, mark, 0);
  EXPECT_TRUE(mark.readings.empty());
}

// What follows a structure that was removed does not follow another one of its name.
TEST(Measurement, RemembersThatItsStructureWasRemoved)
{
  Case value = emptyCase();
  const auto addNerve = [&value]
  {
    LabelPart part;
    part.structures.emplace_back();
    part.structures.back().name = "nerve";
    value.labels.push_back(part);
  };
  addNerve();
  value.measurements = {made(Kind::Length, "along", {{0, 0, 0}, {1, 0, 0}}),
                        made(Kind::Distance, "free", {{0, 0, 0}, {1, 0, 0}})};
  value.measurements[0].structure = "nerve";
  removePart(value, "nerve");
  EXPECT_TRUE(value.measurements[0].structureGone);
  EXPECT_FALSE(value.measurements[1].structureGone);
  addNerve();
  EXPECT_TRUE(value.measurements[0].structureGone);
  recallStructure(value.measurements, "nerve", {"along"});
  EXPECT_FALSE(value.measurements[0].structureGone);
}

// As programs wrote that did not know better.
TEST(MeasurementManifest, AStructureThatIsNotThereIsGone)
{
  Case value = emptyCase();
  value.measurements = {made(Kind::Length, "along", {{0, 0, 0}, {1, 0, 0}})};
  value.measurements[0].structure = "nerve";
  EXPECT_TRUE(fromManifest(toManifest(value), "m").measurements[0].structureGone);
}

TEST(MeasurementManifest, RefusesWhatIsHostile)
{
  const auto good = manifestOf(measuredCase());
  const auto refused = [&good](const char* pointer, const nlohmann::json& bad)
  {
    auto j = good;
    j[nlohmann::json::json_pointer(std::string("/measurements") + pointer)] = bad;
    EXPECT_FALSE(refusalOf(j).empty()) << pointer << " " << bad.dump().substr(0, 80);
  };
  refused("", 7);
  refused("", "none");
  refused("", nullptr);
  refused("", nlohmann::json::object());
  refused("/0", 7);
  refused("/0", nlohmann::json::array());
  for (const char* name : {"", " a", "a ", "a\nb", "\x1b[2J", "A to B", "zero\xe2\x80\x8bwidth",
                           "\xe2\x80\xae"
                           "abc",
                           "soft\xc2\xadhyphen", "tag\xf3\xa0\x81\x81", "\xc2\x9b"})
    refused("/0/name", name);
  refused("/0/name", std::string(Measurement::kLongestName + 1, 'n'));
  refused("/0/name", 7);
  refused("/0/kind", "volume");
  refused("/0/kind", "Mark");
  refused("/0/kind", nullptr);
  refused("/0/points_mm", 7);
  refused("/0/points_mm", nlohmann::json::array());
  refused("/0/points_mm", {{0, 0, 0}, {1, 1, 1}});
  refused("/0/points_mm", {{0, 0}});
  refused("/0/points_mm/0", {0, 0, "1"});
  refused("/0/points_mm/0/2", nullptr);
  refused("/0/points_mm/0/2", 1e300);
  refused("/0/points_mm/0/2", 1.0000001e5);
  refused("/0/points_mm", {{"a", {0, 0, 0}}});
  refused("/1/points_mm", {{0, 0, 0}});
  refused("/3/points_mm", {{0, 0, 0}, {1, 1, 1}});
  refused("/4/points_mm", {{0, 0, 0}, {1, 1, 1}});
  refused("/5/points_mm", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  refused("/0/shown", "yes");
  refused("/0/structure", "ct");
  refused("/0/structure", "a\x07");
  refused("/0/structure", std::string(201, 's'));
  refused("/0/image", 7);
  refused("/0/structure_gone", "yes");
  refused("/4/images", {"T2", ""});
  refused("/4/images", {"T2", "", "ct"});
  refused("/4/images", {"T2", "", 7});
  nlohmann::json many = nlohmann::json::array();
  for (std::size_t n = 0; n <= Measurement::kMostPoints; ++n)
    many.push_back({1.0 * static_cast<double>(n), 0.0, 0.0});
  refused("/2/points_mm", many);
  many = nlohmann::json::array();
  for (std::size_t n = 0; n <= Measurement::kMax; ++n)
    many.push_back({{"kind", "mark"}, {"name", std::to_string(n)}, {"points_mm", {{0, 0, 0}}}});
  refused("", many);
  many.erase(0);
  auto most = good;
  most["measurements"] = many;
  EXPECT_EQ(fromManifest(most.dump(), "m").measurements.size(), Measurement::kMax);

  // Nor is it written.
  Case value = measuredCase();
  value.measurements[0].points[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(toManifest(value), core::InvalidParameter);
  value = measuredCase();
  value.measurements[0].name = "\xff";
  EXPECT_THROW(toManifest(value), core::InvalidParameter);
}
