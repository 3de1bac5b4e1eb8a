#include "petrous/Registration/Landmarks.h"

#include <random>

#include <gtest/gtest.h>

#include "TestBodies.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/RigidSpread.h"

namespace petrous::registration
{
namespace
{

using namespace testing;

std::vector<LandmarkPair> pairsAt(const core::RigidTransform& truth)
{
  std::vector<LandmarkPair> pairs;
  for (const Vector3d& p :
       {Vector3d(0, 0, 0), Vector3d(40, 5, -3), Vector3d(-10, 30, 12), Vector3d(3, -22, 25)})
    pairs.push_back({p, truth * p});
  return pairs;
}

TEST(Landmarks, FindAnExactMotion)
{
  const core::RigidTransform truth = motion({5, 5, 5}, 80.0, 110.0);
  const LandmarkFit fit = fitLandmarks(pairsAt(truth));
  EXPECT_LT((fit.mrFromCt.matrix() - truth.matrix()).norm(), 1e-9);
  EXPECT_LT(fit.rms, 1e-9);
}

TEST(Landmarks, NeverMirror)
{
  auto pairs = pairsAt({});
  for (LandmarkPair& pair : pairs)
    pair.mr[0] = -pair.mr[0];
  EXPECT_NEAR(fitLandmarks(pairs).mrFromCt.rotation().toRotationMatrix().determinant(), 1.0, 1e-9);
}

// Fitzpatrick, West and Maurer (1998): with an error of s along each axis of N landmarks, a target
// lies off by TRE^2 = 3 s^2 / N (1 + 1/3 sum over the principal axes of d^2 / f^2), root mean
// square; d is the target's distance from an axis, f the landmarks' root mean square one.
TEST(Landmarks, SpreadAsFitzpatricksFormulaSays)
{
  constexpr double kError = 0.3; // mm
  const Vector3d center(10.0, -20.0, 5.0);
  const Vector3d reach(40.0, 25.0, 15.0);
  const core::RigidTransform truth = motion(center, 12.0, 40.0);
  std::vector<Vector3d> points;
  for (Eigen::Index a = 0; a < 3; ++a)
    for (const double sign : {-1.0, 1.0})
      points.push_back(center + sign * reach[a] * Vector3d::Unit(a));
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, kError);
  std::vector<core::RigidTransform> repeats;
  for (int n = 0; n < 20'000; ++n)
  {
    std::vector<LandmarkPair> pairs;
    for (const Vector3d& p : points)
      pairs.push_back({p, truth * p + Vector3d(normal(random), normal(random), normal(random))});
    repeats.push_back(fitLandmarks(pairs).mrFromCt);
  }
  const core::RigidSpread spread = core::spreadOf(truth, repeats, {0.0, 0.0, 0.0});
  const Vector3d squares = 2.0 * reach.cwiseAbs2() / 6.0; // mean along each axis
  for (const Vector3d& target :
       {center, Vector3d(24.0, 22.0, -13.0), Vector3d(-90.0, -20.0, 5.0), Vector3d(10, 40, 90)})
  {
    double sum = 0.0;
    for (Eigen::Index a = 0; a < 3; ++a)
    {
      Vector3d off = target - center;
      off[a] = 0.0;
      sum += off.squaredNorm() / (squares.sum() - squares[a]);
    }
    const double square = 3.0 * kError * kError / 6.0 * (1.0 + sum / 3.0);
    EXPECT_NEAR(core::displacementMoments(spread, target).trace(), square, 0.05 * square)
        << target.transpose();
  }
}

// No small motion about the fit reduces the sum of squares.
TEST(Landmarks, HaveTheLeastSquares)
{
  auto pairs = pairsAt(motion({0, 0, 0}, 10.0, 20.0));
  pairs[1].mr += Vector3d(2.0, 0.5, -1.0);
  pairs[3].mr += Vector3d(-1.0, 1.5, 0.0);
  const LandmarkFit fit = fitLandmarks(pairs);
  const auto rms = [&](const core::RigidTransform& pose)
  {
    double sum = 0.0;
    for (const LandmarkPair& pair : pairs)
      sum += (pose * pair.ct - pair.mr).squaredNorm();
    return std::sqrt(sum / static_cast<double>(pairs.size()));
  };
  EXPECT_NEAR(rms(fit.mrFromCt), fit.rms, 1e-12);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
    {
      const core::RigidTransform shifted(Eigen::Quaterniond::Identity(),
                                         sign * 0.05 * Vector3d::Unit(axis));
      const core::RigidTransform turned(
          Eigen::Quaterniond(Eigen::AngleAxisd(sign * 0.002, Vector3d::Unit(axis))),
          Vector3d::Zero());
      EXPECT_GT(rms(shifted * fit.mrFromCt), fit.rms);
      EXPECT_GT(rms(turned * fit.mrFromCt), fit.rms);
    }
  ASSERT_EQ(fit.residuals.size(), 4u);
  EXPECT_GT(fit.residuals[1], fit.residuals[2]);
}

TEST(Landmarks, RefuseWhatLeavesTheFitOpen)
{
  auto pairs = pairsAt({});
  pairs.resize(2);
  EXPECT_THROW(fitLandmarks(pairs), core::InvalidParameter);
  std::vector<LandmarkPair> line;
  for (const double x : {0.0, 10.0, 25.0, 40.0})
    line.push_back({{x, 2.0 * x, 0.3}, {x, 0.0, 0.0}});
  EXPECT_THROW(fitLandmarks(line), core::InvalidParameter);
  auto broken = pairsAt({});
  broken[2].mr[1] = std::nan("");
  try
  {
    fitLandmarks(broken);
    FAIL();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("pair 3"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace petrous::registration
