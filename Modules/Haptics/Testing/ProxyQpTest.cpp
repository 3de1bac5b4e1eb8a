#include "petrous/Haptics/ProxyQp.h"

#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::haptics;

namespace
{

using Vector6 = ProxyQp::Vector6;

Vector6 six(double a, double b, double c, double d, double e, double f)
{
  Vector6 result;
  result << a, b, c, d, e, f;
  return result;
}

const Vector6 kCoupling = six(2, 2, 2, 20, 20, 20);

struct SoftRow
{
  Vector6 row;
  double depth;
  std::size_t spring;
};

} // namespace

TEST(ProxyQp, IsContactQpWithoutSprings)
{
  ProxyQp one(4, kCoupling, false);
  ProxyQp both(4, kCoupling, true);
  ContactQp plain(4, kCoupling);
  EXPECT_FALSE(one.addSoft(six(0, 0, 1, 0, 0, 0), 0.1, 0, 1.0));
  for (int n = 0; n < 3; ++n)
  {
    const Vector6 row = six(0.1 * n, 0.2, 1.0, 0.5 * n, -1.0, 0.3);
    plain.add(row, -0.1 * n);
    EXPECT_TRUE(one.add(row, -0.1 * n));
    EXPECT_TRUE(both.add(row, -0.1 * n));
  }
  const Vector6 wanted = six(0.3, -0.2, -2.0, 0.1, 0.05, 0.0);
  EXPECT_EQ(plain.solve(wanted), ContactQp::Status::Solved);
  EXPECT_EQ(one.solve(wanted), ContactQp::Status::Solved);
  EXPECT_EQ(both.solve(wanted), ContactQp::Status::Solved);
  EXPECT_EQ(one.solution(), plain.solution());
  EXPECT_LT((both.solution() - plain.solution()).norm(), 1e-12);
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_NEAR(both.lambda(n), plain.lambda(n), 1e-9);
}

// One spring k against the coupling K, compressed by D: F = K k / (K + k) D, for any number of
// rows.
TEST(ProxyQp, CountsASpringOnceHoweverManyRowsItHas)
{
  const double k = 0.5;
  for (const int rows : {1, 2, 7, 200})
  {
    SCOPED_TRACE(rows);
    ProxyQp qp(256, kCoupling, true);
    for (int n = 0; n < rows; ++n)
      ASSERT_TRUE(qp.addSoft(six(0, 0, 1, 0, 0, 0), 0.0, 2, 1.0 / std::sqrt(k)));
    ASSERT_EQ(qp.solve(six(0, 0, -1.5, 0, 0, 0)), ContactQp::Status::Solved);
    double sum = 0.0;
    for (int n = 0; n < rows; ++n)
      sum += qp.lambda(static_cast<std::size_t>(n));
    EXPECT_NEAR(sum, 2.0 * k / (2.0 + k) * 1.5, 1e-9);
    EXPECT_NEAR(qp.solution()[2], -sum / k, 1e-9);
  }
}

// The solution minimises the stated objective: no nearby motion does better.
TEST(ProxyQp, FindsTheLeastEnergyOfCouplingAndSprings)
{
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const auto vector = [&](double turn)
  {
    Vector6 result;
    for (int n = 0; n < 6; ++n)
      result[n] = normal(random) * (n < 3 ? 1.0 : turn);
    return result;
  };
  const std::array<double, 3> stiffness{0.2, 1.0, 6.0};
  for (int problem = 0; problem < 400; ++problem)
  {
    ProxyQp qp(64, kCoupling, true);
    std::vector<SoftRow> soft;
    const int rigid = problem % 4;
    std::vector<SoftRow> walls;
    for (int n = 0; n < rigid; ++n)
    {
      walls.push_back({vector(3.0), -std::abs(normal(random)), 0});
      ASSERT_TRUE(qp.add(walls.back().row, walls.back().depth));
    }
    for (int n = 0; n < 12; ++n)
    {
      soft.push_back({vector(3.0), normal(random), static_cast<std::size_t>(n % 3)});
      ASSERT_TRUE(qp.addSoft(soft.back().row, soft.back().depth, soft.back().spring,
                             1.0 / std::sqrt(stiffness[soft.back().spring])));
    }
    const Vector6 wanted = vector(0.3);
    ASSERT_EQ(qp.solve(wanted), ContactQp::Status::Solved);
    const auto energy = [&](const Vector6& a)
    {
      std::array<double, 3> pressed{};
      for (const SoftRow& row : soft)
        pressed[row.spring] = std::max(pressed[row.spring], row.depth - row.row.dot(a));
      double sum = 0.5 * (a - wanted).dot(kCoupling.cwiseProduct(a - wanted));
      for (std::size_t n = 0; n < 3; ++n)
        sum += 0.5 * stiffness[n] * pressed[n] * pressed[n];
      return sum;
    };
    const Vector6 found = qp.solution();
    const double least = energy(found);
    const auto allowed = [&](const Vector6& a)
    {
      return std::all_of(walls.begin(), walls.end(),
                         [&](const SoftRow& wall) { return wall.row.dot(a) >= wall.depth - 1e-9; });
    };
    ASSERT_TRUE(allowed(found));
    for (int n = 0; n < 200; ++n)
    {
      const Vector6 other = found + std::pow(10.0, -n % 5) * vector(0.3);
      if (allowed(other))
      {
        ASSERT_GE(energy(other), least - 1e-9);
      }
    }
    // The rows' forces equal the springs' and balance the coupling.
    Vector6 sum = -kCoupling.cwiseProduct(found - wanted);
    for (std::size_t n = 0; n < walls.size(); ++n)
      sum += qp.lambda(n) * walls[n].row;
    std::array<double, 3> force{};
    std::array<double, 3> pressed{};
    for (std::size_t n = 0; n < soft.size(); ++n)
    {
      sum += qp.lambda(walls.size() + n) * soft[n].row;
      force[soft[n].spring] += qp.lambda(walls.size() + n);
      pressed[soft[n].spring] =
          std::max(pressed[soft[n].spring], soft[n].depth - soft[n].row.dot(found));
    }
    ASSERT_LT(sum.norm(), 1e-8);
    for (std::size_t n = 0; n < 3; ++n)
      ASSERT_NEAR(force[n], stiffness[n] * pressed[n], 1e-7);
  }
}

TEST(ProxyQp, TakesNoMoreSpringsThanItHas)
{
  ProxyQp qp(8, kCoupling, true);
  EXPECT_TRUE(qp.addSoft(six(0, 0, 1, 0, 0, 0), 0.1, kMaxSprings - 1, 1.0));
  EXPECT_FALSE(qp.addSoft(six(0, 0, 1, 0, 0, 0), 0.1, kMaxSprings, 1.0));
  EXPECT_THROW(ProxyQp(0, kCoupling, true), core::InvalidParameter);
}
