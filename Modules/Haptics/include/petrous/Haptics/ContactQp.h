#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

class ActiveRows;

/// Motion of a constrained body: Gauss' principle with gaps [Chan2016, Eq. 1 put right]
///
///   a = argmin 1/2 (a - u)^T M (a - u)   subject to   J_i a + c_i lambda_i >= b_i,  lambda >= 0
///
/// a, u   6-vectors: translation mm, rotation rad
/// M      diagonal, > 0: the coupling's stiffness, N/mm and N mm/rad; then M (a - u) = J^T lambda
///        is the wrench on the hand, and lambda_i the thrust at contact i, N
/// J_i    row of contact i: (n, r x n), n the unit normal out of the tissue, r the lever arm, mm
/// b_i    -gap, mm (> 0 only where the contact is violated already)
/// c_i    compliance of the tissue, mm/N; 0 rigid
///
/// Rigid rows: dual active set (Goldfarb and Idnani 1983, doi 10.1007/BF02591962) in the space
/// whitened by M, at most six rows at a time. Compliant rows are springs, of which any number may
/// press: without lambda they add max(0, b_i - J_i a)^2 / (2 c_i) to the objective, a piecewise
/// quadratic that Newton's method with exact line search minimises in finitely many steps (J. Sun
/// 1997, Mathematical Programming 76, 451), each of them a problem with rigid rows only.
///
/// The solution a is unique. Where rigid rows depend on each other lambda is not, and one of the
/// possible is given. The same rows in the same order give the same bits.
///
/// One problem a tick. Memory is made by the constructor; nothing else allocates or throws.
class ContactQp
{
public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  enum class Status
  {
    Solved,
    Infeasible, ///< the rows contradict each other; a = 0, lambda = 0
    Exhausted   ///< iteration limit, or u not finite; a = 0, lambda = 0
  };

  /// Throws InvalidParameter when capacity is 0 or an entry of `stiffness` is not above 0.
  ContactQp(std::size_t capacity, const Vector6& stiffness);

  void clear() noexcept;
  std::size_t count() const noexcept { return m_count; }

  /// Adds a row; false, and nothing is added, when the capacity is reached, a number is not finite
  /// or the compliance is below 0. A compliance under 1e-9 of the coupling's counts as rigid.
  bool add(const Vector6& row, double bound, double compliance = 0.0) noexcept;

  Status solve(const Vector6& unconstrained) noexcept;

  /// Of the last solve.
  const Vector6& solution() const noexcept { return m_solution; }

  /// Of the last solve; `row` counts the rows in the order in which they were added.
  double lambda(std::size_t row) const noexcept { return m_lambda[row]; }

  /// Rigid rows taken into or out of the active set, and Newton steps.
  int iterations() const noexcept { return m_iterations; }

private:
  /// Rows of one kind in the whitened space y = M^1/2 a, scaled to unit length (a row of zeros
  /// stays one). Structure of arrays: a look at every row is one pass of packet arithmetic.
  struct Rows
  {
    explicit Rows(std::size_t capacity);
    bool add(const Vector6& whitened, double bound, double compliance, std::size_t row) noexcept;
    void measure(const Vector6& y) noexcept; ///< slack = normal y - bound
    void along(const Vector6& d) noexcept;
    Vector6 normalOf(Eigen::Index i) const noexcept { return normal.row(i).transpose(); }

    Eigen::Index count = 0;
    Eigen::Array<double, Eigen::Dynamic, 6> normal;
    Eigen::ArrayXd bound;
    Eigen::ArrayXd slack;
    Eigen::ArrayXd spring;        ///< 1 / compliance; 0 for a rigid row
    Eigen::ArrayXd weight;        ///< the spring's where the row is taken to press, else 0
    Eigen::ArrayXd rate;          ///< of the slack along a line
    std::vector<double> length;   ///< of the whitened row before it was scaled
    std::vector<std::size_t> row; ///< as counted by the caller
  };

  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  bool relax(const Vector6& v, Vector6& y) noexcept;
  void takeRoot() noexcept;
  Matrix6 m_hessian;
  Status minimise(ActiveRows& active, Vector6& y) noexcept;
  Status takeIn(Eigen::Index row, double slack, ActiveRows& active, Vector6& y) noexcept;
  void takeModel(const Vector6& v, Vector6& y) noexcept;
  double lineSearch(const Vector6& v, const Vector6& y, const Vector6& d) noexcept;
  bool takePressing() noexcept;
  void refine(const Vector6& v, Vector6& y, ActiveRows& active) noexcept;

  Vector6 m_root; ///< M^1/2
  Rows m_rigid;
  Rows m_soft;
  Matrix6 m_inverseRoot = Matrix6::Identity(); ///< W with W^T W = H^-1, H the model's Hessian
  std::vector<Eigen::Index> m_skipped;         ///< rigid rows that depend on the active ones
  std::size_t m_skippedCount = 0;
  std::size_t m_count = 0;
  double m_highest = 0.0; ///< largest bound above 0, whitened
  double m_energy = 0.0;
  double m_scale = 0.0;   ///< what the tolerances of a problem are relative to, whitened
  std::vector<double> m_lambda;
  Vector6 m_solution = Vector6::Zero();
  int m_iterations = 0;
};

} // namespace petrous::haptics
