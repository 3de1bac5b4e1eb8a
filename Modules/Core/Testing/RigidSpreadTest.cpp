#include "petrous/Core/RigidSpread.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

using namespace petrous::core;
using Eigen::Vector3d;
using Motion = Eigen::Matrix<double, 6, 1>;

namespace
{

constexpr int kRepeats = 40'000; // a moment is known to 0.7 %

RigidTransform turned(double angle, const Vector3d& axis, const Vector3d& shift)
{
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())), shift};
}

// Some tenths of a millimetre and some milliradians, which are correlated.
RigidSpread someSpread(unsigned seed, const Vector3d& about)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  RigidSpread::Moments root;
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index column = 0; column < 6; ++column)
      root(row, column) = (row < 3 ? 0.3 : 0.004) * uniform(random);
  return {about, root * root.transpose()};
}

// Transforms whose motions about the point have these moments.
std::vector<RigidTransform> repeatsOf(const RigidTransform& transform, const RigidSpread& spread,
                                      unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const RigidSpread::Moments root = spread.moments.llt().matrixL();
  std::vector<RigidTransform> repeats;
  for (int n = 0; n < kRepeats; ++n)
  {
    Motion unit;
    for (Eigen::Index a = 0; a < 6; ++a)
      unit[a] = normal(random);
    const Motion motion = root * unit;
    const Vector3d rotation = motion.tail<3>();
    const Eigen::Quaterniond by(Eigen::AngleAxisd(rotation.norm(), rotation.normalized()));
    repeats.push_back(transform *
                      RigidTransform(by, spread.about + motion.head<3>() - by * spread.about));
  }
  return repeats;
}

void expectAlike(const RigidSpread& found, const RigidSpread& truth)
{
  const RigidSpread there = takenAbout(found, truth.about);
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index column = 0; column < 6; ++column)
      EXPECT_NEAR(there.moments(row, column), truth.moments(row, column),
                  0.03 * std::sqrt(truth.moments(row, row) * truth.moments(column, column)))
          << row << " " << column;
}

// Over the repeats themselves, each rotated exactly.
double sampledP95(const RigidTransform& transform, const std::vector<RigidTransform>& repeats,
                  const Vector3d& point)
{
  std::vector<double> lengths;
  for (const RigidTransform& repeat : repeats)
    lengths.push_back((repeat * point - transform * point).norm());
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(0.95 * kRepeats);
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

double p95At(const RigidSpread& spread, const Vector3d& point)
{
  return lengthQuantile(displacementMoments(spread, point), kNormal95);
}

TEST(RigidSpread, GivesTheErrorOfRepeatsAtAnyPoint)
{
  const RigidTransform transform = turned(0.7, {1.0, -2.0, 0.5}, {30.0, -12.0, 55.0});
  const RigidSpread truth = someSpread(3, {24.0, 22.0, -13.0});
  const auto repeats = repeatsOf(transform, truth, 4);
  const Vector3d elsewhere(-40.0, 3.0, 8.0);
  const RigidSpread found = spreadOf(transform, repeats, elsewhere);
  EXPECT_EQ(found.about, elsewhere);
  expectAlike(found, truth);
  for (const Vector3d& point : {truth.about, Vector3d(24.0, 60.0, -13.0),
                                Vector3d(-60.0, 22.0, 20.0), Vector3d(24.0, 22.0, -160.0)})
  {
    Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
    for (const RigidTransform& repeat : repeats)
    {
      const Vector3d off = transform.inverse() * (repeat * point) - point;
      sampled += off * off.transpose() / kRepeats;
    }
    EXPECT_LT((displacementMoments(found, point) - sampled).norm(), 0.01 * sampled.norm());
    const double exact = sampledP95(transform, repeats, point);
    EXPECT_NEAR(p95At(truth, point), exact, 0.04 * exact) << point.transpose();
  }
  EXPECT_EQ(spreadOf(transform, {}, elsewhere).moments, RigidSpread::Moments::Zero().eval());
}

// A rotation vector of deviation r along each axis displaces a point at d from its centre by
// r d sqrt(2), root mean square, beside the translation's s sqrt(3).
TEST(RigidSpread, GrowsWithTheLever)
{
  constexpr double kS = 0.2, kR = 0.005;
  RigidSpread spread;
  spread.about = {10.0, -20.0, 5.0};
  spread.moments.diagonal() << kS * kS, kS * kS, kS * kS, kR * kR, kR * kR, kR * kR;
  for (const double d : {0.0, 10.0, 40.0, 120.0})
    for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(0.6, 0.0, -0.8), Vector3d(0, -1, 0)})
    {
      const Eigen::Matrix3d there = displacementMoments(spread, spread.about + d * way);
      EXPECT_NEAR(there.trace(), 3.0 * kS * kS + 2.0 * kR * kR * d * d, 1e-12);
      EXPECT_NEAR(way.dot(there * way), kS * kS, 1e-12) << "not along the lever";
    }
  EXPECT_LT(p95At(spread, spread.about), 0.5 * p95At(spread, spread.about + Vector3d(0, 90, 0)));
}

// Percentiles of the chi distribution with one, two and three degrees of freedom, from tables.
TEST(RigidSpread, KnowsTheQuantilesOfALength)
{
  const auto expect = [](const Vector3d& deviations, double median, double p95, double p999)
  {
    const Eigen::Matrix3d moments = (0.49 * deviations.cwiseAbs2()).asDiagonal();
    EXPECT_NEAR(lengthQuantile(moments, kNormalMedian), 0.7 * median, 0.02 * median);
    EXPECT_NEAR(lengthQuantile(moments, kNormal95), 0.7 * p95, 0.01 * p95);
    EXPECT_NEAR(lengthQuantile(moments, kNormal999), 0.7 * p999, 0.012 * p999);
  };
  expect({1, 0, 0}, 0.6745, 1.9600, 3.2905);
  expect({1, 1, 0}, 1.1774, 2.4477, 3.7169);
  expect({1, 1, 1}, 1.5382, 2.7955, 4.0331);
  EXPECT_EQ(lengthQuantile(Eigen::Matrix3d::Zero(), kNormal95), 0.0);
}

// Both are turned against each other and held at different points, so that neither a sum of
// numbers nor one of matrices in their own axes gives it.
TEST(RigidSpread, AddsInAChainWithTheLeverOfEach)
{
  const RigidTransform bFromA = turned(1.9, {0.3, 1.0, -0.4}, {-15.0, 80.0, 4.0});
  const RigidTransform cFromB = turned(-0.8, {1.0, 0.2, 0.9}, {3.0, -7.0, 31.0});
  const RigidSpread first = someSpread(11, {20.0, 15.0, -10.0});
  const RigidSpread second = someSpread(12, bFromA * Vector3d(-45.0, 10.0, 30.0));
  const auto ofFirst = repeatsOf(bFromA, first, 13);
  const auto ofSecond = repeatsOf(cFromB, second, 14);
  std::vector<RigidTransform> both;
  for (std::size_t n = 0; n < ofFirst.size(); ++n)
    both.push_back(ofSecond[n] * ofFirst[n]);

  const RigidSpread chain = chained(second, first, bFromA);
  EXPECT_EQ(chain.about, first.about);
  expectAlike(spreadOf(cFromB * bFromA, both, {0.0, 0.0, 0.0}), chain);
  for (const Vector3d& point : {first.about, Vector3d(-45.0, 10.0, 30.0), Vector3d(0, 0, 120)})
  {
    const double exact = sampledP95(cFromB * bFromA, both, point);
    EXPECT_NEAR(p95At(chain, point), exact, 0.04 * exact) << point.transpose();
    EXPECT_GT(p95At(chain, point), p95At(first, point));
    EXPECT_GT(p95At(chain, point), p95At(second, bFromA * point));
  }
}

TEST(RigidSpread, IsGreatestAtACornerOfABox)
{
  const RigidSpread spread = someSpread(21, {24.0, 22.0, -13.0});
  const PatientBox box(Vector3d(-10.0, 0.0, -30.0), Vector3d(40.0, 50.0, 20.0));
  const double most = largestP95(spread, box);
  double corner = 0.0;
  for (int n = 0; n < 8; ++n)
    corner = std::max(corner, p95At(spread, box.corner(static_cast<PatientBox::CornerType>(n))));
  EXPECT_EQ(most, corner);
  for (double x = 0.0; x <= 1.0; x += 0.1)
    for (double y = 0.0; y <= 1.0; y += 0.1)
      for (double z = 0.0; z <= 1.0; z += 0.1)
        EXPECT_LE(p95At(spread, box.min() + Vector3d(x, y, z).cwiseProduct(box.sizes())),
                  1.01 * most);
  const Vector3d point(3.0, 4.0, 5.0);
  EXPECT_EQ(largestP95(spread, PatientBox(point)), p95At(spread, point));
}

} // namespace
