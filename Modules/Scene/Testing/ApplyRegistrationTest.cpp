#include <gtest/gtest.h>

#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/ReferenceFrames.h"

using namespace petrous;
using Eigen::Vector3d;
using scene::Registration;

namespace
{

core::RigidTransform turned(double x, double y, double z, double shift)
{
  return {Eigen::Quaterniond(1.0, x, y, z), {shift, -shift, 2.0 * shift}};
}

scene::Case caseWith(const std::vector<std::string>& names)
{
  scene::Case value;
  value.name = "ear";
  for (const std::string& name : names)
  {
    scene::ImagePart mr;
    mr.name = name;
    value.mr.push_back(mr);
  }
  return value;
}

Registration measured(const std::string& through = {})
{
  Registration how;
  how.verdict = Registration::Verdict::Good;
  how.error = scene::RegistrationError{{1.0, 2.0, 3.0}, "incus", 0.1, 0.24, 0.3};
  how.through = through;
  return how;
}

} // namespace

TEST(ApplyRegistration, SaysHowAndHowWell)
{
  scene::Case value = caseWith({"T2"});
  EXPECT_EQ(scene::registrationToString(value.mr[0]), "not registered");
  Registration how = measured();
  how.method = Registration::Method::Landmarks;
  how.refined = true;
  scene::applyRegistration(value, "T2", turned(0.1, 0.0, 0.0, 5.0), how);
  EXPECT_TRUE(value.mr[0].registered);
  EXPECT_EQ(scene::registrationToString(value.mr[0]),
            "registered by landmarks, refined by mutual information, good, error 0.24 mm (p95) at "
            "incus, not signed off");
  EXPECT_THROW(scene::applyRegistration(value, "T1", {}, how), core::InvalidParameter);
  Registration hand;
  hand.method = Registration::Method::ByHand;
  scene::applyRegistration(value, "T2", {}, hand);
  EXPECT_EQ(scene::registrationToString(value.mr[0]),
            "registered by hand, not judged, its error unknown, not signed off");
  scene::removeRegistration(value, "T2");
  EXPECT_FALSE(value.mr[0].registered);
  EXPECT_EQ(value.mr[0].mrFromCt.matrix(), Eigen::Matrix4d::Identity());
}

TEST(ApplyRegistration, ASignOffHoldsForTheTransformThatWasSigned)
{
  scene::Case value = caseWith({"T2"});
  EXPECT_THROW(scene::signOff(value, "T2", "A. Surgeon", "2026-01-02T03:04:05Z"),
               core::InvalidParameter);
  const core::RigidTransform there = turned(0.1, 0.2, 0.0, 5.0);
  scene::applyRegistration(value, "T2", there, measured());
  EXPECT_FALSE(scene::validSignOff(value.mr[0])) << "never assumed";
  for (const std::string& bad : {std::string(), std::string("  "), std::string("a\nb"),
                                 std::string(101, 'a'), std::string("\xff")})
    EXPECT_THROW(scene::signOff(value, "T2", bad, "2026-01-02T03:04:05Z"), core::InvalidParameter);
  scene::signOff(value, "T2", "A. Surgeon", "2026-01-02T03:04:05Z");
  ASSERT_TRUE(scene::validSignOff(value.mr[0]));
  EXPECT_NE(scene::registrationToString(value.mr[0])
                .find("signed off by A. Surgeon on 2026-01-02T03:04:05Z"),
            std::string::npos);

  scene::Case nudged = value; // by code unaware of sign-offs
  nudged.mr[0].mrFromCt = {there.rotation(), there.translation() + Vector3d(1e-9, 0.0, 0.0)};
  EXPECT_FALSE(scene::validSignOff(nudged.mr[0]));

  Registration again = *value.mr[0].registration; // including the sign-off
  scene::applyRegistration(value, "T2", there, again);
  EXPECT_FALSE(scene::validSignOff(value.mr[0])) << "another registration, nobody looked at it";
}

TEST(ApplyRegistration, WhatCameThroughAnotherMovesAlongAndSaysSo)
{
  scene::Case value = caseWith({"DWI", "T2"});
  const core::RigidTransform first = turned(0.1, 0.2, 0.0, 5.0);
  const core::RigidTransform step = turned(0.0, 0.01, 0.02, 0.3); // DWI from T2
  const core::RigidTransform second = turned(-0.1, 0.0, 0.3, -8.0);
  scene::applyRegistration(value, "T2", first, measured());
  scene::applyRegistration(value, "DWI", step * first, measured("T2"));
  scene::signOff(value, "DWI", "A. Surgeon", "2026-01-02T03:04:05Z");
  scene::applyRegistration(value, "T2", first, measured());
  EXPECT_TRUE(value.mr[0].registration->error) << "nothing has moved";
  EXPECT_TRUE(scene::validSignOff(value.mr[0]));

  scene::applyRegistration(value, "T2", second, measured());
  const Vector3d point(10.0, -20.0, 30.0);
  EXPECT_LT((value.mr[0].mrFromCt * point - step * (second * point)).norm(), 1e-12);
  EXPECT_EQ(value.mr[0].registration->verdict, Registration::Verdict::NotJudged);
  EXPECT_FALSE(value.mr[0].registration->error);
  EXPECT_FALSE(scene::validSignOff(value.mr[0]));
  EXPECT_NE(scene::registrationToString(value.mr[0]).find("through 'T2', not judged"),
            std::string::npos);

  scene::removeRegistration(value, "T2");
  EXPECT_FALSE(value.mr[0].registered) << "it hung on the other";
}

TEST(ApplyRegistration, RefusesACircle)
{
  scene::Case value = caseWith({"A", "B", "C"});
  EXPECT_THROW(scene::applyRegistration(value, "A", {}, measured("A")), core::InvalidParameter);
  scene::applyRegistration(value, "A", {}, measured());
  scene::applyRegistration(value, "B", {}, measured("A"));
  scene::applyRegistration(value, "C", {}, measured("B"));
  EXPECT_THROW(scene::applyRegistration(value, "A", turned(0.1, 0.0, 0.0, 1.0), measured("C")),
               core::InvalidParameter);
  EXPECT_EQ(value.mr[0].registration->through, "");
}

TEST(ApplyRegistration, AChainIsLaidAsItLayWhateverTheOrderOfItsLinks)
{
  scene::Case value = caseWith({"ADC", "DWI", "T2"}); // the last link comes first
  scene::applyRegistration(value, "T2", turned(0.1, 0.0, 0.0, 5.0), measured());
  scene::applyRegistration(value, "DWI", turned(0.1, 0.2, 0.0, 3.0), measured("T2"));
  scene::applyRegistration(value, "ADC", turned(0.0, 0.2, 0.1, 1.0), measured("DWI"));
  const auto before = scene::mrPlaces(value);
  const auto expectAsBefore = [&]
  {
    for (std::size_t n = 0; n < before.size(); ++n)
    {
      EXPECT_EQ(value.mr[n].registered, before[n].registered) << before[n].name;
      EXPECT_EQ(value.mr[n].mrFromCt.matrix(), before[n].mrFromCt.matrix()) << before[n].name;
      ASSERT_TRUE(value.mr[n].registration) << before[n].name;
      EXPECT_EQ(value.mr[n].registration->through, before[n].registration->through);
      EXPECT_TRUE(value.mr[n].registration->error) << before[n].name;
    }
  };
  scene::applyRegistration(value, "T2", turned(0.0, 0.0, 0.3, -2.0), measured());
  EXPECT_FALSE(value.mr[0].registration->error) << "moved along";
  scene::layAs(value, before);
  expectAsBefore();
  scene::removeRegistration(value, "T2");
  EXPECT_FALSE(value.mr[0].registered);
  scene::layAs(value, before);
  expectAsBefore();
}

TEST(ApplyRegistration, WhatWasNotSaidOfAnOlderCaseIsNotMadeUpByUndo)
{
  scene::Case value = caseWith({"T2"});
  value.mr[0].registered = true;
  value.mr[0].mrFromCt = turned(0.1, 0.0, 0.0, 5.0);
  const auto before = scene::mrPlaces(value);
  scene::applyRegistration(value, "T2", {}, measured());
  scene::layAs(value, before);
  EXPECT_TRUE(value.mr[0].registered);
  EXPECT_EQ(scene::registrationToString(value.mr[0]), "registered, not said how");
}

TEST(ApplyRegistration, OnlyWhatMovesLosesItsSignatureWhenMrsAreLaidAsTheyLay)
{
  scene::Case value = caseWith({"T2", "DWI"});
  scene::applyRegistration(value, "T2", turned(0.1, 0.0, 0.0, 5.0), measured());
  scene::applyRegistration(value, "DWI", turned(0.1, 0.2, 0.0, 3.0), measured());
  const auto before = scene::mrPlaces(value);
  scene::applyRegistration(value, "T2", {}, measured());
  for (const char* name : {"T2", "DWI"})
    scene::signOff(value, name, "A. Surgeon", "2026-01-31T10:00:00Z");
  scene::layAs(value, before);
  EXPECT_EQ(scene::validSignOff(value.mr[0]), nullptr);
  EXPECT_NE(scene::validSignOff(value.mr[1]), nullptr);
}

TEST(ApplyRegistration, RefusesATransformThatLeavesTheImagesNothingInCommon)
{
  scene::Case value = caseWith({"T2"});
  for (const double far : {1e39, 1e5, 600.0})
    EXPECT_THROW(scene::applyRegistration(value, "T2",
                                          {Eigen::Quaterniond::Identity(), Vector3d(0.0, far, 0.0)},
                                          measured()),
                 core::InvalidParameter)
        << far;
  EXPECT_FALSE(value.mr[0].registered);
  scene::applyRegistration(value, "T2", {Eigen::Quaterniond::Identity(), Vector3d(0.0, 400.0, 0.0)},
                           measured());
  EXPECT_TRUE(value.mr[0].registered);
}
