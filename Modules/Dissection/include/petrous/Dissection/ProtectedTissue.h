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

/// Structures excluded from drilling, as smoothed unions (SmoothedUnion.h).
class ProtectedTissue
{
public:
  using Occupancy = std::shared_ptr<const volume::Volume<float>>;
  using Prepare = std::function<void(const std::vector<core::PatientBox>&)>;

  ProtectedTissue() = default;
  ProtectedTissue(std::initializer_list<Occupancy> occupancies)
    : m_occupancies(occupancies)
  {
  }
  explicit ProtectedTissue(std::vector<Occupancy> occupancies, Prepare prepare = {})
    : m_occupancies(std::move(occupancies))
    , m_prepare(std::move(prepare))
  {
  }

  bool empty() const noexcept { return m_occupancies.empty(); }
  std::size_t size() const noexcept { return m_occupancies.size(); }
  auto begin() const noexcept { return m_occupancies.begin(); }
  auto end() const noexcept { return m_occupancies.end(); }
  const std::vector<Occupancy>& occupancies() const noexcept { return m_occupancies; }

  /// To be called with the region before the occupancies there are read: they may be computed on
  /// demand (volume::RegionalUnion). Patient LPS mm.
  void prepare(const core::PatientBox& box) const
  {
    if (m_prepare)
      m_prepare({box});
  }

private:
  std::vector<Occupancy> m_occupancies;
  Prepare m_prepare;
};

} // namespace petrous::dissection
