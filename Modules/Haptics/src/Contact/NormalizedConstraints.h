#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

/// Rows n y >= b in the space where the coupling's stiffness is 1, scaled to unit length (zero rows
/// stay zero). Structure of arrays: one vectorised pass evaluates all rows.
template <int N>
struct NormalizedConstraints
{
  using Vector = Eigen::Matrix<double, N, 1>;

  // Lengths above this or below its inverse would overflow when squared.
  static constexpr double kMaxLength = 1e100;

  explicit NormalizedConstraints(std::size_t capacity);

  /// Adds a row; `callersRow` is its index for the caller. There must be room. False if the scaled
  /// numbers are not finite.
  bool add(const Vector& whitened, double limit, std::size_t callersRow) noexcept;

  Vector normalOf(Eigen::Index i) const noexcept { return normal.row(i).transpose(); }

  /// n d for every row, as an expression template.
  auto along(const Vector& d) const noexcept { return along<N - 1>(d); }

  void measure(const Vector& y) noexcept { slack.head(count) = along(y) - bound.head(count); }

  Eigen::Index count = 0;
  Eigen::Array<double, Eigen::Dynamic, N> normal;
  Eigen::ArrayXd bound;
  Eigen::ArrayXd slack;         ///< n y - b as last measured
  std::vector<double> length;   ///< of the row before scaling
  std::vector<std::size_t> row; ///< caller's index

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
