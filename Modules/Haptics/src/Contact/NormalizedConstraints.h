#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

/// Rows n y >= b in the space where the coupling's stiffness is 1, scaled to unit length (a row of
/// zeros stays one). Structure of arrays: a look at every row is one pass of packet arithmetic.
template <int N>
struct NormalizedConstraints
{
  using Vector = Eigen::Matrix<double, N, 1>;

  // Lengths beyond this, or below its inverse, would overflow when squared.
  static constexpr double kMaxLength = 1e100;

  explicit NormalizedConstraints(std::size_t capacity);

  /// Adds a row, whose place is among the caller's rows `row`; there must be room. False when the
  /// scaled numbers are not finite.
  bool add(const Vector& whitened, double limit, std::size_t callersRow) noexcept;

  Vector normalOf(Eigen::Index i) const noexcept { return normal.row(i).transpose(); }

  /// n d for every row, as an expression.
  auto along(const Vector& d) const noexcept { return along<N - 1>(d); }

  void measure(const Vector& y) noexcept { slack.head(count) = along(y) - bound.head(count); }

  Eigen::Index count = 0;
  Eigen::Array<double, Eigen::Dynamic, N> normal;
  Eigen::ArrayXd bound;
  Eigen::ArrayXd slack;         ///< n y - b where it was measured last
  std::vector<double> length;   ///< of the row before it was scaled
  std::vector<std::size_t> row; ///< as the caller counts

private:
  template <int Last>
  auto along(const Vector& d) const noexcept
  {
    if constexpr (Last == 0)
      return normal.col(0).head(count) * d[0];
    else
      return along<Last - 1>(d) + normal.col(Last).head(count) * d[Last];
  }
};

} // namespace petrous::haptics
