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
