#pragma once

#include <memory>

#include "petrous/Haptics/ContactQp.h"

namespace petrous::haptics
{

/// A tool's contact problem: rigid rows, and rows of soft structures, each of which is one spring
/// that its rows share
///
///   a, s = argmin 1/2 (a - u)^T M (a - u) + sum 1/2 k_j s_j^2
///   subject to J_i a >= b_i (rigid),   J_i a + s_j >= depth_i (soft, of structure j)
///
/// so that at the solution s_j is what is left of the structure's greatest depth, and lambda over
/// its rows adds up to k_j s_j, however many rows there are.
///
/// Where a scene has no soft structure this is ContactQp, and costs what that costs. Memory is made
/// by the constructor; nothing else allocates or throws.
class ProxyQp
{
public:
  using Vector6 = ContactQp::Vector6;
  using Status = ContactQp::Status;

  /// `soft`: rows of soft structures may come. Throws InvalidParameter as ContactQp does.
  ProxyQp(std::size_t capacity, const Vector6& stiffness, bool soft);

  void clear() noexcept;
  std::size_t count() const noexcept { return m_shared ? m_shared->count() : m_rigid.count(); }

  /// False, and nothing is added, where ContactQp::add says so.
  bool add(const Vector6& row, double bound) noexcept;

  /// spring  which structure, below kMaxSprings
  /// give    1 / sqrt(k), k in N/mm; the same for every row of a structure
  bool addSoft(const Vector6& row, double depth, std::size_t spring, double give) noexcept;

  Status solve(const Vector6& unconstrained) noexcept;
  Vector6 solution() const noexcept; ///< of the last solve, as ContactQp's
  double lambda(std::size_t row) const noexcept
  {
    return m_shared ? m_shared->lambda(row) : m_rigid.lambda(row);
  }

private:
  ContactQp m_rigid;
  std::unique_ptr<SharedContactQp> m_shared; // instead of m_rigid, where rows may be soft
};

} // namespace petrous::haptics
