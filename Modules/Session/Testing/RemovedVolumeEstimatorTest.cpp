#include "petrous/Session/RemovedVolumeEstimator.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "../../Core/Testing/Eventually.h"

using namespace petrous;
using namespace petrous::session;
using core::testing::eventually;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kGrid({32, 32, 32}, Vector3d::Constant(0.5), Vector3d::Zero());

// One mm^3 per changed brick.
dissection::RemovedVolume bricksOf(const dissection::Dissection& work)
{
  return {static_cast<double>(work.openBricks().size()), {}};
}

bool becomes(RemovedVolumeEstimator& meter, const dissection::Dissection& work, double wanted)
{
  return eventually([&] { return meter.soFar(work, bricksOf).total == wanted; });
}

} // namespace

TEST(RemovedVolumeEstimator, FollowsTheOpenStrokeAndForgetsItWhenItIsClosed)
{
  RemovedVolumeEstimator meter;
  dissection::Dissection work(kGrid);
  EXPECT_EQ(meter.soFar(work, bricksOf).total, 0.0);
  work.beginStroke({});
  work.cut({{2.0, 2.0, 2.0}, {2.0, 2.0, 2.0}, 1.0});
  EXPECT_TRUE(becomes(meter, work, 1.0));
  work.cut({{13.0, 2.0, 2.0}, {13.0, 2.0, 2.0}, 1.0});
  EXPECT_TRUE(becomes(meter, work, 2.0));
  work.endStroke();
  EXPECT_EQ(meter.soFar(work, bricksOf).total, 0.0);
  // A measurement still running does not count for the next stroke.
  work.beginStroke({});
  EXPECT_EQ(meter.soFar(work, bricksOf).total, 0.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  EXPECT_EQ(meter.soFar(work, bricksOf).total, 0.0);
}

TEST(RemovedVolumeEstimator, NeitherWaitsNorMeasuresWithoutAStroke)
{
  RemovedVolumeEstimator meter;
  std::atomic<int> asked{0};
  std::promise<void> go;
  const auto gone = go.get_future().share();
  const RemovedVolumeEstimator::Measure slow = [&asked, gone](const dissection::Dissection&)
  {
    ++asked;
    gone.wait();
    return dissection::RemovedVolume{7.0, {}};
  };
  dissection::Dissection work(kGrid);
  for (int n = 0; n < 10; ++n)
    meter.soFar(work, slow);
  EXPECT_EQ(asked, 0);
  work.beginStroke({});
  for (int n = 0; n < 10; ++n)
    EXPECT_EQ(meter.soFar(work, slow).total, 0.0); // returns although nothing is measured yet
  go.set_value();
  EXPECT_TRUE(eventually([&] { return meter.soFar(work, slow).total == 7.0; }));
}
