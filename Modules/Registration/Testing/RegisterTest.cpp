#include "petrous/Registration/Register.h"

#include <algorithm>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "ErrorModel.h"
#include "QualityFeatures.h"
#include "TestBodies.h"
#include "petrous/Core/Error.h"

namespace petrous::registration
{
namespace
{

using namespace testing;

const Vector3d kEar(24, 22, -13);
const core::GridGeometry kGrid = gridAbout({0, 0, 0}, {130, 150, 116}, {1.5, 1.5, 2.0});

std::shared_ptr<const volume::IntensityVolume> headCt()
{
  return imageOf<std::int16_t>(
      kGrid, [head = Head()](const Vector3d& p) { return head.ct(p); }, 20.0, 1);
}

std::shared_ptr<const volume::IntensityVolume> headMr(const core::RigidTransform& truth)
{
  const core::RigidTransform back = truth.inverse();
  return imageOf<std::int16_t>(
      kGrid, [&, head = Head()](const Vector3d& p) { return head.t1(back * p); }, 20.0, 2);
}

TEST(Register, StatesAnErrorThatCoversTheTruth)
{
  const core::RigidTransform truth = motion({0, 0, 0}, 7.0, 6.0);
  const Registration result = registerRigid(*headCt(), *headMr(truth), {}, kEar);
  EXPECT_EQ(result.verdict, Verdict::Good) << result.text;
  const double error = (result.fit.mrFromCt * kEar - truth * kEar).norm();
  EXPECT_LE(error, result.error.max);
  EXPECT_LT(result.error.median, result.error.p95);
  EXPECT_LE(result.error.p95, result.error.max);
  EXPECT_LT(result.error.p95, 1.0);
  EXPECT_EQ(result.error.point, kEar);
  ASSERT_TRUE(result.error.spread);
  const auto p95At = [&result](const Vector3d& point)
  {
    return core::lengthQuantile(core::displacementMoments(*result.error.spread, point),
                                core::kNormal95);
  };
  EXPECT_NEAR(p95At(kEar), result.error.p95, 1e-9);
  EXPECT_GT(p95At(kEar + Vector3d(0, 0, -300)), 1.5 * result.error.p95);
}

TEST(Register, ErrorGrowsAwayFromWhatIsSeen)
{
  const core::RigidTransform truth = motion({0, 0, 0}, 3.0, 2.0);
  const auto ct = headCt();
  const auto mr = headMr(truth);
  const Registration here = registerRigid(*ct, *mr, {}, kEar);
  const Registration far = registerRigid(*ct, *mr, {}, {24, 22, -313});
  EXPECT_GT(far.error.p95, 1.5 * here.error.p95);
  EXPECT_EQ(far.verdict, Verdict::Doubtful);
  EXPECT_NE(far.text.find("outside"), std::string::npos) << far.text;
}

// Everything within 16 mm of the ear is displaced, with a transition of 2 mm, in noise.
TEST(Register, ReachesAnEarThatLiesElsewhereThanTheHead)
{
  const core::RigidTransform truth = motion({0, 0, 0}, 3.0, 2.0);
  const core::RigidTransform back = truth.inverse();
  for (const Vector3d& shift : {Vector3d(-2.4, 0.9, 1.0), Vector3d(2.0, 3.5, -3.5)})
  {
    const auto mr = imageOf<std::int16_t>(
        kGrid,
        [&, head = Head()](const Vector3d& p)
        {
          const Vector3d q = back * p;
          const double inside = std::clamp((16.0 - (q - kEar).norm()) / 2.0 + 0.5, 0.0, 1.0);
          return head.t1(q - inside * shift);
        },
        20.0, 2);
    const Registration result = registerRigid(*headCt(), *mr, {}, kEar);
    const double error = (result.fit.mrFromCt * kEar - truth * (kEar + shift)).norm();
    EXPECT_EQ(result.verdict, Verdict::Doubtful) << result.text;
    EXPECT_GT(error, 0.7 * shift.norm());
    EXPECT_LE(error, result.error.p95);
    EXPECT_LT(result.error.p95, error + 1.5);
    EXPECT_NE(result.text.find("beside the rest"), std::string::npos) << result.text;
    EXPECT_FALSE(result.error.spread) << "it does not describe the ear";
  }
}

// Rotated by 180 degrees it is beyond the search range, and what is found instead is far off.
TEST(Register, WhatEndsFarOffByChanceHasFailed)
{
  const core::RigidTransform truth = motion({0, 0, 0}, 3.0, 175.0, {1, 0, 0});
  const Registration result = registerRigid(*headCt(), *headMr(truth), {}, kEar);
  const double moved = (result.fit.mrFromCt * kEar - kEar).norm();
  const double error = (result.fit.mrFromCt * kEar - truth * kEar).norm();
  EXPECT_TRUE(error < 1.0 || moved < 51.0 || result.verdict == Verdict::Failed)
      << error << " mm off, " << moved << " mm from its start: " << result.text;
}

TEST(Register, DoubtsAMirroredPatient)
{
  const core::RigidTransform truth = motion({0, 0, 0}, 3.0, 2.0);
  const core::RigidTransform back = truth.inverse();
  const Head head;
  const auto mr = imageOf(kGrid,
                          [&](const Vector3d& p)
                          {
                            const Vector3d q = back * p;
                            return head.t1({-q[0], q[1], q[2]});
                          });
  const Registration result = registerRigid(*headCt(), *mr, {}, kEar);
  EXPECT_NE(result.verdict, Verdict::Good);
  EXPECT_NE(result.text.find("mirrored"), std::string::npos) << result.text;
}

TEST(Register, FailsOnNoiseAndOnNothing)
{
  std::mt19937 random(5);
  const auto noise =
      imageOf(kGrid, [&](const Vector3d&) { return static_cast<double>(random() % 1000); });
  EXPECT_EQ(registerRigid(*headCt(), *noise, {}, kEar).verdict, Verdict::Failed);
  const auto flat = imageOf(kGrid, [](const Vector3d&) { return 1.0; });
  const Registration nothing = registerRigid(*headCt(), *flat, {}, kEar);
  EXPECT_EQ(nothing.verdict, Verdict::Failed);
  EXPECT_NE(nothing.text.find("same everywhere"), std::string::npos);
  EXPECT_EQ(nothing.fit.mrFromCt.matrix(), Eigen::Matrix4d::Identity().eval());
}

TEST(Register, CanBeStoppedInItsEstimate)
{
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress(
      [&](double fraction, const std::string&)
      {
        if (fraction > 0.6)
          token->cancel();
      },
      token);
  EXPECT_THROW(registerRigid(*headCt(), *headMr({}), {}, kEar, progress), core::CancelledError);
}

std::vector<core::RigidTransform> shifts(const Vector3d& deviation, int count)
{
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<core::RigidTransform> list;
  for (int n = 0; n < count; ++n)
    list.emplace_back(
        Eigen::Quaterniond::Identity(),
        deviation.cwiseProduct(Vector3d(normal(random), normal(random), normal(random))));
  return list;
}

// Percentiles of the chi distribution with 1, 2 and 3 degrees of freedom, from tables.
TEST(ErrorModel, KnowsTheNormalDistribution)
{
  struct Case
  {
    Vector3d deviation;
    double median, p95;
  };
  for (const Case& c : {Case{{1, 0, 0}, 0.6745, 1.9600}, Case{{1, 1, 0}, 1.1774, 2.4477},
                        Case{{1, 1, 1}, 1.5382, 2.7955}})
  {
    const LocalError unit = localError({}, shifts(c.deviation, 20'000), {0, 0, 0}, 1e-3, 100.0);
    EXPECT_NEAR(unit.p95 / unit.median, c.p95 / c.median, 0.03 * c.p95 / c.median);
    // scaled by the calibrated inflation, obtained from twice the deviation relative to this one
    const LocalError twice =
        localError({}, shifts(2.0 * c.deviation, 20'000), {0, 0, 0}, 1e-3, 100.0);
    EXPECT_NEAR(twice.p95, 2.0 * unit.p95, 1e-3);
    EXPECT_GE(unit.p95, c.p95);
    EXPECT_LE(unit.p95, 1.5 * c.p95);
  }
}

// The maximum is the 99.9th percentile (with three degrees of freedom 4.0331 deviations, with one
// 3.2905), or the largest repeat if greater.
TEST(ErrorModel, LargestIsRarerThanTheP95)
{
  for (const auto& [deviation, largest] :
       {std::pair{Vector3d(1, 1, 1), 4.0331 / 2.7955}, std::pair{Vector3d(1, 0, 0), 3.2905 / 1.96}})
  {
    const LocalError error = localError({}, shifts(deviation, 100), {0, 0, 0}, 1e-3, 100.0);
    EXPECT_NEAR(error.max / error.p95, largest, 0.05 * largest);
  }
  std::vector<core::RigidTransform> repeats = shifts({0.1, 0.1, 0.1}, 100);
  repeats.emplace_back(Eigen::Quaterniond::Identity(), Vector3d(2.0, 0, 0));
  EXPECT_GE(localError({}, repeats, {0, 0, 0}, 1e-3, 100.0).max, 2.0);
}

TEST(ErrorModel, CountsFromWhereThePointsSurroundingsLie)
{
  LocalError rest;
  rest.median = 0.2;
  rest.p95 = 0.4;
  rest.max = 0.6;
  const LocalError error = withDisplaced(rest, 3.0, 0.0);
  EXPECT_DOUBLE_EQ(error.median, 3.0);
  EXPECT_DOUBLE_EQ(error.p95, 3.4);
  EXPECT_DOUBLE_EQ(error.max, 3.6);
  EXPECT_GT(withDisplaced(rest, 3.0, 0.5).p95, 4.0);
}

// The error at a point is that at any other: both follow from the same repeats.
TEST(ErrorModel, HoldsAtOtherPointsBySpread)
{
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  const core::RigidTransform fit = motion({3, -2, 8}, 20.0, 30.0);
  std::vector<core::RigidTransform> repeats;
  for (int n = 0; n < 24; ++n)
  {
    const Vector3d axis = 0.004 * vector();
    const Eigen::Quaterniond by(Eigen::AngleAxisd(axis.norm(), axis.normalized()));
    repeats.push_back(fit * core::RigidTransform(by, kEar - by * kEar + 0.1 * vector()));
  }
  const LocalError here = localError(fit, repeats, kEar, 0.8, 100.0);
  ASSERT_TRUE(here.spread);
  for (const Vector3d& point : {kEar, Vector3d(-30, 22, -13), Vector3d(24, -60, 40)})
  {
    const LocalError there = localError(fit, repeats, point, 0.8, 100.0);
    const Eigen::Matrix3d moments = core::displacementMoments(*here.spread, point);
    EXPECT_NEAR(core::lengthQuantile(moments, core::kNormal95), there.p95, 0.01 * there.p95);
    EXPECT_NEAR(core::lengthQuantile(moments, core::kNormalMedian), there.median,
                0.01 * there.median);
  }
  EXPECT_FALSE(localError(fit, repeats, kEar, 0.8, 1e-6).spread) << "all ended elsewhere";
  EXPECT_FALSE(withDisplaced(here, 3.0, 0.5).spread);
}

TEST(ErrorModel, CountsAFitBesideItsRepeatsAsWrong)
{
  std::vector<core::RigidTransform> repeats(
      12, core::RigidTransform(Eigen::Quaterniond::Identity(), Vector3d(0.5, 0, 0)));
  const LocalError error = localError({}, repeats, {0, 0, 0}, 1e-3, 100.0);
  EXPECT_GT(error.p95, 0.9);
  EXPECT_EQ(strayShare({}, repeats, {0, 0, 0}, 0.4), 1.0);
  EXPECT_EQ(strayShare({}, repeats, {0, 0, 0}, 0.6), 0.0);
}

TEST(QualityVerdict, NamesEachReason)
{
  QualityFeatures fine;
  fine.overlap = 0.9;
  fine.information = 0.6;
  fine.strays = 0.0;
  fine.mirrored = 0.6;
  fine.error.p95 = 0.4;
  EXPECT_EQ(judge(fine).verdict, Verdict::Good);
  EXPECT_NE(judge(fine).text.find("0.40 mm"), std::string::npos);

  const auto expect = [&](const char* word, Verdict verdict, const auto& spoil)
  {
    QualityFeatures evidence = fine;
    spoil(evidence);
    const QualityVerdict judgement = judge(evidence);
    EXPECT_EQ(judgement.verdict, verdict) << judgement.text;
    EXPECT_NE(judgement.text.find(word), std::string::npos) << judgement.text;
  };
  expect("share too little", Verdict::Failed, [](QualityFeatures& e) { e.overlap = 0.1; });
  expect("next to nothing", Verdict::Failed, [](QualityFeatures& e) { e.information = 0.001; });
  expect("ended elsewhere", Verdict::Failed, [](QualityFeatures& e) { e.strays = 0.8; });
  expect("ended elsewhere", Verdict::Doubtful, [](QualityFeatures& e) { e.strays = 0.3; });
  expect("mirrored", Verdict::Doubtful, [](QualityFeatures& e) { e.mirrored = 1.2; });
  expect("another pose", Verdict::Doubtful, [](QualityFeatures& e) { e.runnerUp = 0.99; });
  expect("3.0 mm", Verdict::Doubtful, [](QualityFeatures& e) { e.error.p95 = 3.0; });
  expect("beside", Verdict::Doubtful, [](QualityFeatures& e) { e.aside = 4.0; });
  expect("outside", Verdict::Doubtful, [](QualityFeatures& e) { e.pointCovered = false; });
  expect("3.1 mm beside the rest", Verdict::Doubtful,
         [](QualityFeatures& e) {
           e.displaced = LocalFit{10.0, Vector3d(3.1, 0.0, 0.0), 0.1, 0.2, 0.5};
         });
  // far from the starts: accepted only without any doubt
  expect("agree", Verdict::Good, [](QualityFeatures& e) { e.moved = 118.0; });
  expect("ended 118 mm", Verdict::Failed,
         [](QualityFeatures& e)
         {
           e.moved = 118.0;
           e.runnerUp = 0.99;
         });
}

} // namespace
} // namespace petrous::registration
