#pragma once

#include <optional>
#include <vector>

#include "petrous/Core/RigidTransform.h"

namespace petrous::presenters
{

/// Points that a person sees in both images, patient LPS mm of each. The last may wait for its MR
/// point.
class LandmarkList
{
public:
  struct Row
  {
    Eigen::Vector3d ct;
    std::optional<Eigen::Vector3d> mr;
  };

  const std::vector<Row>& rows() const noexcept { return m_rows; }
  bool waitsForMr() const noexcept { return !m_rows.empty() && !m_rows.back().mr; }
  std::size_t pairs() const noexcept { return m_rows.size() - (waitsForMr() ? 1U : 0U); }

  void addCt(const Eigen::Vector3d& point); ///< takes the place of one that still waits
  void addMr(const Eigen::Vector3d& point); ///< of the one that waits; nothing happens without
  void remove(std::size_t row);             ///< nothing happens where there is none
  void clear() { m_rows.clear(); }

  /// mm in the MR between where the row's CT point lands and its MR point; none while it waits.
  std::optional<double> residual(std::size_t row, const core::RigidTransform& mrFromCt) const;

private:
  std::vector<Row> m_rows;
};

} // namespace petrous::presenters
