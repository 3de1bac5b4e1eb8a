#include <gtest/gtest.h>

#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Scene/MrReading.h"

using namespace petrous;
using scene::MrReading;

namespace
{

const core::RigidTransform kThere(Eigen::Quaterniond(1.0, 0.1, 0.2, 0.3), {1.0, -2.0, 3.0});
const core::RigidTransform kElsewhere(Eigen::Quaterniond(1.0, 0.1, 0.2, 0.3), {11.0, -2.0, 3.0});

// An MR, and a structure that was made from it.
scene::Case madeFromT2()
{
  scene::Case value;
  value.name = "ear";
  scene::ImagePart mr;
  mr.name = "T2";
  value.mr.push_back(mr);
  scene::applyRegistration(value, "T2", kThere, {});
  scene::StructurePart structure;
  structure.name = "bright";
  structure.readings = {scene::readingOf(value.mr.front())};
  scene::LabelPart part;
  part.drawnOn = "";
  part.structures.push_back(structure);
  value.labels.push_back(part);
  return value;
}

const scene::MrReadings& readings(const scene::Case& value)
{
  return value.labels.front().structures.front().readings;
}

} // namespace

TEST(MrReading, IsOutdatedOnceTheMrLiesElsewhereAndNotWhenItIsBack)
{
  scene::Case value = madeFromT2();
  EXPECT_EQ(scene::outdatedReading(value, readings(value)), "");
  EXPECT_EQ(scene::namesOf(readings(value)), "'T2'");
  scene::applyRegistration(value, "T2", kElsewhere, {});
  EXPECT_NE(scene::outdatedReading(value, readings(value)).find("'T2'"), std::string::npos);
  scene::applyRegistration(value, "T2", kThere, {});
  EXPECT_EQ(scene::outdatedReading(value, readings(value)), "");
  scene::removeRegistration(value, "T2");
  EXPECT_NE(scene::outdatedReading(value, readings(value)).find("not registered"),
            std::string::npos);
  EXPECT_EQ(scene::outdatedReading(value, readings(value), scene::MadeFromMr::Points),
            "the MR 'T2', on which points were set, is not registered any more: their error is not "
            "known");
}

TEST(MrReading, OfARemovedMrIsNotThatOfAnotherOneOfItsName)
{
  scene::Case value = madeFromT2();
  const scene::ImagePart mr = value.mr.front();
  scene::removePart(value, "T2");
  EXPECT_NE(scene::outdatedReading(value, readings(value)).find("not in the case"),
            std::string::npos);
  value.mr.push_back(mr);
  EXPECT_FALSE(scene::isCurrent(value, readings(value).front()));
}

TEST(MrReading, OfSeveralIsOutdatedWithOne)
{
  scene::Case value = madeFromT2();
  scene::ImagePart other;
  other.name = "T1";
  value.mr.push_back(other);
  scene::applyRegistration(value, "T1", kElsewhere, {});
  scene::MrReadings all = readings(value);
  scene::addReadings(all, {scene::readingOf(value.mr[1]), all.front()});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(scene::namesOf(all), "'T2', 'T1'");
  EXPECT_EQ(scene::outdatedReading(value, all), "");
  scene::applyRegistration(value, "T1", kThere, {});
  EXPECT_NE(scene::outdatedReading(value, all).find("'T1'"), std::string::npos);
}

TEST(MrReading, IsKeptInTheManifest)
{
  const scene::Case value = madeFromT2();
  scene::Case read = scene::fromManifest(scene::toManifest(value), "test");
  ASSERT_EQ(readings(read).size(), 1U);
  EXPECT_EQ(readings(read).front().mr, "T2");
  EXPECT_EQ(scene::outdatedReading(read, readings(read)), "");
  scene::applyRegistration(read, "T2", kElsewhere, {});
  read = scene::fromManifest(scene::toManifest(read), "test");
  EXPECT_NE(scene::outdatedReading(read, readings(read)), "");
}

TEST(TracedTubes, AreKeptInTheManifestAndNeverMoreUnresolvedThanLong)
{
  scene::Case value = madeFromT2();
  scene::TracedTubes& tubes = value.labels.front().structures.front().tubes;
  const auto read = [&value]
  {
    const scene::Case back = scene::fromManifest(scene::toManifest(value), "test");
    return back.labels.front().structures.front().tubes;
  };
  EXPECT_TRUE(read() == scene::TracedTubes());
  tubes = {12.0, 3.5, 7};
  tubes += {8.0, 0.5, 1};
  EXPECT_EQ(read().length, 20.0);
  EXPECT_EQ(read().unresolved, 4.0);
  EXPECT_EQ(read().bridging, 8U);
  tubes.unresolved = 20.5;
  EXPECT_THROW(read(), core::Error);
  tubes.unresolved = -0.5;
  EXPECT_THROW(read(), core::Error);
}

TEST(Registration, OfAFileIsNotByHand)
{
  scene::Registration how;
  how.method = scene::Registration::Method::ByHand;
  EXPECT_EQ(methodToString(how), "hand");
  how.isFromFile = true;
  EXPECT_EQ(methodToString(how), "the transform of a file");
  scene::Case value = madeFromT2();
  scene::applyRegistration(value, "T2", kThere, how);
  const scene::Case read = scene::fromManifest(scene::toManifest(value), "test");
  EXPECT_TRUE(read.mr.front().registration->isFromFile);
}
