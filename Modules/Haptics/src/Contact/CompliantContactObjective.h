#pragma once

#include "NormalizedConstraints.h"

namespace petrous::haptics
{

/// Cost of a motion: stretch of the coupling and of the active compliant contacts
///
///   F(y) = 1/2 |y - v|^2 + 1/2 sum_i k_i max(0, b_i - n_i y)^2
///
/// strictly convex and piecewise quadratic. A set of active springs defines the model in which
/// these, and no others, act in both directions: its Hessian is H = 1 + sum k n n^T over the set.
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

  /// Starts a new problem; the springs active at y = v define the first model.
  void start(const Vector& v) noexcept;

  /// Moves y to the minimum of the model given by the springs active at y.
  void step(Vector& y) noexcept;

  /// Measures the springs at y and activates the stretched ones; false if the set is unchanged.
  bool takePressing(const Vector& y) noexcept;

  /// Whether exactly the model's springs are stretched at y, to within `tolerance`.
  bool agrees(const Vector& y, double tolerance) noexcept;

  /// Minimiser of F between y and y + d, as a fraction of d; springs must have been measured at y.
  double lineSearch(const Vector& y, const Vector& d) noexcept;

  /// Moves y to the minimum of F by Newton's method with line search, which terminates (J. Sun
  /// 1997, Mathematical Programming 76, 451). False if it takes too many steps.
  bool minimise(Vector& y, double rounding, int& iterations) noexcept;

  /// W with W^T W = H^-1
  const Matrix& inverseRoot() const noexcept { return m_inverseRoot; }

  /// The first spring to become active or inactive along the path, within `length`, which is
  /// shortened accordingly; -1 if none.
  Eigen::Index firstChange(const Vector& way, double& length) noexcept;

  /// Advances along the last path; toggles spring i, if i >= 0.
  void advance(double length, Eigen::Index i) noexcept;

  /// Sets each spring's force from its stretch at y; correctForces updates it for a shift of y.
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
  Eigen::ArrayXd m_weight; ///< k if the spring is active, else 0
  Eigen::ArrayXd m_rate;   ///< n d along a line
  Eigen::ArrayXd m_force;
  Matrix m_hessian = Matrix::Identity();
  Matrix m_inverseRoot = Matrix::Identity();
};

} // namespace petrous::haptics
