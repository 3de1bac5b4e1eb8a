#include "petrous/Haptics/ProxyQp.h"

namespace petrous::haptics
{

namespace
{

SharedContactQp::Vector extended(const ContactQp::Vector6& six, double others)
{
  SharedContactQp::Vector result = SharedContactQp::Vector::Constant(others);
  result.head<ContactQp::kSize>() = six;
  return result;
}

} // namespace

ProxyQp::ProxyQp(std::size_t capacity, const Vector6& stiffness, bool soft)
  : m_rigid(capacity, stiffness)
{
  if (soft)
    m_shared = std::make_unique<SharedContactQp>(capacity, extended(stiffness, 1.0));
}

void ProxyQp::clear() noexcept
{
  if (m_shared)
    m_shared->clear();
  else
    m_rigid.clear();
}

bool ProxyQp::add(const Vector6& row, double bound) noexcept
{
  return m_shared ? m_shared->add(extended(row, 0.0), bound) : m_rigid.add(row, bound);
}

// The unknown is sqrt(k) s, half the square of which is the spring's energy.
bool ProxyQp::addSoft(const Vector6& row, double depth, std::size_t spring, double give) noexcept
{
  if (!m_shared || spring >= kMaxSprings)
    return false;
  SharedContactQp::Vector all = extended(row, 0.0);
  all[ContactQp::kSize + static_cast<Eigen::Index>(spring)] = give;
  return m_shared->add(all, depth);
}

ProxyQp::Status ProxyQp::solve(const Vector6& unconstrained) noexcept
{
  if (!m_shared)
    return m_rigid.solve(unconstrained);
  switch (m_shared->solve(extended(unconstrained, 0.0)))
  {
  case SharedContactQp::Status::Solved:
    return Status::Solved;
  case SharedContactQp::Status::Infeasible:
    return Status::Infeasible;
  case SharedContactQp::Status::Exhausted:
    break;
  }
  return Status::Exhausted;
}

ProxyQp::Vector6 ProxyQp::solution() const noexcept
{
  return m_shared ? Vector6(m_shared->solution().head<ContactQp::kSize>()) : m_rigid.solution();
}

} // namespace petrous::haptics
