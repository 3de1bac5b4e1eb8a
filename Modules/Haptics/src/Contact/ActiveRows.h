#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

namespace petrous::haptics
{

/// The active rows (those that hold at equality), each n y + c multiplier = b with the same minute
/// compliance c, and their multipliers.
///
/// A row is the vector (n, sqrt(c) e) of N + size() components, e the unit vector of an axis of its
/// own, so that rows are always linearly independent. They are stored as N^T = Q R: Q has
/// orthonormal columns, R is upper triangular, column j of N^T is the j-th row. Of each column of
/// Q, `head` is the part in the N axes, `tail` the part in the rows' own axes.
template <int N>
class ActiveRows
{
public:
  static constexpr int kMax = N + 6; ///< N, plus a few that are nearly dependent on those

  using Vector = Eigen::Matrix<double, N, 1>;
  using Coefficients = std::array<double, kMax>; // the first size() are valid

  /// Component of a new row orthogonal to the active ones: head, tail, and sqrt(c) in its own axis.
  struct Rest
  {
    Vector head;
    Coefficients tail;
    double square = 0.0; ///< squared length, > 0
  };

  explicit ActiveRows(double compliance)
    : m_compliance(compliance)
  {
  }

  int size() const noexcept { return m_size; }
  void clear() noexcept { m_size = 0; }
  Eigen::Index row(int j) const noexcept { return m_row[j]; }
  double& multiplier(int j) noexcept { return m_multiplier[j]; }
  double multiplier(int j) const noexcept { return m_multiplier[j]; }

  /// (n, sqrt(c) e) = Q d + rest. Orthogonalised twice: a single pass leaves an error of eps |n| /
  /// |rest| in the direction of a short rest.
  Rest split(const Vector& n, Coefficients& d) const noexcept
  {
    Rest rest;
    rest.head = n;
    for (int i = 0; i < m_size; ++i)
      rest.tail[i] = 0.0;
    for (int j = 0; j < m_size; ++j)
      d[j] = takeOut(j, rest);
    for (int j = 0; j < m_size; ++j)
      d[j] += takeOut(j, rest);
    rest.square = rest.head.squaredNorm() + m_compliance;
    for (int i = 0; i < m_size; ++i)
      rest.square += rest.tail[i] * rest.tail[i];
    return rest;
  }

  /// R x = d
  Coefficients solve(const Coefficients& d) const noexcept
  {
    Coefficients x;
    for (int i = m_size - 1; i >= 0; --i)
    {
      double sum = d[i];
      for (int j = i + 1; j < m_size; ++j)
        sum -= m_r[j][i] * x[j];
      x[i] = sum / m_r[i][i];
    }
    return x;
  }

  /// R^T x = b
  Coefficients solveTransposed(const Coefficients& b) const noexcept
  {
    Coefficients x;
    for (int i = 0; i < m_size; ++i)
    {
      double sum = b[i];
      for (int j = 0; j < i; ++j)
        sum -= m_r[i][j] * x[j];
      x[i] = sum / m_r[i][i];
    }
    return x;
  }

  /// Q^T (n, 0)
  Coefficients alongQ(const Vector& n) const noexcept
  {
    Coefficients d;
    for (int j = 0; j < m_size; ++j)
      d[j] = m_head[j].dot(n);
    return d;
  }

  /// Adds the row decomposed by `split`; there must be room.
  void push(Eigen::Index row, const Coefficients& d, const Rest& rest, double multiplier) noexcept
  {
    const int k = m_size;
    const double length = std::sqrt(rest.square);
    for (int i = 0; i < k; ++i)
    {
      m_r[k][i] = d[i];
      m_tail[k][i] = rest.tail[i] / length;
      m_tail[i][k] = 0.0;
    }
    m_r[k][k] = length;
    m_head[k] = rest.head / length;
    m_tail[k][k] = std::sqrt(m_compliance) / length;
    m_row[k] = row;
    m_multiplier[k] = multiplier;
    ++m_size;
  }

  /// Removes the j-th row; Givens rotations make R triangular again. The row's own axis is dropped
  /// as well: the remaining rows have no component along it.
  void drop(int j) noexcept
  {
    --m_size;
    for (int k = j; k < m_size; ++k)
    {
      m_r[k] = m_r[k + 1];
      m_row[k] = m_row[k + 1];
      m_multiplier[k] = m_multiplier[k + 1];
    }
    for (int k = 0; k <= m_size; ++k)
      for (int i = j; i < m_size; ++i)
        m_tail[k][i] = m_tail[k][i + 1];
    for (int i = j; i < m_size; ++i)
    {
      const double length = std::hypot(m_r[i][i], m_r[i][i + 1]);
      const double c = m_r[i][i] / length;
      const double s = m_r[i][i + 1] / length;
      for (int k = i; k < m_size; ++k)
        rotate(c, s, m_r[k][i], m_r[k][i + 1]);
      for (int k = 0; k < N; ++k)
        rotate(c, s, m_head[i][k], m_head[i + 1][k]);
      for (int k = 0; k < m_size; ++k)
        rotate(c, s, m_tail[i][k], m_tail[i + 1][k]);
    }
  }

private:
  double takeOut(int j, Rest& rest) const noexcept
  {
    double along = m_head[j].dot(rest.head);
    for (int i = 0; i < m_size; ++i)
      along += m_tail[j][i] * rest.tail[i];
    rest.head -= along * m_head[j];
    for (int i = 0; i < m_size; ++i)
      rest.tail[i] -= along * m_tail[j][i];
    return along;
  }

  static void rotate(double c, double s, double& a, double& b) noexcept
  {
    const double first = c * a + s * b;
    b = c * b - s * a;
    a = first;
  }

  double m_compliance;
  int m_size = 0;
  std::array<Vector, kMax> m_head;
  std::array<Coefficients, kMax> m_tail;
  std::array<Coefficients, kMax> m_r; // columns of R
  std::array<Eigen::Index, kMax> m_row{};
  Coefficients m_multiplier{};
};

} // namespace petrous::haptics
