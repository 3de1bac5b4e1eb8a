#include "CompliantContactObjective.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "petrous/Haptics/ContactQp.h"

namespace petrous::haptics
{

namespace
{

constexpr int kMaxSteps = 60;  // of Newton's method
constexpr int kMaxCuts = 40;   // of a line search
constexpr double kFlat = 1e-6; // slope relative to that at the line's start that ends a search

} // namespace

template <int N>
CompliantContactObjective<N>::CompliantContactObjective(std::size_t capacity)
  : m_rows(capacity)
  , m_spring(capacity)
  , m_weight(capacity)
  , m_rate(capacity)
  , m_force(capacity)
{
}

template <int N>
bool CompliantContactObjective<N>::add(const Vector& whitened, double bound, double compliance,
                                       std::size_t row) noexcept
{
  if (!m_rows.add(whitened, bound, row))
    return false;
  const Eigen::Index i = m_rows.count - 1;
  m_spring[i] = m_rows.length[i] * m_rows.length[i] / compliance;
  if (!std::isfinite(m_spring[i]))
    --m_rows.count;
  return i < m_rows.count;
}

template <int N>
double CompliantContactObjective<N>::energyAtRest() const noexcept
{
  const Eigen::Index count = m_rows.count;
  return (m_spring.head(count) * m_rows.bound.head(count).max(0.0).square()).sum();
}

template <int N>
void CompliantContactObjective<N>::start(const Vector& v) noexcept
{
  m_v = v;
  m_hessian.setIdentity();
  m_inverseRoot.setIdentity();
  m_weight.head(m_rows.count).setZero();
  takePressing(v);
}

template <int N>
bool CompliantContactObjective<N>::takePressing(const Vector& y) noexcept
{
  m_rows.measure(y);
  bool changed = false;
  for (Eigen::Index i = 0; i < m_rows.count; ++i)
  {
    const double weight = m_rows.slack[i] < 0.0 ? m_spring[i] : 0.0;
    changed |= weight != m_weight[i];
    m_weight[i] = weight;
  }
  return changed;
}

template <int N>
bool CompliantContactObjective<N>::agrees(const Vector& y, double tolerance) noexcept
{
  m_rows.measure(y);
  for (Eigen::Index i = 0; i < m_rows.count; ++i)
    if (m_weight[i] > 0.0 ? m_rows.slack[i] > tolerance : m_rows.slack[i] < -tolerance)
      return false;
  return true;
}

template <int N>
void CompliantContactObjective<N>::takeRoot() noexcept
{
  const Eigen::LLT<Matrix> cholesky(m_hessian);
  m_inverseRoot = cholesky.matrixL().solve(Matrix::Identity());
}

template <int N>
void CompliantContactObjective<N>::step(Vector& y) noexcept
{
  const Eigen::Index count = m_rows.count;
  if (count == 0)
  {
    y = m_v;
    return;
  }
  Vector gradient = y - m_v;
  m_hessian.setIdentity();
  for (int k = 0; k < N; ++k)
  {
    const auto weighted = m_weight.head(count) * m_rows.normal.col(k).head(count);
    gradient[k] += (weighted * m_rows.slack.head(count)).sum();
    for (int j = k; j < N; ++j)
    {
      m_hessian(j, k) += (weighted * m_rows.normal.col(j).head(count)).sum();
      m_hessian(k, j) = m_hessian(j, k);
    }
  }
  takeRoot();
  y -= m_inverseRoot.transpose() * (m_inverseRoot * gradient);
}

// F's derivative along the line is increasing and piecewise linear, so a bracketed Newton's method
// finds its root.
template <int N>
double CompliantContactObjective<N>::lineSearch(const Vector& y, const Vector& d) noexcept
{
  const Eigen::Index count = m_rows.count;
  m_rate.head(count) = m_rows.along(d);
  const auto slack = m_rows.slack.head(count);
  const auto rate = m_rate.head(count);
  const auto pull = rate * m_spring.head(count);
  const double start = d.dot(y - m_v);
  const double square = d.squaredNorm();
  const double steepest = std::abs(start + (slack.min(0.0) * pull).sum());
  double low = 0.0;
  double high = 1.0;
  double t = 1.0;
  for (int n = 0; n < kMaxCuts; ++n)
  {
    const double slope = start + t * square + ((slack + t * rate).min(0.0) * pull).sum();
    if (std::abs(slope) <= kFlat * steepest || (t == 1.0 && slope < 0.0))
      break;
    (slope > 0.0 ? high : low) = t;
    const double curvature = square + ((slack + t * rate) < 0.0).select(rate * pull, 0.0).sum();
    const double guess = t - slope / curvature;
    t = guess > low && guess < high ? guess : 0.5 * (low + high);
  }
  return t;
}

template <int N>
bool CompliantContactObjective<N>::minimise(Vector& y, double rounding, int& iterations) noexcept
{
  takePressing(y);
  for (int n = 0; n < kMaxSteps; ++n)
  {
    ++iterations;
    Vector next = y;
    step(next);
    const Vector d = next - y;
    const double share = lineSearch(y, d);
    y = share < 1.0 ? Vector(y + share * d) : next;
    // If the active springs are unchanged after a full step, the model equals F.
    const bool changed = takePressing(y);
    if ((!changed && share == 1.0) || d.norm() <= rounding)
      return true;
  }
  return false;
}

template <int N>
Eigen::Index CompliantContactObjective<N>::firstChange(const Vector& way, double& length) noexcept
{
  m_rate.head(m_rows.count) = m_rows.along(way);
  Eigen::Index first = -1;
  for (Eigen::Index i = 0; i < m_rows.count; ++i)
  {
    // Remaining stretch or slack, and its rate of loss. The sign of the rate decides: at the bound
    // itself the sign of the slack is rounding noise.
    const double sign = m_weight[i] > 0.0 ? -1.0 : 1.0;
    const double left = sign * m_rows.slack[i];
    const double loss = -sign * m_rate[i];
    if (loss > 0.0 && left < length * loss)
    {
      length = std::max(0.0, left / loss);
      first = i;
    }
  }
  return first;
}

template <int N>
void CompliantContactObjective<N>::advance(double length, Eigen::Index i) noexcept
{
  m_rows.slack.head(m_rows.count) += length * m_rate.head(m_rows.count);
  if (i < 0)
    return;
  const double change = m_spring[i] - 2.0 * m_weight[i];
  m_weight[i] += change;
  const Vector n = m_rows.normalOf(i);
  m_hessian += (change * n) * n.transpose();
  takeRoot();
}

template <int N>
void CompliantContactObjective<N>::takeForces(const Vector& y) noexcept
{
  const Eigen::Index count = m_rows.count;
  m_rows.measure(y);
  m_force.head(count) = -m_weight.head(count) * m_rows.slack.head(count);
}

template <int N>
typename CompliantContactObjective<N>::Vector
CompliantContactObjective<N>::balance(const Vector& y) const noexcept
{
  const Eigen::Index count = m_rows.count;
  Vector sum = m_v - y;
  for (int k = 0; k < N; ++k)
    sum[k] += (m_force.head(count) * m_rows.normal.col(k).head(count)).sum();
  return sum;
}

template <int N>
void CompliantContactObjective<N>::correctForces(const Vector& shift) noexcept
{
  m_force.head(m_rows.count) -= m_weight.head(m_rows.count) * m_rows.along(shift);
}

template class CompliantContactObjective<ContactQp::kSize>;
template class CompliantContactObjective<SharedContactQp::kSize>;

} // namespace petrous::haptics
