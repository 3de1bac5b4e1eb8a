#include "petrous/Haptics/ContactQp.h"

#include <algorithm>
#include <cmath>

#include "ActiveRows.h"
#include "CompliantContactObjective.h"
#include "NormalizedConstraints.h"
#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

// Rows within this fraction of the problem's scale of their bound are satisfied: some thousand
// ulps.
constexpr double kFeasible = 1e-12;
constexpr double kRounding = 1e-15;
// Compliance of rigid rows, relative to the coupling's. Its root, 1e-7, is the resolution of linear
// dependence; rounding errors divided by that root are how far they can move the solution.
constexpr double kCompliance = 1e-14;
// A row that yields by more than this fraction of the problem's scale indicates infeasibility: if
// some motion w satisfies every row, no row yields more than sqrt(c F(w)) on the way to the
// solution.
constexpr double kGiving = 4e-7;
// Compliance, relative to the coupling's, below which a row is rigid.
constexpr double kRigid = 1e-9;
// A Newton step below this fraction of the problem's scale is taken in full: it can be shorter than
// what the rigid rows yield, which the line search does not see.
constexpr double kShort = 1e-3;
constexpr int kNewtonSteps = 12;
constexpr int kMaxPasses = 3;
constexpr int kMaxChanges = 3000; // of active rows and active springs

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

template <int N>
struct BasicContactQp<N>::Work
{
  explicit Work(std::size_t capacity)
    : rigid(capacity)
    , springs(capacity)
    , active(kCompliance)
  {
  }

  Status settle(const Vector& v, Vector& y) noexcept;
  Status fulfil(Vector& y, bool follow) noexcept;
  Status takeIn(Eigen::Index row, bool follow, Vector& y) noexcept;
  void rebuild() noexcept;
  void finish(Vector& y) noexcept;
  void refine(double compliance, Vector& y) noexcept;
  double given(const Vector& y) const noexcept;

  NormalizedConstraints<N> rigid;
  CompliantContactObjective<N> springs;
  ActiveRows<N> active;
  double highest = 0.0; ///< largest positive bound
  double scale = 0.0;   ///< the problem's scale: sqrt(2 F(0)) plus the largest bound
  int changes = 0;
};

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
  m_work->rigid.count = 0;
  m_work->springs.clear();
  m_work->highest = 0.0;
}

template <int N>
bool BasicContactQp<N>::add(const Vector& row, double bound, double compliance) noexcept
{
  if (m_count == m_lambda.size() || !row.allFinite() || !std::isfinite(bound) ||
      !std::isfinite(compliance) || compliance < 0.0)
    return false;
  const Vector whitened = row.cwiseQuotient(m_root);
  const bool soft = compliance > kRigid * whitened.squaredNorm();
  if (soft ? !m_work->springs.add(whitened, bound, compliance, m_count)
           : !m_work->rigid.add(whitened, bound, m_count))
    return false;
  const NormalizedConstraints<N>& rows = soft ? m_work->springs.rows() : m_work->rigid;
  m_work->highest = std::max(m_work->highest, rows.bound[rows.count - 1]);
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
  const Vector v = m_root.cwiseProduct(unconstrained);
  work.scale = work.highest + std::sqrt(v.squaredNorm() + work.springs.energyAtRest());
  work.changes = 0;
  m_iterations = 0;
  Vector y = v;
  if (work.scale < 1.0 / NormalizedConstraints<N>::kMaxLength)
    return Status::Solved;
  // Also rejects NaN.
  const Status status =
      work.scale < NormalizedConstraints<N>::kMaxLength ? work.settle(v, y) : Status::Exhausted;
  m_iterations = work.changes;
  if (status != Status::Solved)
    return status;
  work.finish(y);

  // y is recomputed from the multipliers, so that force and motion agree.
  y = v;
  for (int j = 0; j < work.active.size(); ++j)
  {
    const Eigen::Index i = work.active.row(j);
    const double multiplier = work.active.multiplier(j);
    y += multiplier * work.rigid.normalOf(i);
    m_lambda[work.rigid.row[i]] = multiplier / work.rigid.length[i];
  }
  const NormalizedConstraints<N>& soft = work.springs.rows();
  for (Eigen::Index i = 0; i < soft.count; ++i)
    if (work.springs.force(i) > 0.0)
    {
      y += work.springs.force(i) * soft.normalOf(i);
      m_lambda[soft.row[i]] = work.springs.force(i) / soft.length[i];
    }
  m_solution = y.cwiseQuotient(m_root);
  return status;
}

template <int N>
typename BasicContactQp<N>::Status BasicContactQp<N>::Work::settle(const Vector& v,
                                                                   Vector& y) noexcept
{
  springs.start(v);
  active.clear();
  if (springs.empty())
    return fulfil(y, false);
  // Newton's method: the model's minimum subject to the rigid rows, repeated from there until a
  // step leaves the active springs unchanged.
  for (int n = 0; n < kNewtonSteps; ++n)
  {
    ++changes;
    Vector next = y;
    springs.step(next);
    active.clear();
    if (fulfil(next, false) != Status::Solved)
      break;
    const Vector d = next - y;
    // The first step starts where the rigid rows are violated: there is no line to search.
    const bool whole = n == 0 || d.norm() < kShort * scale;
    const double share = whole ? 1.0 : springs.lineSearch(y, d);
    y = share < 1.0 ? Vector(y + share * d) : next;
    if (!springs.takePressing(y) && share == 1.0)
      return Status::Solved;
  }
  // Newton's method occasionally cycles or meets a model that contradicts the rows. Slower but
  // safe: start from the springs' own minimum and follow each of them.
  y = v;
  active.clear();
  if (!springs.minimise(y, kRounding * scale, changes))
    return Status::Exhausted;
  return fulfil(y, true);
}

// Dual active set: from a minimum without rigid rows, add the most violated row, dropping those
// whose multiplier would become negative, until every row holds.
template <int N>
typename BasicContactQp<N>::Status BasicContactQp<N>::Work::fulfil(Vector& y, bool follow) noexcept
{
  while (rigid.count > 0)
  {
    // The others need not hold more accurately than the active rows.
    const double allowed = kFeasible * scale + 2.0 * given(y);
    rigid.measure(y);
    for (int j = 0; j < active.size(); ++j)
      rigid.slack[active.row(j)] = 0.0;
    const auto slack = rigid.slack.head(rigid.count);
    const double lowest = slack.minCoeff();
    if (!(lowest < -allowed))
      break;
    const Eigen::Index row = std::find(slack.begin(), slack.end(), lowest) - slack.begin();
    const Status status = takeIn(row, follow, y);
    if (status != Status::Solved)
      return status;
  }
  return Status::Solved;
}

// Increases the multiplier of one row until it holds. `follow`: springs that become active or
// inactive on the way change the model there, so that y stays a minimum of F; otherwise the model
// is fixed.
template <int N>
typename BasicContactQp<N>::Status BasicContactQp<N>::Work::takeIn(Eigen::Index row, bool follow,
                                                                   Vector& y) noexcept
{
  const Vector normal = rigid.normalOf(row);
  double multiplier = 0.0;
  while (++changes < kMaxChanges)
  {
    typename ActiveRows<N>::Coefficients d;
    const typename ActiveRows<N>::Rest rest = active.split(springs.inverseRoot() * normal, d);
    const typename ActiveRows<N>::Coefficients r = active.solve(d);
    const Vector way = springs.inverseRoot().transpose() * rest.head;
    // Step length, in units of the new multiplier: until the row holds, another's multiplier
    // reaches 0, or a spring changes.
    const double slack = normal.dot(y) + kCompliance * multiplier - rigid.bound[row];
    double length = std::max(0.0, -slack / rest.square);
    int blocking = -1;
    for (int j = 0; j < active.size(); ++j)
      if (r[j] > 0.0 && active.multiplier(j) < length * r[j])
      {
        length = active.multiplier(j) / r[j];
        blocking = j;
      }
    const Eigen::Index spring = follow ? springs.firstChange(way, length) : -1;

    y += length * way;
    multiplier += length;
    for (int j = 0; j < active.size(); ++j)
      active.multiplier(j) = std::max(0.0, active.multiplier(j) - length * r[j]);
    if (kCompliance * multiplier > kGiving * scale)
      return Status::Infeasible;
    if (follow)
      springs.advance(length, spring);
    if (spring >= 0)
      rebuild();
    else if (blocking >= 0)
      active.drop(blocking);
    else if (active.size() < ActiveRows<N>::kMax)
    {
      active.push(row, d, rest, multiplier);
      return Status::Solved;
    }
    else
      return Status::Exhausted;
  }
  return Status::Exhausted;
}

// Re-adds the active rows in the metric of a new model.
template <int N>
void BasicContactQp<N>::Work::rebuild() noexcept
{
  const typename ActiveRows<N>::Members members = active.members();
  const int size = active.size();
  active.clear();
  for (int j = 0; j < size; ++j)
  {
    typename ActiveRows<N>::Coefficients d;
    const Vector n = springs.inverseRoot() * rigid.normalOf(members.row[j]);
    const typename ActiveRows<N>::Rest rest = active.split(n, d);
    active.push(members.row[j], d, rest, members.multiplier[j]);
  }
}

// Largest violation of the active rows' bounds at y.
template <int N>
double BasicContactQp<N>::Work::given(const Vector& y) const noexcept
{
  double most = 0.0;
  for (int j = 0; j < active.size(); ++j)
  {
    const Eigen::Index i = active.row(j);
    most = std::max(most, rigid.bound[i] - rigid.normalOf(i).dot(y));
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
  if (!springs.empty())
    refine(kCompliance, y);
  for (int n = 0; n < kMaxPasses && given(y) > kFeasible * scale; ++n)
  {
    const ActiveRows<N> before = active;
    const Vector start = y;
    refine(0.0, y);
    const double tolerance = kFeasible * scale;
    const bool good = springs.agrees(y, tolerance) && fulfil(y, true) == Status::Solved &&
                      springs.agrees(y, tolerance);
    if (!good)
    {
      active = before;
      y = start;
      springs.takePressing(y);
    }
    springs.takeForces(y);
    if (!good)
      break;
  }
}

// Iterative refinement of the equations at the solution,
//   y = v + sum multiplier n,   n y + c multiplier = b for active rows and active springs,
// removes the error of H with stiff springs: without it a compliance of 1e-6 of the coupling's
// costs seven digits. A multiplier that would become negative is dropped and the rest refined
// again.
template <int N>
void BasicContactQp<N>::Work::refine(double compliance, Vector& y) noexcept
{
  springs.takeForces(y);
  while (true)
  {
    Vector force = springs.balance(y);
    typename ActiveRows<N>::Coefficients missing;
    for (int j = 0; j < active.size(); ++j)
    {
      const Vector normal = rigid.normalOf(active.row(j));
      force += active.multiplier(j) * normal;
      missing[j] = rigid.bound[active.row(j)] - normal.dot(y) - compliance * active.multiplier(j);
    }
    const typename ActiveRows<N>::Coefficients along = active.alongQ(springs.inverseRoot() * force);
    typename ActiveRows<N>::Coefficients sum = active.solveTransposed(missing);
    for (int j = 0; j < active.size(); ++j)
      sum[j] -= along[j];
    const typename ActiveRows<N>::Coefficients change = active.solve(sum);
    double share = 1.0;
    int blocking = -1;
    for (int j = 0; j < active.size(); ++j)
    {
      force += change[j] * rigid.normalOf(active.row(j));
      if (active.multiplier(j) + share * change[j] < 0.0)
      {
        share = -active.multiplier(j) / change[j];
        blocking = j;
      }
    }
    for (int j = 0; j < active.size(); ++j)
      active.multiplier(j) = std::max(0.0, active.multiplier(j) + share * change[j]);
    const Vector shift =
        share * (springs.inverseRoot().transpose() * (springs.inverseRoot() * force));
    y += shift;
    springs.correctForces(shift);
    if (blocking < 0)
      return;
    active.drop(blocking);
  }
}

template class BasicContactQp<ContactQp::kSize>;
template class BasicContactQp<SharedContactQp::kSize>;

} // namespace petrous::haptics
