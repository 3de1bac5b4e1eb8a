#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

/// Motion of a constrained body: Gauss' principle with gaps [Chan2016, Eq. 1 corrected]
///
///   a = argmin 1/2 (a - u)^T M (a - u)   subject to   J_i a >= b_i
///
/// a, u   N-vectors; the first six are translation mm and rotation rad
/// M      diagonal, > 0: the coupling's stiffness, N/mm and N mm/rad; then M (a - u) = J^T lambda
///        is the wrench on the device, and lambda_i >= 0 the thrust at contact i, N
/// J_i    row of contact i: (n, r x n), n the unit normal out of the tissue, r the lever arm, mm
/// b_i    -gap, mm (> 0 only where the contact is violated already)
///
/// Dual active set (Goldfarb and Idnani 1983, doi 10.1007/BF02591962) in the space whitened by M.
///
/// Rows have a compliance of up to 1e-14 of the coupling's. Linearly dependent rows therefore need
/// no special case, and nearly opposed walls push with at most about 1e7 times the device's force.
/// Rows are satisfied to 1e-9 of the problem's scale (the square root of twice the objective at
/// a = 0, and the largest bound) where none is closer than 1e-5 to linear dependence, and always to
/// 1e-7. Where rows are linearly dependent, lambda is one of the possible solutions. Deterministic:
/// the same rows in the same order give bit-identical results.
///
/// One problem per tick. Only the constructor allocates or throws.
template <int N>
class BasicContactQp
{
public:
  static constexpr int kSize = N;
  using Vector = Eigen::Matrix<double, N, 1>;

  enum class Status
  {
    Solved,
    Infeasible, ///< rows contradict each other; a = 0, lambda = 0
    Exhausted   ///< iteration limit, or u not finite; a = 0, lambda = 0
  };

  /// Throws InvalidParameter if capacity is 0 or an entry of `stiffness` is not above 0.
  BasicContactQp(std::size_t capacity, const Vector& stiffness);
  ~BasicContactQp();
  BasicContactQp(BasicContactQp&&) noexcept;
  BasicContactQp& operator=(BasicContactQp&&) noexcept;

  void clear() noexcept;
  std::size_t count() const noexcept { return m_count; }

  /// Adds a row. Returns false and adds nothing if the capacity is reached or a number is not
  /// finite.
  bool add(const Vector& row, double bound) noexcept;

  Status solve(const Vector& unconstrained) noexcept;

  /// Of the last solve.
  const Vector& solution() const noexcept { return m_solution; }

  /// Of the last solve; `row` is the index in the order of addition.
  double lambda(std::size_t row) const noexcept { return m_lambda[row]; }

  /// Of the last solve: changes of the active set.
  int iterations() const noexcept { return m_iterations; }

private:
  struct Work;

  std::unique_ptr<Work> m_work;
  Vector m_root; ///< M^1/2
  std::size_t m_count = 0;
  std::vector<double> m_lambda;
  Vector m_solution = Vector::Zero();
  int m_iterations = 0;
};

/// Six degrees of freedom of a rigid body.
class ContactQp : public BasicContactQp<6>
{
public:
  using Vector6 = Vector;
  using BasicContactQp::BasicContactQp;
};

/// The same with six more unknowns s, each of stiffness 1: the compression of a spring shared by
/// several rows. A row J a + e s >= b of spring k has e = 1/sqrt(k); the sum of lambda over its
/// rows is then k times the largest b - J a, regardless of the number of rows.
constexpr int kMaxSprings = 6;
using SharedContactQp = BasicContactQp<6 + kMaxSprings>;

} // namespace petrous::haptics
