#include "petrous/Rendering/RenderQuality.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

// Frame time: constant + proportional to pixels + proportional to samples.
struct Machine
{
  double constant; // ms
  double pixels;   // ms for a picture of scale 1
  double samples;  // ms for a picture of scale 1 with one sample per voxel

  double frame(const RenderQuality& quality) const
  {
    return constant + quality.imageScale * quality.imageScale * (pixels + samples / quality.step);
  }
};

RenderQuality settled(InteractionQuality& interaction, const Machine& machine,
                      const RenderQuality& full = {})
{
  RenderQuality quality;
  for (int frame = 0; frame < 30; ++frame)
  {
    quality = interaction.coarser(full);
    interaction.frameTook(machine.frame(quality), quality);
  }
  return quality;
}

} // namespace

TEST(InteractionQuality, HoldsTheRateOfASlowMachine)
{
  for (const double hz : {15.0, 30.0, 60.0})
    for (const double share : {0.2, 0.5, 0.8}) // fraction of the time spent on samples
    {
      InteractionQuality interaction(hz);
      const Machine machine{1.0, (1.0 - share) * 200.0, share * 200.0};
      const double took = machine.frame(settled(interaction, machine));
      EXPECT_LE(took, 1000.0 / hz) << hz << " " << share;
      EXPECT_GE(took, 0.35 * 1000.0 / hz) << hz << " " << share; // no coarser than necessary
    }
}

TEST(InteractionQuality, StaysFineOnAFastMachine)
{
  InteractionQuality interaction;
  const RenderQuality quality = settled(interaction, {0.2, 2.0, 2.0});
  EXPECT_EQ(quality.imageScale, 1.0);
  EXPECT_EQ(quality.step, RenderQuality().step);
}

TEST(InteractionQuality, FollowsWhenTheSceneBecomesDearer)
{
  InteractionQuality interaction;
  settled(interaction, {1.0, 10.0, 10.0});
  const Machine dear{1.0, 150.0, 150.0};
  EXPECT_LE(dear.frame(settled(interaction, dear)), 1000.0 / 30.0);
  const Machine cheap{0.5, 2.0, 2.0};
  EXPECT_EQ(settled(interaction, cheap).imageScale, 1.0);
}

TEST(InteractionQuality, BeginsAtHalfOfThePicture)
{
  const InteractionQuality interaction;
  EXPECT_EQ(interaction.coarser({}).imageScale, 0.5);
  RenderQuality full;
  full.imageScale = 0.3;
  EXPECT_EQ(interaction.coarser(full).imageScale, 0.3);
}

TEST(InteractionQuality, NeverLeavesItsLimits)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> power(-3.0, 7.0);
  for (const double scale : {0.1, 0.12, 0.5, 1.0})
    for (const double step : {0.1, 0.5, 2.0})
    {
      RenderQuality full;
      full.imageScale = scale;
      full.step = step;
      full.bisections = 5;
      InteractionQuality interaction;
      for (int frame = 0; frame < 300; ++frame)
      {
        const RenderQuality quality = interaction.coarser(full);
        EXPECT_NO_THROW(quality.validate());
        EXPECT_LE(quality.imageScale, full.imageScale);
        EXPECT_GE(quality.imageScale, std::min(InteractionQuality::kSmallestScale, scale));
        EXPECT_GE(quality.step, full.step);
        EXPECT_LE(quality.step, std::max(InteractionQuality::kMaxStep, step));
        EXPECT_EQ(quality.bisections, 5);
        interaction.frameTook(std::pow(10.0, power(random)), quality);
      }
    }
}

TEST(InteractionQuality, PassesOverTimesThatAreNone)
{
  InteractionQuality interaction;
  for (const double time : {0.0, -3.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
  {
    interaction.frameTook(time, {});
    EXPECT_EQ(interaction.coarser({}).imageScale, 0.5);
  }
}

TEST(InteractionQuality, KeepsThePictureSizeWhileTimesWaver)
{
  InteractionQuality interaction;
  const Machine machine{1.0, 60.0, 60.0};
  const double scale = settled(interaction, machine).imageScale;
  for (int frame = 0; frame < 100; ++frame)
  {
    const RenderQuality quality = interaction.coarser({});
    EXPECT_NEAR(quality.imageScale, scale, 0.051);
    interaction.frameTook(machine.frame(quality) * (frame % 2 ? 1.02 : 0.98), quality);
  }
}

TEST(InteractionQuality, RefusesARateOutOfItsRange)
{
  for (const double hz : {0.0, 0.5, 241.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(InteractionQuality{hz}, core::InvalidParameter);
  EXPECT_EQ(InteractionQuality(60.0).wantedRate(), 60.0);
}

namespace
{

double frameOf(const Machine& machine, const InteractionQuality::Foveated& frame)
{
  return machine.frame(frame.rest) + frame.area * (machine.frame(frame.fovea) - machine.constant);
}

} // namespace

TEST(InteractionQuality, KeepsSixTenthsAroundABurrAndTheRate)
{
  for (const double whole : {60.0, 200.0, 600.0, 1500.0}) // ms for the whole picture
    for (const double area : {0.005, 0.02, 0.05})
    {
      InteractionQuality interaction;
      const Machine machine{1.0, 0.5 * whole, 0.25 * whole};
      const RenderQuality plain = settled(interaction, machine);
      std::optional<InteractionQuality::Foveated> frame;
      for (int n = 0; n < 30; ++n)
      {
        frame = interaction.foveated({}, area);
        ASSERT_TRUE(frame) << whole;
        interaction.frameTook(frameOf(machine, *frame), InteractionQuality::workOf(*frame));
      }
      EXPECT_GE(frame->fovea.imageScale, 0.6);
      EXPECT_GT(frame->fovea.imageScale, frame->rest.imageScale);
      EXPECT_LE(frame->rest.imageScale, plain.imageScale + 0.051);
      EXPECT_LE(frame->area, area);
      EXPECT_GE(frame->area, 0.25 * area);
      EXPECT_EQ(frame->fovea.step, RenderQuality().step);
      EXPECT_NO_THROW(frame->rest.validate());
      EXPECT_NO_THROW(frame->fovea.validate());
      // Where the least of both is dearer than a frame may be, it is the least.
      const double least =
          machine.constant +
          whole * (std::pow(InteractionQuality::kSmallestScale, 2) + 0.25 * area * 0.36);
      EXPECT_LE(frameOf(machine, *frame), std::max(1000.0 / 30.0, 1.4 * least))
          << whole << " " << area;
    }
}

TEST(InteractionQuality, NeedsNoFinerPartWhereAllIsFine)
{
  InteractionQuality interaction;
  EXPECT_FALSE(interaction.foveated({}, 0.02)) << "nothing is known yet";
  settled(interaction, {0.2, 2.0, 2.0});
  EXPECT_FALSE(interaction.foveated({}, 0.02));
  InteractionQuality slow;
  settled(slow, {1.0, 300.0, 300.0});
  for (const double area : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(slow.foveated({}, area));
}
