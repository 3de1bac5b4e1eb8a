#pragma once

#include <memory>

#include "petrous/Haptics/ContactQp.h"

namespace petrous::haptics
{

/// Contact problem of a tool: rigid rows, and rows of soft structures; the rows of a structure
/// share one spring
///
///   a, s = argmin 1/2 (a - u)^T M (a - u) + sum 1/2 k_j s_j^2
///   subject to J_i a >= b_i (rigid),   J_i a + s_j >= depth_i (soft, of structure j)
///
/// so that at the solution s_j is the structure's remaining maximum depth, and lambda over its rows
/// sums to k_j s_j, regardless of the number of rows.
///
/// Without soft structures this is ContactQp, at the same cost. Only the constructor allocates or
/// throws.
class ProxyQp
{
public:
  using Vector6 = ContactQp::Vector6;
  using Status = ContactQp::Status;

  /// `soft`: rows of soft structures may be added. Throws InvalidParameter like ContactQp.
  ProxyQp(std::size_t capacity, const Vector6& stiffness, bool soft);

  void clear() noexcept;
  std::size_t count() const noexcept { return m_shared ? m_shared->count() : m_rigid.count(); }

  /// Returns false and adds nothing under the conditions of ContactQp::add.
  bool add(const Vector6& row, double bound) noexcept;

  /// spring  index of the structure, below kMaxSprings
  /// give    1 / sqrt(k), k in N/mm; the same for every row of a structure
  bool addSoft(const Vector6& row, double depth, std::size_t spring, double give) noexcept;

  Status solve(const Vector6& unconstrained) noexcept;
  Vector6 solution() const noexcept; ///< of the last solve, as in ContactQp
  double lambda(std::size_t row) const noexcept
  {
    return m_shared ? m_shared->lambda(row) : m_rigid.lambda(row);
  }
  int iterations() const noexcept
  {
    return m_shared ? m_shared->iterations() : m_rigid.iterations();
  }

private:
  ContactQp m_rigid;
  std::unique_ptr<SharedContactQp> m_shared; // replaces m_rigid if rows may be soft
};

} // namespace petrous::haptics
