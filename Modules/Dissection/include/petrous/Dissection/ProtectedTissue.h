#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "petrous/Core/PatientBox.h"
#include "petrous/Volume/Volume.h"

namespace petrous::dissection
{

/// Structures that the drill must leave: their smoothed unions (SmoothedUnion.h).
class ProtectedTissue
{
public:
  using Share = std::shared_ptr<const volume::Volume<float>>;
  using Prepare = std::function<void(const std::vector<core::PatientBox>&)>;

  ProtectedTissue() = default;
  ProtectedTissue(std::initializer_list<Share> shares)
    : m_shares(shares)
  {
  }
  explicit ProtectedTissue(std::vector<Share> shares, Prepare prepare = {})
    : m_shares(std::move(shares))
    , m_prepare(std::move(prepare))
  {
  }

  bool empty() const noexcept { return m_shares.empty(); }
  std::size_t size() const noexcept { return m_shares.size(); }
  auto begin() const noexcept { return m_shares.begin(); }
  auto end() const noexcept { return m_shares.end(); }
  const std::vector<Share>& shares() const noexcept { return m_shares; }

  /// Whoever drills says so where, before the shares there are read: they may be worked out only
  /// then (volume::RegionalUnion). Patient LPS mm.
  void prepare(const core::PatientBox& box) const
  {
    if (m_prepare)
      m_prepare({box});
  }

private:
  std::vector<Share> m_shares;
  Prepare m_prepare;
};

} // namespace petrous::dissection
