#include "petrous/Haptics/ContactQp.h"

#include <algorithm>
#include <cmath>

#include "ActiveRows.h"
#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

// Rows within this fraction of the problem's scale of their bound are satisfied: some thousand
// ulps.
constexpr double kFeasible = 1e-12;
// Compliance of rows, relative to the coupling's. Its root, 1e-7, is the resolution of linear
// dependence; rounding errors divided by that root are how far they can move the solution.
constexpr double kCompliance = 1e-14;
// A row that yields by more than this fraction of the problem's scale indicates infeasibility: if
// some motion w satisfies every row, no row yields more than sqrt(c F(w)) on the way to the
// solution, F the objective.
constexpr double kGiving = 4e-7;
constexpr int kMaxPasses = 3;
constexpr int kMaxChanges = 3000; // of active rows
// Lengths above this or below its inverse would overflow when squared.
constexpr double kMaxLength = 1e100;

template <class Vector>
const Vector& checked(std::size_t capacity, const Vector& stiffness)
{
  if (capacity == 0)
    throw core::InvalidParameter("contact problem: room for no row; give a capacity above 0");
  if (!stiffness.allFinite() || !(stiffness.minCoeff() > 0.0))
    throw core::InvalidParameter("contact problem: each stiffness must be finite and above 0");
  return stiffness;
}

} // namespace

// The rows n y >= b are in the space where the coupling's stiffness is 1, scaled to unit length
// (zero rows stay zero). Structure of arrays: one vectorised pass evaluates all rows.
template <int N>
struct BasicContactQp<N>::Work
{
  using Active = ActiveRows<N>;

  explicit Work(std::size_t capacity)
    : normal(capacity, N)
    , bound(capacity)
    , slack(capacity)
    , length(capacity)
    , active(kCompliance)
  {
  }

  bool add(const Vector& whitened, double limit) noexcept;
  Status fulfil(Vector& y) noexcept;
  Status takeIn(Eigen::Index row, Vector& y) noexcept;
  void finish(Vector& y) noexcept;
  void refine(Vector& y) noexcept;
  double given(const Vector& y) const noexcept;

  Vector normalOf(Eigen::Index i) const noexcept { return normal.row(i).transpose(); }

  // n y for every row, as an expression template.
  template <int Last = N - 1>
  auto along(const Vector& y) const noexcept
  {
    if constexpr (Last == 0)
      return normal.col(0).head(count) * y[0];
    else
      return along<Last - 1>(y) + normal.col(Last).head(count) * y[Last];
  }

  Eigen::Index count = 0;
  Eigen::Array<double, Eigen::Dynamic, N> normal;
  Eigen::ArrayXd bound;
  Eigen::ArrayXd slack;       ///< n y - b
  std::vector<double> length; ///< of the row before scaling

  Active active;
  Vector v = Vector::Zero(); ///< the unconstrained motion
  double highest = 0.0;      ///< largest positive bound
  double scale = 0.0;        ///< the problem's scale: |v| plus the largest bound
  int changes = 0;
};

template <int N>
bool BasicContactQp<N>::Work::add(const Vector& whitened, double limit) noexcept
{
  const double largest = whitened.cwiseAbs().maxCoeff();
  if (!(largest < kMaxLength))
    return false;
  const bool zero = largest < 1.0 / kMaxLength;
  const double norm = zero ? 1.0 : whitened.norm();
  if (!std::isfinite(limit / norm))
    return false;
  if (zero)
    normal.row(count).setZero();
  else
    normal.row(count) = whitened.transpose() / norm;
  bound[count] = limit / norm;
  length[count] = norm;
  highest = std::max(highest, bound[count]);
  ++count;
  return true;
}

template <int N>
BasicContactQp<N>::BasicContactQp(std::size_t capacity, const Vector& stiffness)
  : m_root(checked(capacity, stiffness).cwiseSqrt())
  , m_lambda(capacity, 0.0)
{
  m_work = std::make_unique<Work>(capacity);
}

template <int N>
BasicContactQp<N>::~BasicContactQp() = default;
template <int N>
BasicContactQp<N>::BasicContactQp(BasicContactQp&&) noexcept = default;
template <int N>
BasicContactQp<N>& BasicContactQp<N>::operator=(BasicContactQp&&) noexcept = default;

template <int N>
void BasicContactQp<N>::clear() noexcept
{
  m_count = 0;
  m_work->count = 0;
  m_work->highest = 0.0;
}

template <int N>
bool BasicContactQp<N>::add(const Vector& row, double bound) noexcept
{
  if (m_count == m_lambda.size() || !row.allFinite() || !std::isfinite(bound) ||
      !m_work->add(row.cwiseQuotient(m_root), bound))
    return false;
  m_lambda[m_count] = 0.0;
  ++m_count;
  return true;
}

template <int N>
typename BasicContactQp<N>::Status BasicContactQp<N>::solve(const Vector& unconstrained) noexcept
{
  Work& work = *m_work;
  m_solution.setZero();
  std::fill_n(m_lambda.begin(), m_count, 0.0);
  work.v = m_root.cwiseProduct(unconstrained);
  work.scale = work.highest + work.v.norm();
  work.changes = 0;
  work.active.clear();
  m_iterations = 0;
  if (work.scale < 1.0 / kMaxLength)
    return Status::Solved;
  if (!(work.scale < kMaxLength)) // also rejects NaN
    return Status::Exhausted;
  Vector y = work.v;
  const Status status = work.fulfil(y);
  m_iterations = work.changes;
  if (status != Status::Solved)
    return status;
  work.finish(y);

  // y is recomputed from the multipliers, so that force and motion agree.
  y = work.v;
  for (int j = 0; j < work.active.size(); ++j)
  {
    const Eigen::Index i = work.active.row(j);
    const double multiplier = work.active.multiplier(j);
    y += multiplier * work.normalOf(i);
    m_lambda[i] = multiplier / work.length[i];
  }
  m_solution = y.cwiseQuotient(m_root);
  return status;
}

// Dual active set: from a minimum of the active rows alone, add the most violated row, dropping
// those whose multiplier would become negative, until every row holds.
template <int N>
typename BasicContactQp<N>::Status BasicContactQp<N>::Work::fulfil(Vector& y) noexcept
{
  while (count > 0)
  {
    // The others need not hold more accurately than the active rows.
    const double allowed = kFeasible * scale + 2.0 * given(y);
    slack.head(count) = along(y) - bound.head(count);
    for (int j = 0; j < active.size(); ++j)
      slack[active.row(j)] = 0.0;
    const auto current = slack.head(count);
    const double lowest = current.minCoeff();
    if (!(lowest < -allowed))
      break;
    const Eigen::Index row = std::find(current.begin(), current.end(), lowest) - current.begin();
    const Status status = takeIn(row, y);
    if (status != Status::Solved)
      return status;
  }
  return Status::Solved;
}

// Increases the multiplier of one row until it holds.
template <int N>
typename BasicContactQp<N>::Status BasicContactQp<N>::Work::takeIn(Eigen::Index row,
                                                                   Vector& y) noexcept
{
  const Vector n = normalOf(row);
  double multiplier = 0.0;
  while (++changes < kMaxChanges)
  {
    typename Active::Coefficients d;
    const typename Active::Rest rest = active.split(n, d);
    const typename Active::Coefficients r = active.solve(d);
    // Step length, in units of the new multiplier: until the row holds, or another's multiplier
    // reaches 0.
    const double left = n.dot(y) + kCompliance * multiplier - bound[row];
    double step = std::max(0.0, -left / rest.square);
    int blocking = -1;
    for (int j = 0; j < active.size(); ++j)
      if (r[j] > 0.0 && active.multiplier(j) < step * r[j])
      {
        step = active.multiplier(j) / r[j];
        blocking = j;
      }

    y += step * rest.head;
    multiplier += step;
    for (int j = 0; j < active.size(); ++j)
      active.multiplier(j) = std::max(0.0, active.multiplier(j) - step * r[j]);
    if (kCompliance * multiplier > kGiving * scale)
      return Status::Infeasible;
    if (blocking >= 0)
      active.drop(blocking);
    else if (active.size() < Active::kMax)
    {
      active.push(row, d, rest, multiplier);
      return Status::Solved;
    }
    else
      return Status::Exhausted;
  }
  return Status::Exhausted;
}

// Largest violation of the active rows' bounds at y.
template <int N>
double BasicContactQp<N>::Work::given(const Vector& y) const noexcept
{
  double most = 0.0;
  for (int j = 0; j < active.size(); ++j)
  {
    const Eigen::Index i = active.row(j);
    most = std::max(most, bound[i] - normalOf(i).dot(y));
  }
  return most;
}

// Rows that yield by more than a little are tightened until they hold: refinement without
// compliance raises the multipliers, which is a step of the proximal point method, and adds the
// rows violated then. Rows 1e-6 or farther from linear dependence hold after a step or two; nearer
// ones keep their remaining violation.
template <int N>
void BasicContactQp<N>::Work::finish(Vector& y) noexcept
{
  for (int n = 0; n < kMaxPasses && given(y) > kFeasible * scale; ++n)
  {
    const Active before = active;
    const Vector start = y;
    refine(y);
    if (fulfil(y) == Status::Solved)
      continue;
    active = before;
    y = start;
    return;
  }
}

// Iterative refinement of the equations at the solution,
//   y = v + sum multiplier n,   n y = b for active rows.
// A multiplier that would become negative is dropped and the rest refined again.
template <int N>
void BasicContactQp<N>::Work::refine(Vector& y) noexcept
{
  while (true)
  {
    Vector force = v - y;
    typename Active::Coefficients missing;
    for (int j = 0; j < active.size(); ++j)
    {
      const Vector n = normalOf(active.row(j));
      force += active.multiplier(j) * n;
      missing[j] = bound[active.row(j)] - n.dot(y);
    }
    const typename Active::Coefficients projected = active.alongQ(force);
    typename Active::Coefficients sum = active.solveTransposed(missing);
    for (int j = 0; j < active.size(); ++j)
      sum[j] -= projected[j];
    const typename Active::Coefficients change = active.solve(sum);
    double step = 1.0;
    int blocking = -1;
    for (int j = 0; j < active.size(); ++j)
    {
      force += change[j] * normalOf(active.row(j));
      if (active.multiplier(j) + step * change[j] < 0.0)
      {
        step = -active.multiplier(j) / change[j];
        blocking = j;
      }
    }
    for (int j = 0; j < active.size(); ++j)
      active.multiplier(j) = std::max(0.0, active.multiplier(j) + step * change[j]);
    y += step * force;
    if (blocking < 0)
      return;
    active.drop(blocking);
  }
}

template class BasicContactQp<ContactQp::kSize>;
template class BasicContactQp<SharedContactQp::kSize>;

} // namespace petrous::haptics
