#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "petrous/Core/PatientBox.h"

namespace petrous::core
{

using Index3 = std::array<int, 3>;

/// A half-open box of voxel indices: lower <= index < upper on each axis.
struct IndexBox
{
  Index3 lower{0, 0, 0};
  Index3 upper{0, 0, 0};

  bool empty() const noexcept
  {
    return upper[0] <= lower[0] || upper[1] <= lower[1] || upper[2] <= lower[2];
  }
  Index3 size() const noexcept
  {
    if (empty())
      return {0, 0, 0};
    return {upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]};
  }
  std::size_t count() const noexcept
  {
    const Index3 s = size();
    return static_cast<std::size_t>(s[0]) * static_cast<std::size_t>(s[1]) *
           static_cast<std::size_t>(s[2]);
  }
  bool contains(const Index3& index) const noexcept
  {
    for (std::size_t a = 0; a < 3; ++a)
      if (index[a] < lower[a] || index[a] >= upper[a])
        return false;
    return true;
  }
  IndexBox intersected(const IndexBox& other) const noexcept
  {
    IndexBox result;
    for (std::size_t a = 0; a < 3; ++a)
    {
      result.lower[a] = std::max(lower[a], other.lower[a]);
      result.upper[a] = std::min(upper[a], other.upper[a]);
    }
    return result.empty() ? IndexBox{} : result;
  }
  IndexBox united(const IndexBox& other) const noexcept; ///< an empty box is neutral
};
bool operator==(const IndexBox& a, const IndexBox& b) noexcept;

/// Image geometry of a voxel grid in patient space (LPS, mm).
///
///   p_P = origin + direction * diag(spacing) * index       (X_PV with scale; DICOM C.7.6.2.1.1)
///
/// Voxel coordinates are continuous, with integers at voxel centres; the first axis is contiguous
/// in memory. Rendering and haptics are defined on the hull of the voxel centres. Immutable. What
/// is called for every voxel or sample is inline.
class GridGeometry
{
public:
  /// One voxel of 1 mm at the origin.
  GridGeometry();

  /// dims      samples along each axis, >= 1
  /// spacing   mm, > 0
  /// origin    patient position of the first voxel's centre, LPS mm
  /// direction columns are the axes; orthonormal within 1e-4 (left-handed is allowed)
  ///
  /// Throws InvalidParameter naming the first invalid value.
  GridGeometry(const Index3& dims, const Eigen::Vector3d& spacing, const Eigen::Vector3d& origin,
               const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity());

  const Index3& dims() const noexcept { return m_dims; }
  const Eigen::Vector3d& spacing() const noexcept { return m_spacing; }
  const Eigen::Vector3d& origin() const noexcept { return m_origin; }
  const Eigen::Matrix3d& direction() const noexcept { return m_direction; }

  std::size_t voxelCount() const noexcept { return fullBox().count(); }
  std::size_t linearIndex(int i, int j, int k) const noexcept
  {
    const auto nx = static_cast<std::size_t>(m_dims[0]);
    const auto ny = static_cast<std::size_t>(m_dims[1]);
    return static_cast<std::size_t>(i) +
           nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
  }
  double minSpacing() const noexcept { return m_spacing.minCoeff(); }
  double voxelVolume() const noexcept ///< mm^3
  {
    return m_spacing.prod();
  }

  Eigen::Vector3d patientFromVoxel(const Eigen::Vector3d& voxel) const noexcept
  {
    return m_origin + m_patientFromVoxel * voxel;
  }
  Eigen::Vector3d voxelFromPatient(const Eigen::Vector3d& patient) const noexcept
  {
    return m_voxelFromPatient * (patient - m_origin);
  }

  /// d patient / d voxel (mm per voxel), and its inverse.
  const Eigen::Matrix3d& patientFromVoxelLinear() const noexcept { return m_patientFromVoxel; }
  const Eigen::Matrix3d& voxelFromPatientLinear() const noexcept { return m_voxelFromPatient; }

  /// Whether a continuous voxel position lies in the hull of the voxel centres.
  bool hullContains(const Eigen::Vector3d& voxel) const noexcept
  {
    for (int a = 0; a < 3; ++a)
      if (!(voxel[a] >= -kVoxelSlack &&
            voxel[a] <= m_dims[static_cast<std::size_t>(a)] - 1 + kVoxelSlack))
        return false;
    return true;
  }

  Eigen::Vector3d center() const noexcept; ///< centre of the hull, patient LPS mm

  /// The smallest patient box around the hull.
  PatientBox patientBounds() const noexcept;

  IndexBox fullBox() const noexcept { return {{0, 0, 0}, m_dims}; }

  /// The smallest index box whose hull covers the part of the patient box [lower, upper] inside the
  /// grid; empty if they do not intersect.
  IndexBox boxCovering(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const noexcept;

  /// The grid cropped to a box. Throws InvalidParameter if the box is empty or exceeds the grid.
  GridGeometry cropped(const IndexBox& box) const;

private:
  /// Rounding tolerance when a position is compared with a voxel centre, in voxels.
  static constexpr double kVoxelSlack = 1e-9;

  Index3 m_dims;
  Eigen::Vector3d m_spacing;
  Eigen::Vector3d m_origin;
  Eigen::Matrix3d m_direction;
  Eigen::Matrix3d m_patientFromVoxel;
  Eigen::Matrix3d m_voxelFromPatient;
};

/// True if dims are equal and every corner agrees within `tolerance` mm.
bool sameGrid(const GridGeometry& a, const GridGeometry& b, double tolerance = 1e-3) noexcept;

} // namespace petrous::core
