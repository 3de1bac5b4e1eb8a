#include "petrous/Core/GridGeometry.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/LU>

#include "petrous/Core/Error.h"

namespace petrous::core
{

namespace
{
// DICOM decimal strings keep six digits or more; beyond this the axes are skewed, not rounded.
constexpr double kOrthonormalTolerance = 1e-4;
} // namespace

IndexBox IndexBox::united(const IndexBox& other) const noexcept
{
  if (empty())
    return other;
  if (other.empty())
    return *this;
  IndexBox result;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] = std::min(lower[a], other.lower[a]);
    result.upper[a] = std::max(upper[a], other.upper[a]);
  }
  return result;
}

bool operator==(const IndexBox& a, const IndexBox& b) noexcept
{
  return a.lower == b.lower && a.upper == b.upper;
}

GridGeometry::GridGeometry()
  : GridGeometry({1, 1, 1}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero())
{
}

GridGeometry::GridGeometry(const Index3& dims, const Eigen::Vector3d& spacing,
                           const Eigen::Vector3d& origin, const Eigen::Matrix3d& direction)
  : m_dims(dims)
  , m_spacing(spacing)
  , m_origin(origin)
  , m_direction(direction)
{
  if (dims[0] < 1 || dims[1] < 1 || dims[2] < 1)
    throw InvalidParameter("grid: every dimension must be at least 1, not " +
                           std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
                           std::to_string(dims[2]));
  if (!spacing.allFinite() || spacing.minCoeff() <= 0.0)
    throw InvalidParameter("grid: the spacing must be finite and above 0 mm");
  if (!origin.allFinite())
    throw InvalidParameter("grid: the origin is not finite");
  if (!direction.allFinite() ||
      (direction.transpose() * direction - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() >
          kOrthonormalTolerance)
    throw InvalidParameter("grid: the direction cosines are not perpendicular unit vectors");
  m_patientFromVoxel = direction * spacing.asDiagonal();
  m_voxelFromPatient = m_patientFromVoxel.inverse();
}

Eigen::Vector3d GridGeometry::center() const noexcept
{
  return patientFromVoxel(0.5 * Eigen::Vector3d(m_dims[0] - 1.0, m_dims[1] - 1.0, m_dims[2] - 1.0));
}

PatientBox GridGeometry::patientBounds() const noexcept
{
  PatientBox bounds(m_origin);
  for (int corner = 1; corner < 8; ++corner)
    bounds.extend(patientFromVoxel({(corner & 1) ? m_dims[0] - 1.0 : 0.0,
                                    (corner & 2) ? m_dims[1] - 1.0 : 0.0,
                                    (corner & 4) ? m_dims[2] - 1.0 : 0.0}));
  return bounds;
}

IndexBox GridGeometry::boxCovering(const Eigen::Vector3d& lower,
                                   const Eigen::Vector3d& upper) const noexcept
{
  Eigen::Vector3d first = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d last = Eigen::Vector3d::Constant(-1e300);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d v =
        voxelFromPatient({(corner & 1) ? upper[0] : lower[0], (corner & 2) ? upper[1] : lower[1],
                          (corner & 4) ? upper[2] : lower[2]});
    first = first.cwiseMin(v);
    last = last.cwiseMax(v);
  }
  IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double end = m_dims[a] - 1.0;
    if (!(first[axis] <= end) || !(last[axis] >= 0.0))
      return {};
    box.lower[a] = static_cast<int>(std::floor(std::max(first[axis], 0.0) + kVoxelSlack));
    box.upper[a] = static_cast<int>(std::ceil(std::min(last[axis], end) - kVoxelSlack)) + 1;
  }
  return box;
}

GridGeometry GridGeometry::cropped(const IndexBox& box) const
{
  if (box.empty() || !(box.intersected(fullBox()) == box))
    throw InvalidParameter("grid: the box to crop to is empty or reaches outside the grid");
  const Eigen::Vector3d first(box.lower[0], box.lower[1], box.lower[2]);
  return {box.size(), m_spacing, patientFromVoxel(first), m_direction};
}

bool sameGrid(const GridGeometry& a, const GridGeometry& b, double tolerance) noexcept
{
  if (a.dims() != b.dims())
    return false;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d v((corner & 1) ? a.dims()[0] - 1.0 : 0.0,
                            (corner & 2) ? a.dims()[1] - 1.0 : 0.0,
                            (corner & 4) ? a.dims()[2] - 1.0 : 0.0);
    if (!((a.patientFromVoxel(v) - b.patientFromVoxel(v)).norm() <= tolerance))
      return false;
  }
  return true;
}

} // namespace petrous::core
