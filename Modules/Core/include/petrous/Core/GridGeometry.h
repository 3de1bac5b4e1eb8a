#pragma once

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

  bool empty() const noexcept;
  Index3 size() const noexcept;
  std::size_t count() const noexcept;
  bool contains(const Index3& index) const noexcept;
  IndexBox intersected(const IndexBox& other) const noexcept;
  IndexBox united(const IndexBox& other) const noexcept; ///< an empty box is neutral
};
bool operator==(const IndexBox& a, const IndexBox& b) noexcept;

/// Image geometry of a voxel grid in patient space (LPS, mm).
///
///   p_P = origin + direction * diag(spacing) * index       (X_PV with scale; DICOM C.7.6.2.1.1)
///
/// Voxel coordinates are continuous, with integers at voxel centres; the first axis is contiguous
/// in memory. Rendering and haptics are defined on the hull of the voxel centres. Immutable.
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

  std::size_t voxelCount() const noexcept;
  std::size_t linearIndex(int i, int j, int k) const noexcept;
  double minSpacing() const noexcept { return m_spacing.minCoeff(); }
  double voxelVolume() const noexcept ///< mm^3
  {
    return m_spacing.prod();
  }

  Eigen::Vector3d patientFromVoxel(const Eigen::Vector3d& voxel) const noexcept;
  Eigen::Vector3d voxelFromPatient(const Eigen::Vector3d& patient) const noexcept;

  /// d patient / d voxel (mm per voxel), and its inverse.
  const Eigen::Matrix3d& patientFromVoxelLinear() const noexcept { return m_patientFromVoxel; }
  const Eigen::Matrix3d& voxelFromPatientLinear() const noexcept { return m_voxelFromPatient; }

  /// Whether a continuous voxel position lies in the hull of the voxel centres.
  bool hullContains(const Eigen::Vector3d& voxel) const noexcept;

  Eigen::Vector3d center() const noexcept; ///< centre of the hull, patient LPS mm

  /// The smallest patient box around the hull.
  PatientBox patientBounds() const noexcept;

  IndexBox fullBox() const noexcept;

  /// The smallest index box whose hull covers the part of the patient box [lower, upper] inside the
  /// grid; empty if they do not intersect.
  IndexBox boxCovering(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const noexcept;

  /// The grid cropped to a box. Throws InvalidParameter if the box is empty or exceeds the grid.
  GridGeometry cropped(const IndexBox& box) const;

private:
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
