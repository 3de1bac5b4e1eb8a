#include "petrous/Haptics/ContactQp.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "ActiveRows.h"
#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

// Rows within this share of the problem's length of their bound hold: some thousand roundings.
constexpr double kFeasible = 1e-12;
constexpr double kRounding = 1e-15;
// Rigid rows give this much, beside the coupling: then rows that depend on each other are no special
// case, and walls that nearly face each other press with at most 1e6 times the hand's force.
constexpr double kCompliance = 1e-14;
// A row that gives more than this share of the problem's length shows a contradiction: where some
// motion w fulfils every row, c multiplier <= sqrt(c) |w - v|.
constexpr double kGiving = 4e-7;
// Whitened compliance, beside the coupling's own, under which a row is rigid.
constexpr double kRigid = 1e-9;
// Whitened lengths beyond this, or below its inverse, would overflow when squared.
constexpr double kLongest = 1e100;
constexpr int kMostChanges = 4000; // of the active set, in one problem
constexpr int kMostSteps = 60;    // of Newton's method
constexpr int kMostCuts = 40;     // of a line search

const ContactQp::Vector6& checked(std::size_t capacity, const ContactQp::Vector6& stiffness)
{
  if (capacity == 0)
    throw core::InvalidParameter("contact problem: room for no row; give a capacity above 0");
  if (!stiffness.allFinite() || !(stiffness.minCoeff() > 0.0))
    throw core::InvalidParameter("contact problem: each stiffness must be finite and above 0");
  return stiffness;
}

} // namespace

ContactQp::Rows::Rows(std::size_t capacity)
  : normal(capacity, 6)
  , bound(capacity)
  , slack(capacity)
  , spring(capacity)
  , weight(capacity)
  , rate(capacity)
  , length(capacity)
  , row(capacity)
{
}

bool ContactQp::Rows::add(const Vector6& whitened, double limit, double compliance,
                          std::size_t callersRow) noexcept
{
  const double largest = whitened.cwiseAbs().maxCoeff();
  if (!(largest < kLongest))
    return false;
  const bool zero = largest < 1.0 / kLongest;
  const double norm = zero ? 1.0 : whitened.norm();
  const double scaledBound = limit / norm;
  const double scaledSpring = compliance > 0.0 ? norm * norm / compliance : 0.0;
  if (!std::isfinite(scaledBound) || !std::isfinite(scaledSpring))
    return false;
  if (zero)
    normal.row(count).setZero();
  else
    normal.row(count) = whitened.transpose() / norm;
  bound[count] = scaledBound;
  spring[count] = scaledSpring;
  weight[count] = 0.0;
  length[count] = norm;
  row[count] = callersRow;
  ++count;
  return true;
}

void ContactQp::Rows::measure(const Vector6& y) noexcept
{
  slack.head(count) = normal.col(0).head(count) * y[0] + normal.col(1).head(count) * y[1] +
                      normal.col(2).head(count) * y[2] + normal.col(3).head(count) * y[3] +
                      normal.col(4).head(count) * y[4] + normal.col(5).head(count) * y[5] -
                      bound.head(count);
}

void ContactQp::Rows::along(const Vector6& d) noexcept
{
  rate.head(count) = normal.col(0).head(count) * d[0] + normal.col(1).head(count) * d[1] +
                     normal.col(2).head(count) * d[2] + normal.col(3).head(count) * d[3] +
                     normal.col(4).head(count) * d[4] + normal.col(5).head(count) * d[5];
}

ContactQp::ContactQp(std::size_t capacity, const Vector6& stiffness)
  : m_root(checked(capacity, stiffness).cwiseSqrt())
  , m_rigid(capacity)
  , m_soft(capacity)
  , m_lambda(capacity, 0.0)
{
}

void ContactQp::clear() noexcept
{
  m_count = 0;
  m_rigid.count = 0;
  m_soft.count = 0;
  m_highest = 0.0;
  m_energy = 0.0;
}

bool ContactQp::add(const Vector6& row, double bound, double compliance) noexcept
{
  if (m_count == m_lambda.size() || !row.allFinite() || !std::isfinite(bound) ||
      !std::isfinite(compliance) || compliance < 0.0)
    return false;
  const Vector6 whitened = row.cwiseQuotient(m_root);
  const bool soft = compliance > kRigid * whitened.squaredNorm();
  Rows& rows = soft ? m_soft : m_rigid;
  if (!rows.add(whitened, bound, soft ? compliance : 0.0, m_count))
    return false;
  const double inside = std::max(0.0, rows.bound[rows.count - 1]);
  m_highest = std::max(m_highest, inside);
  m_energy += inside * inside * rows.spring[rows.count - 1];
  m_lambda[m_count] = 0.0;
  ++m_count;
  return true;
}

ContactQp::Status ContactQp::solve(const Vector6& unconstrained) noexcept
{
  m_iterations = 0;
  m_solution.setZero();
  std::fill_n(m_lambda.begin(), m_count, 0.0);
  const Vector6 v = m_root.cwiseProduct(unconstrained);
  const double largest = v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (!(largest < kLongest) || !(m_highest < kLongest) || !std::isfinite(m_energy))
    return Status::Exhausted;
  m_scale = m_highest + std::sqrt(v.squaredNorm() + m_energy);

  ActiveRows active(kCompliance);
  Vector6 y = v;
  const Status status = relax(v, y) ? minimise(active, y) : Status::Exhausted;
  if (status != Status::Solved)
    return status;
  refine(v, y, active);

  // From here on the multipliers are the truth, and y is what they give: force and motion agree.
  y = v;
  for (int j = 0; j < active.size(); ++j)
  {
    const Eigen::Index i = active.row(j);
    const double pressure = std::max(0.0, active.multiplier(j));
    y += pressure * m_rigid.normalOf(i);
    m_lambda[m_rigid.row[i]] = pressure / m_rigid.length[i];
  }
  for (Eigen::Index i = 0; i < m_soft.count; ++i)
    if (m_soft.weight[i] > 0.0)
    {
      const double pressure = std::max(0.0, m_soft.rate[i]);
      y += pressure * m_soft.normalOf(i);
      m_lambda[m_soft.row[i]] = pressure / m_soft.length[i];
    }
  m_solution = y.cwiseQuotient(m_root);
  return status;
}

// The minimum over the springs alone, by Newton's method. Ends where a step's own springs still
// press at its end and no others do: there the model is the objective.
bool ContactQp::relax(const Vector6& v, Vector6& y) noexcept
{
  m_hessian.setIdentity();
  m_inverseRoot.setIdentity();
  if (m_soft.count == 0)
    return true;
  m_soft.weight.head(m_soft.count).setZero();
  m_soft.measure(y);
  takePressing();
  for (int n = 0; n < kMostSteps; ++n)
  {
    ++m_iterations;
    Vector6 next = y;
    takeModel(v, next);
    const Vector6 step = next - y;
    const double share = lineSearch(v, y, step);
    const bool done = step.norm() <= kRounding * m_scale;
    y = share < 1.0 ? Vector6(y + share * step) : next;
    m_soft.measure(y);
    if (done || (!takePressing() && share == 1.0))
      return true;
  }
  return false;
}

// Springs press where their slack is negative; true when they are not the same as before.
bool ContactQp::takePressing() noexcept
{
  bool changed = false;
  for (Eigen::Index i = 0; i < m_soft.count; ++i)
  {
    const double weight = m_soft.slack[i] < 0.0 ? m_soft.spring[i] : 0.0;
    changed |= weight != m_soft.weight[i];
    m_soft.weight[i] = weight;
  }
  return changed;
}

// The objective's quadratic model at y, with the slacks and the pressing springs as they are there:
// W from its Hessian H = 1 + sum w n n^T, and y moved to its minimum.
void ContactQp::takeModel(const Vector6& v, Vector6& y) noexcept
{
  const Eigen::Index count = m_soft.count;
  m_hessian.setIdentity();
  Vector6 gradient = y - v;
  for (int k = 0; k < 6; ++k)
  {
    const auto weighted = m_soft.weight.head(count) * m_soft.normal.col(k).head(count);
    gradient[k] += (weighted * m_soft.slack.head(count)).sum();
    for (int j = k; j < 6; ++j)
      m_hessian(j, k) += (weighted * m_soft.normal.col(j).head(count)).sum();
  }
  takeRoot();
  y -= m_inverseRoot.transpose() * (m_inverseRoot * gradient);
}

void ContactQp::takeRoot() noexcept
{
  const Eigen::LLT<Matrix6> cholesky(m_hessian);
  m_inverseRoot = cholesky.matrixL().solve(Matrix6::Identity());
}

// Dual active set: from the model's minimum take in the most violated row, letting go of those
// whose multiplier would become negative, until every rigid row holds.
ContactQp::Status ContactQp::minimise(ActiveRows& active, Vector6& y) noexcept
{
  active.clear();
  if (m_rigid.count == 0)
    return Status::Solved;
  while (true)
  {
    m_rigid.measure(y);
    // The others need not hold better than the active rows do.
    double giving = 0.0;
    for (int j = 0; j < active.size(); ++j)
    {
      m_rigid.slack[active.row(j)] = 0.0;
      giving = std::max(giving, kCompliance * active.multiplier(j));
    }
    const auto slacks = m_rigid.slack.head(m_rigid.count);
    const double lowest = slacks.minCoeff();
    if (!(lowest < -kFeasible * m_scale - 2.0 * giving))
      return Status::Solved;
    const Eigen::Index row = std::find(slacks.begin(), slacks.end(), lowest) - slacks.begin();
    const Status status = takeIn(row, lowest, active, y);
    if (status != Status::Solved)
      return status;
  }
}

ContactQp::Status ContactQp::takeIn(Eigen::Index row, double slack, ActiveRows& active,
                                    Vector6& y) noexcept
{
  const Vector6 normal = m_rigid.normalOf(row);
  const auto rate = m_soft.rate.head(m_soft.count);
  double multiplier = 0.0;
  m_soft.measure(y);
  while (true)
  {
    if (++m_iterations > kMostChanges)
      return Status::Exhausted;
    ActiveRows::Coefficients d;
    const ActiveRows::Rest rest = active.split(m_inverseRoot * normal, d);
    const ActiveRows::Coefficients r = active.solve(d);
    const Vector6 way = m_inverseRoot.transpose() * rest.head;
    // The step in units of the new row's multiplier: to its bound, or to where the first of the
    // others' multipliers is zero.
    double length = std::max(0.0, -slack / rest.square);
    int blocking = -1;
    for (int j = 0; j < active.size(); ++j)
      if (r[j] > 0.0 && active.multiplier(j) < length * r[j])
      {
        length = active.multiplier(j) / r[j];
        blocking = j;
      }
    Eigen::Index toggled = -1;
    if (m_soft.count > 0)
    {
      m_soft.along(way);
      for (Eigen::Index i = 0; i < m_soft.count; ++i)
      {
        const double sl = m_soft.weight[i] > 0.0 ? -m_soft.slack[i] : m_soft.slack[i];
        const double ra = m_soft.weight[i] > 0.0 ? m_soft.rate[i] : -m_soft.rate[i];
        if (ra > 0.0 && sl < length * ra)
        {
          length = std::max(0.0, sl / ra);
          toggled = i;
        }
      }
    }
    for (int j = 0; j < active.size(); ++j)
      active.multiplier(j) = std::max(0.0, active.multiplier(j) - length * r[j]);
    multiplier += length;
    if (kCompliance * multiplier > kGiving * m_scale)
      return Status::Infeasible;
    y += length * way;
    if (m_soft.count > 0)
      m_soft.slack.head(m_soft.count) += length * rate;
    if (toggled >= 0)
    {
      const double change = m_soft.spring[toggled] - 2.0 * m_soft.weight[toggled];
      m_soft.weight[toggled] += change;
      const Vector6 n = m_soft.normalOf(toggled);
      m_hessian += change * n * n.transpose();
      takeRoot();
      const ActiveRows old = active;
      active.clear();
      for (int j = 0; j < old.size(); ++j)
      {
        const ActiveRows::Rest left =
            active.split(m_inverseRoot * m_rigid.normalOf(old.row(j)), d);
        active.push(old.row(j), d, left, old.multiplier(j));
      }
    }
    else if (blocking >= 0)
      active.drop(blocking);
    else
    {
      if (active.size() == ActiveRows::kMost)
        return Status::Exhausted;
      active.push(row, d, rest, multiplier);
      return Status::Solved;
    }
    slack = normal.dot(y) + kCompliance * multiplier - m_rigid.bound[row];
  }
}

// Root of the objective's derivative along d from y, where the slacks are known: it is increasing
// and piecewise linear, so Newton's method within a bracket finds it. 1 where the step's end is
// still downhill.
double ContactQp::lineSearch(const Vector6& v, const Vector6& y, const Vector6& d) noexcept
{
  const Eigen::Index count = m_soft.count;
  const auto slack = m_soft.slack.head(count);
  const auto rate = m_soft.rate.head(count);
  m_soft.along(d);
  const auto stretched = rate * m_soft.spring.head(count);
  const double start = d.dot(y - v);
  const double square = d.squaredNorm();
  const double steepest = start + ((slack.min(0.0)) * stretched).sum();
  double low = 0.0;
  double high = 1.0;
  double t = 1.0;
  for (int n = 0; n < kMostCuts; ++n)
  {
    const double slope = start + t * square + ((slack + t * rate).min(0.0) * stretched).sum();
    if (std::abs(slope) <= 1e-6 * std::abs(steepest) || (t == 1.0 && slope < 0.0))
      return t;
    (slope > 0.0 ? high : low) = t;
    const double curvature =
        square + ((slack + t * rate) < 0.0).select(rate * stretched, 0.0).sum();
    const double guess = t - slope / curvature;
    t = guess > low && guess < high ? guess : 0.5 * (low + high);
  }
  return t;
}

// One step of iterative refinement on the equations
//   y = v + sum multiplier n,   n y = b (rigid),   n y + multiplier / spring = b (pressing)
// It takes away what H, ill-conditioned when springs are stiff, has spoilt. The springs'
// multipliers end in m_soft.rate.
void ContactQp::refine(const Vector6& v, Vector6& y, ActiveRows& active) noexcept
{
  const Eigen::Index count = m_soft.count;
  if (count > 0)
  {
    m_soft.measure(y);
    m_soft.rate.head(count) = -m_soft.weight.head(count) * m_soft.slack.head(count);
  }
  double share = 0.0;
  while (share < 1.0)
  {
    Vector6 force = v - y;
    for (Eigen::Index i = 0; i < count; ++i)
      force += m_soft.rate[i] * m_soft.normalOf(i);
    ActiveRows::Coefficients missing{};
    for (int j = 0; j < active.size(); ++j)
    {
      const Vector6 normal = m_rigid.normalOf(active.row(j));
      force += active.multiplier(j) * normal;
      missing[j] = m_rigid.bound[active.row(j)] - normal.dot(y) -
                   kCompliance * active.multiplier(j);
    }
    const Vector6 moved = m_inverseRoot * force;
    const ActiveRows::Coefficients along = active.alongQ(moved);
    ActiveRows::Coefficients sum = active.solveTransposed(missing);
    for (int j = 0; j < active.size(); ++j)
      sum[j] -= along[j];
    const ActiveRows::Coefficients change = active.solve(sum);
    share = 1.0;
    int blocking = -1;
    for (int j = 0; j < active.size(); ++j)
    {
      force += change[j] * m_rigid.normalOf(active.row(j));
      if (active.multiplier(j) + share * change[j] < 0.0)
      {
        share = -active.multiplier(j) / change[j];
        blocking = j;
      }
    }
    for (int j = 0; j < active.size(); ++j)
      active.multiplier(j) += share * change[j];
    const Vector6 shift = share * (m_inverseRoot.transpose() * (m_inverseRoot * force));
    for (Eigen::Index i = 0; i < count; ++i)
      m_soft.rate[i] -= m_soft.weight[i] * m_soft.normalOf(i).dot(shift);
    y += shift;
    if (blocking >= 0)
      active.drop(blocking);
  }
}

} // namespace petrous::haptics
