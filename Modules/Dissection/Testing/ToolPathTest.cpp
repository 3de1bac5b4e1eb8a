#include <sstream>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/ToolPath.h"

using namespace petrous;
using dissection::ToolPath;
using dissection::ToolSample;

namespace
{

constexpr const char* kHeader = "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n";

ToolPath pathOf(const std::string& rows)
{
  std::istringstream csv(kHeader + rows);
  return ToolPath::read(csv, "p.csv");
}

std::vector<ToolSample> ticksOf(const ToolPath& path, double rate)
{
  std::vector<ToolSample> ticks;
  path.play(rate, [&ticks](const ToolSample& tick) { ticks.push_back(tick); });
  return ticks;
}

} // namespace

TEST(ToolPath, TicksFromTheFirstRowToTheLast)
{
  const auto ticks = ticksOf(pathOf("0,0,0,0,1,0,0,0,1\n1,10,0,0,1,0,0,0,0\n"), 1000);
  ASSERT_EQ(ticks.size(), 1001u);
  EXPECT_DOUBLE_EQ(ticks.front().time, 0.0);
  EXPECT_DOUBLE_EQ(ticks.back().time, 1.0);
  EXPECT_NEAR(ticks[250].pose.translation()[0], 2.5, 1e-12);
}

TEST(ToolPath, ReachesAnEndBetweenTwoTicks)
{
  const auto ticks = ticksOf(pathOf("0,0,0,0,1,0,0,0,1\n0.25,10,0,0,1,0,0,0,0\n"), 10);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_DOUBLE_EQ(ticks.back().pose.translation()[0], 10.0);
}

TEST(ToolPath, DrillHoldsUntilTheNextRow)
{
  const auto ticks =
      ticksOf(pathOf("0,0,0,0,1,0,0,0,1\n1,1,0,0,1,0,0,0,0\n2,2,0,0,1,0,0,0,1\n"), 4);
  const std::vector<bool> expected{true, true, true, true, false, false, false, false, true};
  ASSERT_EQ(ticks.size(), expected.size());
  for (std::size_t n = 0; n < ticks.size(); ++n)
    EXPECT_EQ(ticks[n].drill, expected[n]) << n;
}

TEST(ToolPath, SwitchesTheDrillAtItsRowAlsoBetweenTwoTicks)
{
  // On from 0.5 to 0.6 s, at one tick per second; the tool moves on afterwards.
  const auto ticks = ticksOf(pathOf("0,0,0,0,1,0,0,0,0\n0.5,5,0,0,1,0,0,0,1\n"
                                    "0.6,6,0,0,1,0,0,0,0\n2,20,0,0,1,0,0,0,0\n"),
                             1);
  ASSERT_EQ(ticks.size(), 5u);
  EXPECT_TRUE(ticks[1].drill);
  EXPECT_DOUBLE_EQ(ticks[1].pose.translation()[0], 5.0);
  EXPECT_FALSE(ticks[2].drill);
  EXPECT_DOUBLE_EQ(ticks[2].pose.translation()[0], 6.0);
  EXPECT_DOUBLE_EQ(ticks[3].time, 1.0);
}

TEST(ToolPath, RefusesAPathWithoutEnd)
{
  EXPECT_THROW(ticksOf(pathOf("0,0,0,0,1,0,0,0,0\n1e17,0,0,0,1,0,0,0,0\n"), 1000),
               core::InvalidParameter);
  EXPECT_THROW(pathOf("0,1e308,0,0,1,0,0,0,0\n"), core::InvalidParameter);
}

TEST(ToolPath, TurnsOnTheShortArc)
{
  // -q is the same rotation as q: no rotation in between.
  const auto ticks = ticksOf(pathOf("0,0,0,0,1,0,0,0,0\n1,0,0,0,-1,0,0,0,0\n"), 2);
  EXPECT_LT(ticks[1].pose.rotation().angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
}

TEST(ToolPath, OneRowIsOneTick)
{
  EXPECT_EQ(ticksOf(pathOf("3,1,2,3,2,0,0,0,1\n"), 1000).size(), 1u);
}

TEST(ToolPath, NamesTheLineThatIsWrong)
{
  const auto complaint = [](const std::string& rows) -> std::string
  {
    try
    {
      pathOf(rows);
    }
    catch (const core::InvalidParameter& error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint("0,0,0,0,1,0,0,0,1\n0,0,0,0,1,0,0,0,1\n").find("p.csv, line 3: time"),
            std::string::npos);
  EXPECT_NE(complaint("0,0,0,0,0,0,0,0,1\n").find("line 2: the quaternion"), std::string::npos);
  EXPECT_NE(complaint("0,0,0,0,1,0,0,0,2\n").find("line 2: drill"), std::string::npos);
  EXPECT_NE(complaint("0,inf,0,0,1,0,0,0,1\n").find("'x_mm'"), std::string::npos);
}
