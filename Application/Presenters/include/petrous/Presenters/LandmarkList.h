#pragma once

#include <optional>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/RigidTransform.h"

namespace petrous::presenters
{

/// Corresponding points marked by the user in both images, patient LPS mm of each. The last may
/// still lack its MR point.
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

  void addCt(const Eigen::Vector3d& point); ///< replaces a row that still lacks its MR point
  void addMr(const Eigen::Vector3d& point); ///< of the row that lacks it, if any
  void remove(std::size_t row);             ///< no effect if there is no such row
  /// The MR's image came to lie elsewhere in its own space: from one grid of its voxels to another.
  void moveMr(const core::GridGeometry& from, const core::GridGeometry& to);
  void clear() { m_rows.clear(); }

  /// Landmark residual: distance in the MR between the mapped CT point and the MR point, mm; none
  /// without an MR point.
  std::optional<double> residual(std::size_t row, const core::RigidTransform& mrFromCt) const;

private:
  std::vector<Row> m_rows;
};

} // namespace petrous::presenters
