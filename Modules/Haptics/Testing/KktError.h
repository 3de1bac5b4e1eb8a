#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "QpProblems.h"

namespace petrous::haptics::testing
{

/// Deviation of a motion and its multipliers from the Karush-Kuhn-Tucker conditions, which for this
/// convex problem characterise the solution. The springs' compressions s = c * (sum of lambda over
/// the spring's rows) are eliminated. Lengths are M^1/2 a and rows, with their component along s,
/// are scaled to unit length; all values are relative to the root of twice the objective at a = 0,
/// plus the largest positive bound.
struct KktError
{
  double primal = 0.0;          ///< largest b - J a - s
  double dual = 0.0;            ///< largest -lambda
  double stationarity = 0.0;    ///< |M (a - u) - J^T lambda|
  double complementarity = 0.0; ///< largest min(|lambda|, |J a + s - b|)

  double worst() const { return std::max({primal, dual, stationarity, complementarity}); }
};

/// `lambda(i)` is the multiplier of row i. NaN counts as an infinite error.
template <class Lambda>
KktError kktError(const QpProblem& problem, const QpProblem::Vector6& a, const Lambda& lambda)
{
  const QpProblem::Vector6 root = problem.stiffness.cwiseSqrt();
  double highest = 0.0;
  std::vector<double> lengths;
  std::array<double, kMaxSprings> compression{};
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
  {
    const double compliance = problem.complianceOf(i);
    const double length = std::sqrt(problem.rows[i].cwiseQuotient(root).squaredNorm() + compliance);
    lengths.push_back(length > 0.0 ? length : 1.0);
    highest = std::max(highest, problem.bounds[i] / lengths.back());
    if (problem.springs[i] != QpProblem::kRigid)
      compression[static_cast<std::size_t>(problem.springs[i])] += compliance * lambda(i);
  }
  const double size = highest + root.cwiseProduct(problem.unconstrained).norm();
  const double scale = size > 0.0 ? size : 1.0;

  KktError error;
  QpProblem::Vector6 residual = problem.stiffness.cwiseProduct(a - problem.unconstrained);
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
  {
    const double thrust = lambda(i);
    double reached = problem.rows[i].dot(a);
    if (problem.springs[i] != QpProblem::kRigid)
      reached += compression[static_cast<std::size_t>(problem.springs[i])];
    const double slack = (reached - problem.bounds[i]) / (lengths[i] * scale);
    const double multiplier = thrust * lengths[i] / scale;
    residual -= thrust * problem.rows[i];
    error.primal = std::max(error.primal, -slack);
    error.dual = std::max(error.dual, -multiplier);
    error.complementarity =
        std::max(error.complementarity, std::min(std::abs(slack), std::abs(multiplier)));
  }
  error.stationarity = residual.cwiseQuotient(root).norm() / scale;
  if (!std::isfinite(error.stationarity))
    error.stationarity = HUGE_VAL;
  return error;
}

inline KktError kktError(const QpProblem& problem, const ProxyQp& solved)
{
  return kktError(problem, solved.solution(), [&](std::size_t i) { return solved.lambda(i); });
}

} // namespace petrous::haptics::testing
