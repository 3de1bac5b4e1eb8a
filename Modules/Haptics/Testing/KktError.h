#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "QpProblems.h"

namespace petrous::haptics::testing
{

/// Deviation of a motion and its multipliers from the Karush-Kuhn-Tucker conditions, which for this
/// convex problem characterise the solution. Lengths are M^1/2 a and rows are scaled to unit
/// length; all values are relative to the root of twice the objective at a = 0, plus the largest
/// positive bound.
struct KktError
{
  double primal = 0.0;          ///< largest b - J a - c lambda
  double dual = 0.0;            ///< largest -lambda
  double stationarity = 0.0;    ///< |M (a - u) - J^T lambda|
  double complementarity = 0.0; ///< largest min(|lambda|, |J a + c lambda - b|)

  double worst() const { return std::max({primal, dual, stationarity, complementarity}); }
};

/// `lambda(i)` is the multiplier of row i. NaN counts as an infinite error.
template <class Lambda>
KktError kktError(const QpProblem& problem, const QpProblem::Vector6& a, const Lambda& lambda)
{
  const QpProblem::Vector6 root = problem.stiffness.cwiseSqrt();
  double highest = 0.0;
  double energy = root.cwiseProduct(problem.unconstrained).squaredNorm();
  std::vector<double> lengths;
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
  {
    const double length = problem.rows[i].cwiseQuotient(root).norm();
    lengths.push_back(length > 0.0 ? length : 1.0);
    const double inside = std::max(0.0, problem.bounds[i]);
    highest = std::max(highest, inside / lengths.back());
    if (problem.compliances[i] > 0.0)
      energy += inside * inside / problem.compliances[i];
  }
  const double size = highest + std::sqrt(energy);
  const double scale = size > 0.0 ? size : 1.0;

  KktError error;
  QpProblem::Vector6 residual = problem.stiffness.cwiseProduct(a - problem.unconstrained);
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
  {
    const double thrust = lambda(i);
    const double reached = problem.rows[i].dot(a) + problem.compliances[i] * thrust;
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

inline KktError kktError(const QpProblem& problem, const ContactQp& solved)
{
  return kktError(problem, solved.solution(), [&](std::size_t i) { return solved.lambda(i); });
}

} // namespace petrous::haptics::testing
