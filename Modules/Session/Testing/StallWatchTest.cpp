#include "petrous/Session/StallWatch.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace petrous;
using petrous::session::StallWatch;
using session::TickRecord;

namespace
{

// A tick of a burr that drills at a height, pressed with 1 N, of which the fraction `share` acts on
// the burr; `mask` changes with what is removed.
TickRecord tick(double now, double height, double share = 1.0, std::uint8_t held = 0,
                std::uint64_t mask = 0)
{
  TickRecord record;
  record.input.now = now;
  record.drill = 1;
  record.proxy = session::PoseValues::of({{0.0, 0.0, height}, Eigen::Quaterniond::Identity()});
  record.wrench.force[2] = 1.0;
  record.thrust = share;
  record.held = held;
  record.maskState = mask;
  return record;
}

} // namespace

TEST(StallWatch, TellsOfABurrThatMakesNoWayAsLongAsThatIsSo)
{
  StallWatch watch;
  double now = 1.0;
  std::uint64_t mask = 0;
  for (; now < 6.0; now += 0.1)
    watch.see(tick(now, -2.0 * now, 1.0, 0, ++mask)); // 2 mm/s
  EXPECT_FALSE(watch.stalls());
  const double stop = now;
  for (; now < stop + 9.0; now += 0.1)
  {
    watch.see(tick(now, -12.0, 1.0, 0, mask));
    if (std::abs(now - stop - StallWatch::kAfter) > 0.3)
    {
      EXPECT_EQ(watch.stalls(), now - stop > StallWatch::kAfter) << now - stop;
    }
    EXPECT_EQ(watch.heldBy(), 0);
  }
  watch.see(tick(now, -12.2, 1.0, 0, mask + 1));
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
  watch.see(tick(12.0, -0.5, 1.0, 0, 1)); // it cuts again
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

// Dragged about on what is set not to be drilled: it moves, and the mask stays as it is.
TEST(StallWatch, TellsOfABurrThatSlidesAndRemovesNothing)
{
  StallWatch watch;
  double now = 1.0;
  for (; now < 1.0 + 0.9 * StallWatch::kAfter; now += 0.1)
  {
    watch.see(tick(now, 5.0 * now, 1.0, 0, 7));
    EXPECT_FALSE(watch.stalls()) << now;
  }
  for (; now < 6.0; now += 0.1)
    watch.see(tick(now, 5.0 * now, 1.0, 0, 7));
  EXPECT_TRUE(watch.stalls());
  watch.see(tick(now, 5.0 * now, 1.0, 0, 8));
  EXPECT_FALSE(watch.stalls());
}

// Pressed where tissue keeps the burr away: it trembles between two contacts and does not drill.
TEST(StallWatch, TellsOfABurrThatDoesNotGetToWhereItIsPressed)
{
  StallWatch watch;
  const auto onItsWay = [](double now, double height)
  {
    TickRecord record = tick(now, height, 1.6, TickRecord::kShaft);
    record.drill = 0;
    record.input.parameters.drill = session::ServoParameters::kDrill;
    return record;
  };
  double now = 1.0;
  for (; now < 1.0 + 0.9 * StallWatch::kAfter; now += 0.1)
  {
    watch.see(onItsWay(now, 0.0));
    EXPECT_FALSE(watch.cannotArrive()) << now;
  }
  for (int n = 0; now < 9.0; now += 0.1, ++n)
    watch.see(onItsWay(now, n % 2 ? 0.04 : 0.0));
  EXPECT_TRUE(watch.cannotArrive());
  EXPECT_FALSE(watch.stalls());

  TickRecord late = onItsWay(now, 0.0); // while a picture takes long
  late.fault = static_cast<std::uint8_t>(session::ServoFault::Device);
  watch.see(late);
  watch.see(onItsWay(now + 0.1, 0.0));
  EXPECT_TRUE(watch.cannotArrive());

  watch.see(tick(now + 0.2, -1.0, 1.0, 0, 1));
  EXPECT_FALSE(watch.cannotArrive());
  for (; now < 20.0; now += 0.1)
    watch.see(onItsWay(now, 0.0));
  EXPECT_TRUE(watch.cannotArrive());
  TickRecord released = onItsWay(now, 0.0);
  released.input.parameters.drill = 0;
  watch.see(released);
  EXPECT_FALSE(watch.cannotArrive());

  StallWatch clutched;
  for (now = 1.0; now < 9.0; now += 0.1)
  {
    TickRecord record = onItsWay(now, 0.0);
    record.input.parameters.clutch = 1;
    clutched.see(record);
    EXPECT_FALSE(clutched.cannotArrive());
  }
}
