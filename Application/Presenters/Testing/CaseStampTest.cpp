#include <gtest/gtest.h>

#include "petrous/Presenters/CaseStamp.h"

using namespace petrous;
using namespace petrous::presenters;

namespace
{

scene::Case stampedCase(const std::string& name)
{
  scene::Case value;
  value.name = name;
  value.description.side = scene::Side::Right;
  value.description.date = "2026-03-31";
  return value;
}

} // namespace

TEST(CaseStamp, HasNameSideAndPlannedDateOfTheCase)
{
  const CaseStamp stamp = stampOf(stampedCase("Smith, John"));
  EXPECT_EQ(stamp.name, "Smith, John");
  EXPECT_EQ(stamp.side, scene::Side::Right);
  EXPECT_EQ(stamp.planned, "2026-03-31");
  const scene::Case fresh;
  EXPECT_EQ(stampOf(fresh).side, scene::Side::Unknown);
}

TEST(CaseStamp, ThatLeavesHasTheSideAlone)
{
  const CaseStamp stamp = leavingStampOf(stampedCase("ear 7"));
  EXPECT_EQ(stamp.name, "");
  EXPECT_EQ(stamp.planned, "");
  EXPECT_EQ(stamp.side, scene::Side::Right);
}

// The scanner's middle is x = 0 (LPS): this image is all right of it.
TEST(CaseStamp, AnEarThatTheCaseDoesNotHaveIsDoubtful)
{
  using scene::Side;
  scene::Case value;
  value.ct.geometry = core::GridGeometry({10, 10, 10}, Eigen::Vector3d::Ones(), {-40, 0, 0});
  EXPECT_EQ(earDoubt(value, Side::Right), "");
  EXPECT_NE(earDoubt(value, Side::Left).find("on the patient's right, 31.0 to 40.0 mm"),
            std::string::npos)
      << earDoubt(value, Side::Left);
  EXPECT_EQ(earDoubt(value, Side::Unknown), "");
  value.description.side = Side::Left; // which is itself doubtful
  EXPECT_NE(sideDoubt(value).find("stated as left"), std::string::npos) << sideDoubt(value);
  EXPECT_NE(earDoubt(value, Side::Right).find("stated as left"), std::string::npos);
  value.ct.geometry = core::GridGeometry({10, 10, 10}, Eigen::Vector3d::Ones(), {-5, 0, 0});
  value.description.side = Side::Both;
  EXPECT_EQ(earDoubt(value, Side::Left), "");
  EXPECT_EQ(earDoubt(value, Side::Right), "");
  EXPECT_EQ(sideDoubt(value), "");
}
