#include "petrous/Session/StallWatch.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace petrous;
using petrous::session::StallWatch;
using session::TickRecord;

namespace
{

// A tick of a burr that drills at a height, pressed with 1 N, of which the fraction `share` acts on
// the burr.
TickRecord tick(double now, double height, double share = 1.0, std::uint8_t held = 0)
{
  TickRecord record;
  record.input.now = now;
  record.drill = 1;
  record.proxy = session::PoseValues::of({{0.0, 0.0, height}, Eigen::Quaterniond::Identity()});
  record.wrench.force[2] = 1.0;
  record.thrust = share;
  record.held = held;
  return record;
}

} // namespace

TEST(StallWatch, TellsOfABurrThatMakesNoWayAsLongAsThatIsSo)
{
  StallWatch watch;
  double now = 1.0;
  for (; now < 6.0; now += 0.1)
    watch.see(tick(now, -2.0 * now)); // 2 mm/s
  EXPECT_FALSE(watch.stalls());
  const double stop = now;
  for (; now < stop + 9.0; now += 0.1)
  {
    watch.see(tick(now, -12.0));
    if (std::abs(now - stop - StallWatch::kAfter) > 0.3)
    {
      EXPECT_EQ(watch.stalls(), now - stop > StallWatch::kAfter) << now - stop;
    }
    EXPECT_EQ(watch.heldBy(), 0);
  }
  watch.see(tick(now, -12.2));
  EXPECT_FALSE(watch.stalls());
}

// Which contact carries the force changes from tick to tick.
TEST(StallWatch, TellsOfTheShaftAsLongAsItHoldsTheBurr)
{
  StallWatch watch;
  for (double now = 1.0; now < 3.5; now += 0.1)
    watch.see(tick(now, 0.0, 0.1, TickRecord::kShaft));
  EXPECT_EQ(watch.heldBy(), TickRecord::kShaft);
  for (double now = 3.5; now < 12.0; now += 0.1)
  {
    watch.see(tick(now, 0.0));
    EXPECT_EQ(watch.heldBy(), TickRecord::kShaft) << now;
  }
  watch.see(tick(12.0, -0.5)); // it moves again
  EXPECT_EQ(watch.heldBy(), 0);
  EXPECT_FALSE(watch.stalls());
}

TEST(StallWatch, TellsNothingOfABurrThatIsNotPressedOrDoesNotDrill)
{
  StallWatch watch;
  for (double now = 1.0; now < 9.0; now += 0.1)
  {
    TickRecord record = tick(now, 0.0);
    record.wrench.force[2] = 0.0;
    watch.see(record);
    EXPECT_FALSE(watch.stalls());
  }
  for (double now = 9.0; now < 18.0; now += 0.1)
  {
    TickRecord record = tick(now, 0.0, 0.1, TickRecord::kShaft);
    record.drill = 0;
    watch.see(record);
    EXPECT_FALSE(watch.stalls());
    EXPECT_EQ(watch.heldBy(), 0);
  }
}
