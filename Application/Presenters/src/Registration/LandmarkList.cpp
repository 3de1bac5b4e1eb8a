#include "petrous/Presenters/LandmarkList.h"

namespace petrous::presenters
{

void LandmarkList::addCt(const Eigen::Vector3d& point)
{
  if (waitsForMr())
    m_rows.back().ct = point;
  else
    m_rows.push_back({point, std::nullopt});
}

void LandmarkList::addMr(const Eigen::Vector3d& point)
{
  if (waitsForMr())
    m_rows.back().mr = point;
}

void LandmarkList::remove(std::size_t row)
{
  if (row < m_rows.size())
    m_rows.erase(m_rows.begin() + static_cast<std::ptrdiff_t>(row));
}

void LandmarkList::moveMr(const core::GridGeometry& from, const core::GridGeometry& to)
{
  for (Row& row : m_rows)
    if (row.mr)
      row.mr = to.patientFromVoxel(from.voxelFromPatient(*row.mr));
}

std::optional<double> LandmarkList::residual(std::size_t row,
                                             const core::RigidTransform& mrFromCt) const
{
  if (row >= m_rows.size() || !m_rows[row].mr)
    return std::nullopt;
  return (mrFromCt * m_rows[row].ct - *m_rows[row].mr).norm();
}

} // namespace petrous::presenters
