#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "petrous/Haptics/HapticField.h"

namespace petrous::haptics
{

/// A ball filled evenly with points, and the force with which tissue pushes it towards its centre
/// [Chan2013, 2.3, after the point sampling of its reference 7].
///
/// The points are on concentric spheres, each the sphere of equal mean volume within its layer, in
/// Fibonacci spirals of opposite pairs; every sphere is rotated differently. No plane therefore
/// cuts many points at once, as with a lattice, and the push on a ball fully in tissue is zero.
///
/// Fixed to the patient's axes: a ball is rotationally symmetric. Const calls are thread-safe.
class BurrVolume
{
public:
  /// The field must outlive this. radius mm; count is approximate.
  BurrVolume(const HapticField& field, double radius, std::size_t count);

  const std::vector<Eigen::Vector3d>& points() const noexcept { return m_points; }
  double spacing() const noexcept { return m_spacing; } ///< edge of a point's cube, mm

  struct Push
  {
    Eigen::Vector3d sum{0.0, 0.0, 0.0}; ///< sum over the points of -s_i u_i, patient axes
    double depth = 0.0;                 ///< mm, R minus the distance from the centre to the nearest
                                        ///< rigid tissue found by a point
    std::size_t looked = 0;             ///< points examined
  };

  /// Push by rigid tissue; centre in patient coordinates, mm.
  Push push(const Eigen::Vector3d& centre, const volume::MaskState& mask) const noexcept;

private:
  double filled(const Eigen::Vector3d& voxel, const FieldSample& sample,
                const volume::MaskState& mask) const noexcept;
  double firstInside(const Eigen::Vector3d& centre, const Eigen::Vector3d& way,
                     const volume::MaskState& mask) const noexcept;

  const HapticField& m_field;
  double m_radius;
  double m_spacing = 0.0;
  std::vector<Eigen::Vector3d> m_points;  // from the centre, mm; inner ones first
  std::vector<Eigen::Vector3d> m_outward; // unit
  std::vector<Eigen::Vector3d> m_offsets; // in voxels
};

} // namespace petrous::haptics
