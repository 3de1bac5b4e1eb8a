#pragma once

#include "WhitenedRows.h"

namespace petrous::haptics
{

/// What a motion costs: the coupling's stretch and that of the compliant contacts that press
///
///   F(y) = 1/2 |y - v|^2 + 1/2 sum_i k_i max(0, b_i - n_i y)^2
///
/// strictly convex and piecewise quadratic. With a set of pressing springs comes the model in which
/// these, and no others, act both ways: its Hessian is H = 1 + sum k n n^T over the set.
class SpringObjective
{
public:
  using Vector6 = WhitenedRows::Vector6;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  explicit SpringObjective(std::size_t capacity);

  bool empty() const noexcept { return m_rows.count == 0; }
  void clear() noexcept { m_rows.count = 0; }
  bool add(const Vector6& whitened, double bound, double compliance, std::size_t row) noexcept;

  /// 2 F(0) less |v|^2
  double energyAtRest() const noexcept;

  /// A new problem; the springs that press at y = v make the first model.
  void start(const Vector6& v) noexcept;

  /// Moves y to the minimum of the model, whose springs are those that press at y.
  void step(Vector6& y) noexcept;

  /// Springs are measured at y and press where they are stretched; false when the set was that
  /// before.
  bool takePressing(const Vector6& y) noexcept;

  /// Whether at y the model's springs, and no others, are stretched by more than `tolerance`.
  bool agrees(const Vector6& y, double tolerance) noexcept;

  /// Where between y and y + d, as a share of d, F is least; springs were measured at y.
  double lineSearch(const Vector6& y, const Vector6& d) noexcept;

  /// y at the minimum of F by Newton's method with line search, which ends after finitely many
  /// steps (J. Sun 1997, Mathematical Programming 76, 451). False when too many.
  bool minimise(Vector6& y, double rounding, int& iterations) noexcept;

  /// W with W^T W = H^-1
  const Matrix6& inverseRoot() const noexcept { return m_inverseRoot; }

  /// The spring that first begins or ceases to press on the way, within `length` of it, which it
  /// makes shorter; -1 when none does.
  Eigen::Index firstChange(const Vector6& way, double& length) noexcept;

  /// Goes along the way given last, and lets spring i, if it is one, change.
  void advance(double length, Eigen::Index i) noexcept;

  /// Each spring's force from its stretch at y, and from then on by what a shift of y adds.
  void takeForces(const Vector6& y) noexcept;
  void correctForces(const Vector6& shift) noexcept;
  double force(Eigen::Index i) const noexcept { return m_force[i]; }

  /// v - y + sum force n: 0 at a minimum without rigid rows.
  Vector6 balance(const Vector6& y) const noexcept;

  const WhitenedRows& rows() const noexcept { return m_rows; }

private:
  void takeRoot() noexcept;

  WhitenedRows m_rows;
  Vector6 m_v = Vector6::Zero();
  Eigen::ArrayXd m_spring; ///< k
  Eigen::ArrayXd m_weight; ///< k where the spring presses, else 0
  Eigen::ArrayXd m_rate;   ///< n d along a line
  Eigen::ArrayXd m_force;
  Matrix6 m_hessian = Matrix6::Identity();
  Matrix6 m_inverseRoot = Matrix6::Identity();
};

} // namespace petrous::haptics
