#include <array>
#include <optional>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "KktError.h"
#include "QpProblems.h"

namespace petrous::haptics::testing
{

namespace
{

using Vector6 = ProxyQp::Vector6;
using Status = ProxyQp::Status;

// Solution by trying every set of active rows: that set's rows hold with equality, the others as
// inequalities, and no multiplier is negative. For up to about ten rows.
std::optional<Vector6> bruteForce(const QpProblem& problem)
{
  const std::size_t count = problem.rows.size();
  const Vector6& u = problem.unconstrained;
  const auto sharedCompliance = [&](std::size_t i, std::size_t j)
  { return problem.springs[i] == problem.springs[j] ? problem.complianceOf(i) : 0.0; };
  for (unsigned set = 0; set < 1u << count; ++set)
  {
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < count; ++i)
      if (set >> i & 1u)
        active.push_back(i);
    const auto size = static_cast<Eigen::Index>(active.size());
    Eigen::MatrixXd gram(size, size);
    Eigen::VectorXd missing(size);
    for (Eigen::Index j = 0; j < size; ++j)
    {
      const Vector6 mobile = problem.rows[active[j]].cwiseQuotient(problem.stiffness);
      for (Eigen::Index k = 0; k < size; ++k)
        gram(k, j) = problem.rows[active[k]].dot(mobile) + sharedCompliance(active[k], active[j]);
      missing[j] = problem.bounds[active[j]] - problem.rows[active[j]].dot(u);
    }
    Vector6 a = u;
    std::array<double, kMaxSprings> compression{};
    Eigen::VectorXd lambda;
    if (size > 0)
    {
      const Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
      if (!lu.isInvertible())
        continue;
      lambda = lu.solve(missing);
      if (lambda.minCoeff() < -1e-12)
        continue;
      for (Eigen::Index j = 0; j < size; ++j)
      {
        const std::size_t i = active[j];
        a += lambda[j] * problem.rows[i].cwiseQuotient(problem.stiffness);
        if (problem.springs[i] != QpProblem::kRigid)
          compression[problem.springs[i]] += problem.complianceOf(i) * lambda[j];
      }
    }
    bool holds = true;
    for (std::size_t i = 0; i < count; ++i)
    {
      const int spring = problem.springs[i];
      const double reached =
          problem.rows[i].dot(a) + (spring == QpProblem::kRigid ? 0.0 : compression[spring]);
      holds = holds && (set >> i & 1u || reached >= problem.bounds[i] - 1e-10);
    }
    if (holds)
      return a;
  }
  return std::nullopt;
}

void expectAgreesWithBruteForce(QpFamily family, int problems)
{
  QpProblemSource source(17);
  int found = 0;
  for (int n = 0; n < problems; ++n)
  {
    const QpProblem problem = source.make(family, source.whole(1, 8), 3.0);
    const std::optional<Vector6> truth = bruteForce(problem);
    if (!truth)
      continue;
    ++found;
    ProxyQp qp = solverOf(problem);
    ASSERT_EQ(qp.solve(problem.unconstrained), Status::Solved) << nameOf(family) << n;
    EXPECT_LT((qp.solution() - *truth).norm(), 1e-7 * (1.0 + problem.unconstrained.norm()))
        << nameOf(family) << n;
  }
  EXPECT_GT(found, problems * 9 / 10);
}

void expectSolved(QpFamily family, int problems, int fewest, int most, double spread)
{
  QpProblemSource source(static_cast<unsigned>(family) + 101u);
  const double allowed = isNearlyDependent(family) ? 1.1e-7 : 1e-9;
  for (int n = 0; n < problems; ++n)
  {
    const QpProblem problem = source.make(family, source.whole(fewest, most), spread);
    ProxyQp qp = solverOf(problem);
    ASSERT_EQ(qp.solve(problem.unconstrained), Status::Solved) << nameOf(family) << n;
    const KktError error = kktError(problem, qp);
    EXPECT_LT(error.primal, allowed) << nameOf(family) << n;
    EXPECT_EQ(error.dual, 0.0) << nameOf(family) << n;
    EXPECT_LT(error.stationarity, isNearlyDependent(family) ? 1e-8 : 1e-9) << nameOf(family) << n;
    EXPECT_LT(error.complementarity, allowed) << nameOf(family) << n;
  }
}

} // namespace

TEST(ContactQpOptimality, AgreesWithBruteForceOverActiveSets)
{
  expectAgreesWithBruteForce(QpFamily::Random, 400);
  expectAgreesWithBruteForce(QpFamily::BurrPatch, 200);
  expectAgreesWithBruteForce(QpFamily::Hole, 200);
  expectAgreesWithBruteForce(QpFamily::Lattice, 200);
  expectAgreesWithBruteForce(QpFamily::Violated, 200);
}

TEST(ContactQpOptimality, AgreesWithBruteForceWithSoftStructures)
{
  expectAgreesWithBruteForce(QpFamily::Soft, 400);
  expectAgreesWithBruteForce(QpFamily::SoftPatch, 200);
}

TEST(ContactQpOptimality, FulfilsTheKktConditionsInEveryFamily)
{
  for (const QpFamily family : kQpFamilies)
    expectSolved(family, 2000, 1, 60, 1.0);
}

TEST(ContactQpOptimality, FulfilsTheKktConditionsWithManyRows)
{
  for (const QpFamily family : kQpFamilies)
    expectSolved(family, 40, 200, 1000, 1.0);
}

TEST(ContactQpOptimality, FulfilsTheKktConditionsWithStiffnessesAThousandApart)
{
  for (const QpFamily family : kQpFamilies)
    expectSolved(family, 500, 1, 60, 30.0);
}

// From the stiffest structure that HapticField accepts to a hundred times that.
TEST(ContactQpOptimality, FulfilsTheKktConditionsWithHardSprings)
{
  QpProblemSource source(41);
  for (int n = 0; n < 2000; ++n)
  {
    QpProblem problem =
        source.make(n % 2 == 0 ? QpFamily::Soft : QpFamily::SoftPatch, source.whole(1, 60));
    for (double& compliance : problem.compliances)
      compliance = source.power(-4.0, -2.0);
    ProxyQp qp = solverOf(problem);
    ASSERT_EQ(qp.solve(problem.unconstrained), Status::Solved) << n;
    EXPECT_LT(kktError(problem, qp).worst(), 1e-9) << n;
  }
}

TEST(ContactQpOptimality, HoldsABallInAHoleOfFourHundredRows)
{
  expectSolved(QpFamily::Hole, 100, 400, 400, 1.0);
}

// The wrench on the hand is the contacts' own, to rounding.
TEST(ContactQpOptimality, GivesAWrenchThatIsTheSumOfItsThrusts)
{
  for (const QpFamily family : {QpFamily::Random, QpFamily::BurrPatch, QpFamily::Hole,
                                QpFamily::Duplicates, QpFamily::Soft, QpFamily::SoftPatch})
  {
    QpProblemSource source(5);
    for (int n = 0; n < 500; ++n)
    {
      const QpProblem problem = source.make(family, source.whole(1, 60));
      ProxyQp qp = solverOf(problem);
      ASSERT_EQ(qp.solve(problem.unconstrained), Status::Solved);
      Vector6 sum = problem.stiffness.cwiseProduct(problem.unconstrained - qp.solution());
      double parts = problem.stiffness.cwiseProduct(problem.unconstrained).norm();
      for (std::size_t i = 0; i < problem.rows.size(); ++i)
      {
        sum += qp.lambda(i) * problem.rows[i];
        parts += qp.lambda(i) * problem.rows[i].norm();
      }
      EXPECT_LT(sum.norm(), 1e-12 * parts) << nameOf(family) << n;
    }
  }
}

} // namespace petrous::haptics::testing
