#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::volume::test
{

/// A head of simple bodies in HU, LPS mm: cranium, jaw, neck, nose, brows, orbits' hollows, lips,
/// auricles, a skull 6 mm below the skin, in air with noise. The tip of the nose is at (0, -105,
/// 0), the line of the ears at y = 0, z = 15.
class SyntheticHead
{
public:
  /// pitch: degrees, positive lowers the chin.
  explicit SyntheticHead(double pitch = 0.0)
    : m_turn(Eigen::AngleAxisd(pitch * 3.14159265358979 / 180.0, Eigen::Vector3d::UnitX()))
  {
  }

  /// Turned: the patient's axes from the head's own.
  explicit SyntheticHead(const Eigen::Matrix3d& turn)
    : m_turn(turn)
  {
  }

  double hounsfield(const Eigen::Vector3d& patient) const
  {
    const Eigen::Vector3d p = own(patient);
    if (std::abs(p.x()) > 96.0 || std::abs(p.y()) > 112.0 || p.z() > 140.0) // far off
      return -1000.0;
    const double deep = solid(p);
    const double within = std::clamp(0.5 - withEars(p, deep), 0.0, 1.0); // over 1 mm
    const double tissue = deep < -6.0 && deep > -12.0 ? 900.0 : 40.0;
    return -1000.0 + within * (tissue + 1000.0);
  }

  Eigen::Vector3d noseTip() const { return placed({0.0, -105.0, 0.0}); }
  Eigen::Vector3d earLine() const { return placed({0.0, 0.0, 15.0}); }
  /// From the head's own axes to the patient's.
  Eigen::Vector3d placed(const Eigen::Vector3d& own) const { return m_turn * own; }

private:
  Eigen::Vector3d own(const Eigen::Vector3d& patient) const { return m_turn.inverse() * patient; }

  static double withEars(const Eigen::Vector3d& p, double d)
  {
    if (std::abs(p.x()) > 60.0)
      d = std::min(
          d, ellipsoid({std::abs(p.x()), p.y(), p.z()}, {80.0, 8.0, 12.0}, {14.0, 5.0, 30.0}));
    return d;
  }

  // Negative inside; about the distance near the surface, mm.
  static double ellipsoid(const Eigen::Vector3d& p, const Eigen::Vector3d& center,
                          const Eigen::Vector3d& radii)
  {
    const Eigen::Vector3d q = (p - center).cwiseQuotient(radii);
    const double length = q.norm();
    const double slope = q.cwiseQuotient(radii).norm();
    return slope > 0.0 ? length * (length - 1.0) / slope : -radii.minCoeff();
  }

  double solid(const Eigen::Vector3d& p) const
  {
    double d = ellipsoid(p, {0, 2, 50}, {74, 94, 88});          // cranium
    d = std::min(d, ellipsoid(p, {0, -38, -25}, {58, 50, 75})); // face
    d = std::min(d, ellipsoid(p, {0, -72, -68}, {22, 20, 16})); // chin
    d = std::min(d, ellipsoid(p, {0, -85, 4}, {14, 20, 11}));   // nose
    d = std::min(d, ellipsoid(p, {0, -84, 28}, {7, 9, 22}));    // its bridge
    d = std::min(d, ellipsoid(p, {0, -84, -32}, {24, 9, 8}));   // lips
    for (const double side : {-1.0, 1.0})
    {
      d = std::min(d, ellipsoid(p, {side * 30, -74, 52}, {26, 18, 8}));   // brow
      d = std::max(d, -ellipsoid(p, {side * 32, -92, 30}, {17, 16, 11})); // orbit
    }
    return std::min(d, std::max(ellipsoid({p.x(), p.y(), 0.0}, {0, 5, 0}, {55, 55, 55}),
                                p.z() + 30.0)); // neck
  }

  Eigen::Quaterniond m_turn;
};

/// The grid of `spacing` along its axes that covers a patient box; the axes are the columns of
/// `direction`.
inline core::GridGeometry gridOver(const core::PatientBox& box, const Eigen::Vector3d& spacing,
                                   const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity())
{
  core::PatientBox along; // in the grid's axes
  for (int corner = 0; corner < 8; ++corner)
    along.extend(direction.transpose() *
                 box.corner(static_cast<core::PatientBox::CornerType>(corner)));
  core::Index3 dims{};
  for (std::size_t a = 0; a < 3; ++a)
    dims[a] = 1 + static_cast<int>(along.sizes()[static_cast<Eigen::Index>(a)] /
                                   spacing[static_cast<Eigen::Index>(a)]);
  return core::GridGeometry(dims, spacing, direction * along.min(), direction);
}

/// Noise of +-30 HU that is the same in every run, as an MR: of other units, above 0.
inline std::shared_ptr<const Volume<std::int16_t>>
scanned(const SyntheticHead& head, const core::GridGeometry& grid, bool asMr = false)
{
  auto voxels = std::make_shared<Volume<std::int16_t>>(grid);
  const core::Index3 n = grid.dims();
  std::uint32_t state = 12345;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        state = state * 1664525U + 1013904223U;
        const double noise = static_cast<double>(state >> 8U) / (1U << 24U) * 60.0 - 30.0;
        double value = head.hounsfield(grid.patientFromVoxel(Eigen::Vector3d(i, j, k)));
        if (asMr) // bone is dark
          value = value > 100.0 ? 40.0 : (value + 1000.0) * 0.3 + 35.0 + 0.3 * noise;
        else
          value += noise;
        voxels->at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
      }
  return voxels;
}

/// All of the head.
inline core::PatientBox headBox()
{
  return {Eigen::Vector3d(-105, -135, -125), Eigen::Vector3d(105, 115, 150)};
}

} // namespace petrous::volume::test
