#include "petrous/Registration/Fit.h"

#include <limits>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "TestBodies.h"
#include "petrous/Core/Error.h"
#include "petrous/Registration/LiveMetric.h"

namespace petrous::registration
{
namespace
{

using namespace testing;
using Image = std::shared_ptr<const volume::IntensityVolume>;

const Vector3d kEar(24, 22, -13);

struct Pair
{
  core::RigidTransform truth;
  Image ct, mr;

  double errorAt(const Vector3d& p, const core::RigidTransform& found) const
  {
    return (found * p - truth * p).norm();
  }
  /// Maximum error at the corners of a box of 100 mm.
  double worst(const core::RigidTransform& found) const
  {
    double most = 0.0;
    for (int c = 0; c < 8; ++c)
      most = std::max(
          most, errorAt({c & 1 ? 50.0 : -50.0, c & 2 ? 50.0 : -50.0, c & 4 ? 50.0 : -50.0}, found));
    return most;
  }
};

struct Scan
{
  Vector3d centre{0, 0, 0};
  Vector3d extent{130, 150, 116};
  Vector3d spacing{1.5, 1.5, 2.0};
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

Pair pairOf(const core::RigidTransform& truth, const Scan& ctScan = {}, const Scan& mrScan = {},
            bool t2 = false)
{
  const Head head;
  Pair pair{truth, nullptr, nullptr};
  pair.ct = imageOf<std::int16_t>(
      gridAbout(ctScan.centre, ctScan.extent, ctScan.spacing, ctScan.axes),
      [&](const Vector3d& p) { return head.ct(p); }, 20.0, 1);
  const core::RigidTransform back = truth.inverse();
  pair.mr = imageOf<std::int16_t>(
      gridAbout(truth * mrScan.centre, mrScan.extent, mrScan.spacing, mrScan.axes),
      [&](const Vector3d& p) { return t2 ? head.t2(back * p) : head.t1(back * p); }, 20.0, 2);
  return pair;
}

TEST(Fit, FindsAKnownMotionToAFifthOfAVoxel)
{
  const Pair pair = pairOf(motion({0, 0, 0}, 7.0, 6.0));
  const Fit fit = fitRigid(*pair.ct, *pair.mr);
  EXPECT_LT(pair.errorAt(kEar, fit.mrFromCt), 0.2 * 1.5);
  EXPECT_LT(pair.worst(fit.mrFromCt), 0.4 * 1.5);
  EXPECT_GT(fit.overlap, 0.9);
  EXPECT_GT(fit.iterations, 5);
}

TEST(Fit, DoesNotMindInvertedContrast)
{
  const Pair pair = pairOf(motion({0, 0, 0}, 7.0, 6.0), {}, {}, true);
  EXPECT_LT(pair.errorAt(kEar, fitRigid(*pair.ct, *pair.mr).mrFromCt), 0.2 * 1.5);
}

TEST(Fit, SurvivesFortyMillimetresAndFortyDegrees)
{
  int n = 0;
  for (const Vector3d& axis : {Vector3d(1, 0.2, 0), Vector3d(-0.3, 1, 0.4), Vector3d(0.1, 0.5, -1)})
  {
    const Pair pair = pairOf(motion({0, 0, 0}, 40.0, 40.0, axis));
    FitOptions options;
    options.start = n++ % 2 ? Start::Centres : Start::Header;
    EXPECT_LT(pair.worst(fitRigid(*pair.ct, *pair.mr, options).mrFromCt), 1.0) << axis.transpose();
  }
}

TEST(Fit, TakesASlabThickTiltedSlicesAndAMirroredGrid)
{
  Scan slab;
  slab.centre = kEar;
  slab.extent = {70, 80, 50};
  slab.spacing = {0.8, 0.8, 0.8};
  Scan thick;
  thick.spacing = {1.0, 1.0, 4.0};
  thick.axes = Eigen::AngleAxisd(0.3, Vector3d::UnitX()).toRotationMatrix();
  thick.axes.col(0) *= -1.0; // left-handed: reversed voxel order, same patient
  const Pair pair = pairOf(motion(kEar, 9.0, 8.0), slab, thick);
  EXPECT_LT(pair.errorAt(kEar, fitRigid(*pair.ct, *pair.mr).mrFromCt), 0.2 * 4.0);
}

TEST(Fit, LooksAtARegionAlone)
{
  // The lower half of the head moved separately: two motions in one MR, one of them requested.
  const Head head;
  const core::RigidTransform upper = motion({0, 0, 0}, 4.0, 3.0);
  const core::RigidTransform lower = motion({0, 0, 0}, -4.0, -3.0);
  Pair pair = pairOf(upper);
  pair.mr =
      imageOf<float>(gridAbout({0, 0, 0}, {140, 160, 130}, {1.5, 1.5, 2.0}), [&](const Vector3d& p)
                     { return head.t1((p[2] > 5.0 ? upper : lower).inverse() * p); });
  FitOptions options;
  options.region = core::PatientBox{Vector3d(-65, -75, 14), Vector3d(65, 75, 56)};
  const Fit fit = fitRigid(*pair.ct, *pair.mr, options);
  EXPECT_LT((fit.mrFromCt * Vector3d(0, 0, 30) - upper * Vector3d(0, 0, 30)).norm(), 0.6);
}

TEST(Fit, IsTheSameToTheBitForASeedWhateverTheThreads)
{
  const Pair pair = pairOf(motion({0, 0, 0}, 20.0, 15.0));
  const Fit first = fitRigid(*pair.ct, *pair.mr);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Fit second = fitRigid(*pair.ct, *pair.mr);
  EXPECT_EQ(first.mrFromCt.matrix(), second.mrFromCt.matrix());
  EXPECT_EQ(first.metric, second.metric);
  EXPECT_EQ(first.iterations, second.iterations);
}

TEST(Fit, StartsFromWhatIsGiven)
{
  const core::RigidTransform truth = motion({0, 0, 0}, 90.0, 120.0);
  const Pair pair = pairOf(truth);
  FitOptions options;
  options.start = Start::Given;
  options.given = truth * motion({0, 0, 0}, 3.0, 3.0);
  options.search = false;
  EXPECT_LT(pair.worst(fitRigid(*pair.ct, *pair.mr, options).mrFromCt), 0.6);
}

TEST(Fit, TellsItsWayAndStopsWithTheLastGoodState)
{
  const Pair pair = pairOf(motion({0, 0, 0}, 7.0, 6.0));
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress({}, token);
  int told = 0;
  core::RigidTransform last;
  FitOptions options;
  EXPECT_THROW(fitRigid(*pair.ct, *pair.mr, options, progress,
                        [&](const MetricSample& sample, const core::RigidTransform& best)
                        {
                          EXPECT_EQ(sample.evaluation, ++told);
                          last = best;
                          if (told == 12)
                            token->cancel();
                        }),
               core::CancelledError);
  EXPECT_EQ(told, 12);
  EXPECT_LT(pair.worst(last), 8.0); // coarsest level; better than the header's 10
}

TEST(Fit, SaysWhyItCannot)
{
  const Pair pair = pairOf({});
  const auto& grid = pair.mr->geometry();
  const auto refusal = [&](const Image& ct, const Image& mr, const FitOptions& options = {})
  {
    try
    {
      fitRigid(*ct, *mr, options);
      return std::string("none");
    }
    catch (const core::InvalidParameter& error)
    {
      return std::string(error.what());
    }
  };
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  const auto flat = imageOf(grid, [](const Vector3d&) { return 42.0; });
  const auto nothing = imageOf(grid, [&](const Vector3d&) { return nan; });
  const auto slice = imageOf(gridAbout({0, 0, 0}, {100, 100, 3}, {1, 1, 3}),
                             [](const Vector3d& p) { return p[0]; });
  EXPECT_NE(refusal(pair.ct, flat).find("MR is the same everywhere"), std::string::npos);
  EXPECT_NE(refusal(flat, pair.mr).find("CT is the same everywhere"), std::string::npos);
  EXPECT_NE(refusal(pair.ct, nothing).find("no voxels with a value"), std::string::npos);
  EXPECT_NE(refusal(pair.ct, slice).find("one slice"), std::string::npos);
  FitOptions outside;
  outside.region = core::PatientBox{Vector3d(900, 900, 900), Vector3d(950, 950, 950)};
  EXPECT_NE(refusal(pair.ct, pair.mr, outside).find("outside the CT"), std::string::npos);
}

TEST(LiveMetric, IsLargestAtTheTruth)
{
  const Pair pair = pairOf(motion({0, 0, 0}, 7.0, 6.0));
  const LiveMetric metric(*pair.ct, *pair.mr);
  const double there = metric.at(pair.truth);
  EXPECT_GT(metric.bytes(), 1000u);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      EXPECT_GT(there, metric.at(core::RigidTransform(Eigen::Quaterniond::Identity(),
                                                      sign * 2.0 * Vector3d::Unit(axis)) *
                                 pair.truth));
}

} // namespace
} // namespace petrous::registration
