#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

/// Rows n y >= b in the space where the coupling's stiffness is 1, scaled to unit length (a row of
/// zeros stays one). Structure of arrays: a look at every row is one pass of packet arithmetic.
struct WhitenedRows
{
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  // Lengths beyond this, or below its inverse, would overflow when squared.
  static constexpr double kLongest = 1e100;

  explicit WhitenedRows(std::size_t capacity);

  /// Adds a row, whose place is among the caller's rows `row`; there must be room. False when the
  /// scaled numbers are not finite.
  bool add(const Vector6& whitened, double limit, std::size_t callersRow) noexcept;

  Vector6 normalOf(Eigen::Index i) const noexcept { return normal.row(i).transpose(); }

  /// n d for every row, as an expression.
  auto along(const Vector6& d) const noexcept
  {
    return normal.col(0).head(count) * d[0] + normal.col(1).head(count) * d[1] +
           normal.col(2).head(count) * d[2] + normal.col(3).head(count) * d[3] +
           normal.col(4).head(count) * d[4] + normal.col(5).head(count) * d[5];
  }

  void measure(const Vector6& y) noexcept { slack.head(count) = along(y) - bound.head(count); }

  Eigen::Index count = 0;
  Eigen::Array<double, Eigen::Dynamic, 6> normal;
  Eigen::ArrayXd bound;
  Eigen::ArrayXd slack;         ///< n y - b where it was measured last
  std::vector<double> length;   ///< of the row before it was scaled
  std::vector<std::size_t> row; ///< as the caller counts
};

} // namespace petrous::haptics
