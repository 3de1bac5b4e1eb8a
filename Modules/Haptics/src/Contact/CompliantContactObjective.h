#pragma once

#include "NormalizedConstraints.h"

namespace petrous::haptics
{

/// What a motion costs: the coupling's stretch and that of the compliant contacts that press
///
///   F(y) = 1/2 |y - v|^2 + 1/2 sum_i k_i max(0, b_i - n_i y)^2
///
/// strictly convex and piecewise quadratic. With a set of pressing springs comes the model in which
/// these, and no others, act both ways: its Hessian is H = 1 + sum k n n^T over the set.
template <int N>
class CompliantContactObjective
{
public:
  using Vector = typename NormalizedConstraints<N>::Vector;
  using Matrix = Eigen::Matrix<double, N, N>;

  explicit CompliantContactObjective(std::size_t capacity);

  bool empty() const noexcept { return m_rows.count == 0; }
  void clear() noexcept { m_rows.count = 0; }
  bool add(const Vector& whitened, double bound, double compliance, std::size_t row) noexcept;

  /// 2 F(0) less |v|^2
  double energyAtRest() const noexcept;

  /// A new problem; the springs that press at y = v make the first model.
  void start(const Vector& v) noexcept;

  /// Moves y to the minimum of the model, whose springs are those that press at y.
  void step(Vector& y) noexcept;

  /// Springs are measured at y and press where they are stretched; false when the set was that
  /// before.
  bool takePressing(const Vector& y) noexcept;

  /// Whether at y the model's springs, and no others, are stretched by more than `tolerance`.
  bool agrees(const Vector& y, double tolerance) noexcept;

  /// Where between y and y + d, as a share of d, F is least; springs were measured at y.
  double lineSearch(const Vector& y, const Vector& d) noexcept;

  /// y at the minimum of F by Newton's method with line search, which ends after finitely many
  /// steps (J. Sun 1997, Mathematical Programming 76, 451). False when too many.
  bool minimise(Vector& y, double rounding, int& iterations) noexcept;

  /// W with W^T W = H^-1
  const Matrix& inverseRoot() const noexcept { return m_inverseRoot; }

  /// The spring that first begins or ceases to press on the way, within `length` of it, which it
  /// makes shorter; -1 when none does.
  Eigen::Index firstChange(const Vector& way, double& length) noexcept;

  /// Goes along the way given last, and lets spring i, if it is one, change.
  void advance(double length, Eigen::Index i) noexcept;

  /// Each spring's force from its stretch at y, and from then on by what a shift of y adds.
  void takeForces(const Vector& y) noexcept;
  void correctForces(const Vector& shift) noexcept;
  double force(Eigen::Index i) const noexcept { return m_force[i]; }

  /// v - y + sum force n: 0 at a minimum without rigid rows.
  Vector balance(const Vector& y) const noexcept;

  const NormalizedConstraints<N>& rows() const noexcept { return m_rows; }

private:
  void takeRoot() noexcept;

  NormalizedConstraints<N> m_rows;
  Vector m_v = Vector::Zero();
  Eigen::ArrayXd m_spring; ///< k
  Eigen::ArrayXd m_weight; ///< k where the spring presses, else 0
  Eigen::ArrayXd m_rate;   ///< n d along a line
  Eigen::ArrayXd m_force;
  Matrix m_hessian = Matrix::Identity();
  Matrix m_inverseRoot = Matrix::Identity();
};

} // namespace petrous::haptics
