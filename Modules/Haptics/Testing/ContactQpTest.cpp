#include "petrous/Haptics/ContactQp.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "QpProblems.h"
#include "petrous/Core/Error.h"

namespace petrous::haptics::testing
{

namespace
{

using Vector6 = ContactQp::Vector6;
using Status = ContactQp::Status;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector6 six(double x, double y, double z, double a = 0.0, double b = 0.0, double c = 0.0)
{
  Vector6 v;
  v << x, y, z, a, b, c;
  return v;
}

const Vector6 kCoupling = six(1.0, 1.0, 1.0, 20.0, 20.0, 20.0);

} // namespace

TEST(ContactQp, LeavesAFreeMotionAsItIs)
{
  ContactQp qp(4, kCoupling);
  const Vector6 u = six(0.5, -0.2, 0.1, 0.01, -0.02, 0.03);
  ASSERT_EQ(qp.solve(u), Status::Solved);
  EXPECT_TRUE(qp.solution().isApprox(u, 1e-15));
  ASSERT_TRUE(qp.add(six(0, 0, 1), -0.1));
  ASSERT_EQ(qp.solve(u), Status::Solved);
  EXPECT_TRUE(qp.solution().isApprox(u, 1e-15));
  EXPECT_EQ(qp.lambda(0), 0.0);
}

TEST(ContactQp, StopsAtAPlaneAndPressesWithTheCouplingsForce)
{
  ContactQp qp(1, six(2.5, 2.5, 2.5, 20, 20, 20));
  ASSERT_TRUE(qp.add(six(0, 0, 1), -0.25));
  ASSERT_EQ(qp.solve(six(0.3, 0.4, -1.0)), Status::Solved);
  EXPECT_NEAR(qp.solution()[0], 0.3, 1e-14);
  EXPECT_NEAR(qp.solution()[1], 0.4, 1e-14);
  EXPECT_NEAR(qp.solution()[2], -0.25, 1e-13);
  EXPECT_NEAR(qp.lambda(0), 2.5 * 0.75, 1e-12);
}

// A contact at a lever arm rotates the tool: both springs deflect in proportion.
TEST(ContactQp, SharesAContactBetweenTranslationAndRotation)
{
  QpProblem problem{kCoupling, six(0, 0, -1), {}, {}, {}, {}};
  problem.addContact({0, 0, 1}, {10, 0, 0}, 0.0);
  ProxyQp qp = solverOf(problem);
  ASSERT_EQ(qp.solve(problem.unconstrained), Status::Solved);
  const double lambda = 1.0 / (1.0 / 1.0 + 100.0 / 20.0);
  EXPECT_NEAR(qp.lambda(0), lambda, 1e-13);
  EXPECT_NEAR(qp.solution()[2], -1.0 + lambda, 1e-13);
  EXPECT_NEAR(qp.solution()[4], -10.0 * lambda / 20.0, 1e-13);
}

// Closed form: the motion ends where both walls hold, at the edge of the wedge.
TEST(ContactQp, ComesToRestAtTheEdgeOfAWedge)
{
  for (const double angle : {0.3, 1e-2, 1e-4})
  {
    ContactQp qp(2, kCoupling);
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    ASSERT_TRUE(qp.add(six(c, 0, s), -0.01 * s));
    ASSERT_TRUE(qp.add(six(-c, 0, s), -0.01 * s));
    ASSERT_EQ(qp.solve(six(0.2, 0.7, -1.0)), Status::Solved);
    EXPECT_NEAR(qp.solution()[0], 0.0, 1e-9);
    EXPECT_NEAR(qp.solution()[1], 0.7, 1e-9);
    // A wall is satisfied to 1e-10; the edge is accurate to 1 / s of that.
    EXPECT_NEAR(qp.solution()[2], -0.01, 1e-10 / s);
    EXPECT_NEAR(qp.lambda(0) * s + qp.lambda(1) * s, 0.99, 1e-6);
  }
}

// Motions of a tick at rest: far below the rounding of other values.
TEST(ContactQp, StopsTinyMotionsToo)
{
  for (const double way : {0.0, 1e-9, 1e-30, 1e-90, 1e-200, 1e-320})
  {
    ContactQp qp(2, kCoupling);
    ASSERT_TRUE(qp.add(six(0, 0.6, 0.8), 0.0));
    ASSERT_TRUE(qp.add(six(0, 0.6, 0.8), -1.0));
    ASSERT_EQ(qp.solve(way * six(1, 0, -1)), Status::Solved);
    EXPECT_LE((qp.solution() - way * six(1, 0.48, -0.36)).norm(), 1e-12 * way + 1e-100);
  }
}

TEST(ContactQp, SlidesBetweenParallelWalls)
{
  ContactQp qp(4, kCoupling);
  for (int i = 0; i < 2; ++i)
  {
    ASSERT_TRUE(qp.add(six(1, 0, 0), 0.0));
    ASSERT_TRUE(qp.add(six(-1, 0, 0), -1e-7));
  }
  ASSERT_EQ(qp.solve(six(3, 1, 2, 0.1, 0.2, 0.3)), Status::Solved);
  EXPECT_LT((qp.solution() - six(1e-7, 1, 2, 0.1, 0.2, 0.3)).norm(), 1e-12);
}

TEST(ContactQp, GivesIdenticalRowsTheThrustOfOne)
{
  QpProblem problem{kCoupling, six(0.1, 0.2, -1, 0.01, 0, 0), {}, {}, {}, {}};
  problem.addContact({0, 0.6, 0.8}, {3, 1, -2}, 0.02);
  ProxyQp one = solverOf(problem);
  ASSERT_EQ(one.solve(problem.unconstrained), Status::Solved);
  for (int i = 0; i < 40; ++i)
    problem.addContact({0, 0.6, 0.8}, {3, 1, -2}, 0.02);
  ProxyQp many = solverOf(problem);
  ASSERT_EQ(many.solve(problem.unconstrained), Status::Solved);
  double sum = 0.0;
  for (std::size_t i = 0; i < many.count(); ++i)
    sum += many.lambda(i);
  EXPECT_NEAR(sum, one.lambda(0), 1e-12);
  EXPECT_LT((many.solution() - one.solution()).norm(), 1e-12);
}

TEST(ContactQp, TakesRowsOfZerosForNothing)
{
  ProxyQp qp(4, kCoupling, true);
  ASSERT_TRUE(qp.add(Vector6::Zero(), -0.1));
  ASSERT_TRUE(qp.add(Vector6::Zero(), 0.0));
  ASSERT_TRUE(qp.add(six(0, 0, 1), 0.0));
  ASSERT_TRUE(qp.addSoft(Vector6::Zero(), 0.2, 0, std::sqrt(0.5)));
  ASSERT_EQ(qp.solve(six(1, 0, -1)), Status::Solved);
  EXPECT_LT((qp.solution() - six(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(qp.lambda(0), 0.0);
  EXPECT_EQ(qp.lambda(1), 0.0);
  EXPECT_NEAR(qp.lambda(2), 1.0, 1e-12);
  EXPECT_NEAR(qp.lambda(3), 0.2 / 0.5, 1e-14); // 0 a + s >= b
}

TEST(ContactQp, StaysWhereRowsContradictEachOther)
{
  const auto expectRefused = [](auto& qp)
  {
    EXPECT_EQ(qp.solve(six(0.3, 0, -1)), Status::Infeasible);
    EXPECT_EQ(qp.solution(), Vector6(Vector6::Zero()));
    for (std::size_t i = 0; i < qp.count(); ++i)
      EXPECT_EQ(qp.lambda(i), 0.0);
  };
  ContactQp walls(3, kCoupling);
  ASSERT_TRUE(walls.add(six(0, 0.6, 0.8), 0.002));
  ASSERT_TRUE(walls.add(six(0, -0.6, -0.8), 0.001));
  ASSERT_TRUE(walls.add(six(1, 0, 0), 0.0));
  expectRefused(walls);

  ContactQp zero(1, kCoupling);
  ASSERT_TRUE(zero.add(Vector6::Zero(), 0.01));
  expectRefused(zero);

  // Three walls around a ball too large for them, and soft tissue as well.
  ProxyQp ring(4, kCoupling, true);
  for (int i = 0; i < 3; ++i)
    ASSERT_TRUE(ring.add(six(std::cos(2.1 * i), std::sin(2.1 * i), 0), 0.01));
  ASSERT_TRUE(ring.addSoft(six(0, 0, 1), 0.01, 0, 1.0));
  expectRefused(ring);
}

TEST(ContactQp, RecoversAfterAContradiction)
{
  ContactQp qp(2, kCoupling);
  qp.add(six(0, 0, 1), 0.1);
  qp.add(six(0, 0, -1), 0.1);
  ASSERT_EQ(qp.solve(six(0, 0, -1)), Status::Infeasible);
  qp.clear();
  ASSERT_EQ(qp.count(), 0u);
  qp.add(six(0, 0, 1), -0.5);
  ASSERT_EQ(qp.solve(six(0, 0, -1)), Status::Solved);
  EXPECT_NEAR(qp.solution()[2], -0.5, 1e-12);
}

TEST(ContactQp, RefusesRowsThatAreNoNumbers)
{
  ContactQp qp(8, kCoupling);
  EXPECT_FALSE(qp.add(six(0, kNaN, 1), 0.0));
  EXPECT_FALSE(qp.add(six(0, 0, 1, kInfinity), 0.0));
  EXPECT_FALSE(qp.add(six(0, 0, 1), kNaN));
  EXPECT_FALSE(qp.add(six(0, 0, 1), -kInfinity));
  EXPECT_FALSE(qp.add(six(0, 0, 1e200), 0.0));
  EXPECT_EQ(qp.count(), 0u);
  ASSERT_TRUE(qp.add(six(0, 0, 1), 0.0));
  ASSERT_EQ(qp.solve(six(0, 0, -1)), Status::Solved);
  EXPECT_NEAR(qp.lambda(0), 1.0, 1e-12);
}

TEST(ContactQp, RefusesRowsBeyondItsCapacity)
{
  ContactQp qp(2, kCoupling);
  EXPECT_TRUE(qp.add(six(0, 0, 1), 0.0));
  EXPECT_TRUE(qp.add(six(0, 1, 0), 0.0));
  EXPECT_FALSE(qp.add(six(1, 0, 0), 0.0));
  EXPECT_EQ(qp.count(), 2u);
}

TEST(ContactQp, StaysWhereTheMotionIsNoNumber)
{
  ContactQp qp(2, kCoupling);
  qp.add(six(0, 0, 1), -0.1);
  qp.add(six(0, 1, 0), 0.1);
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e300})
  {
    EXPECT_EQ(qp.solve(six(0, 0, -1, bad)), Status::Exhausted);
    EXPECT_EQ(qp.solution(), Vector6(Vector6::Zero()));
    EXPECT_EQ(qp.lambda(0), 0.0);
    EXPECT_EQ(qp.lambda(1), 0.0);
  }
}

TEST(ContactQp, GivesTheSameBitsWhateverItSolvedBefore)
{
  QpProblemSource source(29);
  ProxyQp usedRigid(1000, kCoupling, false);
  ProxyQp usedSoft(1000, kCoupling, true);
  for (const QpFamily family : kQpFamilies)
    for (int n = 0; n < 20; ++n)
    {
      const QpProblem problem = source.make(family, source.whole(1, 200));
      ProxyQp& used = problem.isSoft() ? usedSoft : usedRigid;
      problem.fill(used);
      used.solve(problem.unconstrained);
      ProxyQp fresh = solverOf(problem);
      fresh.solve(problem.unconstrained);
      ASSERT_EQ(used.solution(), fresh.solution()) << nameOf(family) << n;
      ASSERT_EQ(used.iterations(), fresh.iterations()) << nameOf(family) << n;
      for (std::size_t i = 0; i < problem.rows.size(); ++i)
        ASSERT_EQ(used.lambda(i), fresh.lambda(i)) << nameOf(family) << n;
    }
}

TEST(ContactQp, RefusesACouplingWithoutStiffness)
{
  EXPECT_THROW(ContactQp(0, kCoupling), core::InvalidParameter);
  EXPECT_THROW(ContactQp(4, six(1, 1, 0, 20, 20, 20)), core::InvalidParameter);
  EXPECT_THROW(ContactQp(4, six(1, 1, -1, 20, 20, 20)), core::InvalidParameter);
  EXPECT_THROW(ContactQp(4, six(1, kNaN, 1, 20, 20, 20)), core::InvalidParameter);
}

} // namespace petrous::haptics::testing
