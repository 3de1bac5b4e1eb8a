#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::dissection
{

/// What a burr takes of the voxels of a row (SweptSphereCut.h, `coverage`), and what it leaves as
/// the mask holds it. Whoever cuts and whoever reckons what a cut would take use this one piece of
/// arithmetic, so that both mean the same to the last bit. Single precision, relative to the burr:
/// the distance is right to 1e-6 mm.
class BurrCoverage
{
public:
  /// generous: for a way of which the burr will take only a part, never less than it takes of
  ///           that part.
  BurrCoverage(const SweptSphere& burr, const core::GridGeometry& grid, bool generous = false)
    : m_axis(along(grid, burr.to - burr.from))
    , m_spacing(grid.spacing().cast<float>())
    , m_radius(static_cast<float>(burr.radius))
    , m_halfWidth(static_cast<float>(grid.spacing().norm()))
    , m_bias((grid.spacing().cwiseAbs2() / 12.0).cast<float>())
    , m_biasLimit(static_cast<float>(0.25 * grid.minSpacing()))
    , m_from(grid.spacing().cwiseProduct(grid.voxelFromPatient(burr.from)))
  {
    const float square = m_axis.squaredNorm();
    m_perSquare = square > 0.0F ? 1.0F / square : 0.0F;
    m_tangent = generous ? 0.0F : m_bias.dot(m_axis.cwiseAbs2()) * m_perSquare;
    m_reach = burr.radius + static_cast<double>(m_halfWidth) + static_cast<double>(m_biasLimit);
    m_slope = 0.5F / m_halfWidth;
  }

  double reach() const noexcept { return m_reach; } ///< mm from the burr's way: none beyond

  /// Patient mm -> mm along the grid's axes.
  static Eigen::Vector3f along(const core::GridGeometry& grid, const Eigen::Vector3d& way)
  {
    return (grid.direction().transpose() * way).cast<float>();
  }

  /// From the burr's `from` to a voxel, mm along the grid's axes.
  Eigen::Vector3f offset(int i, int j, int k) const noexcept
  {
    const Eigen::Vector3d voxel(i, j, k);
    return (m_spacing.cast<double>().cwiseProduct(voxel) - m_from).cast<float>();
  }

  /// Before clamping to 0 to 1.
  float at(float x, float y, float z) const noexcept
  {
    const float dot = x * m_axis[0] + y * m_axis[1] + z * m_axis[2];
    const float t = std::min(std::max(dot * m_perSquare, 0.0F), 1.0F);
    x -= t * m_axis[0];
    y -= t * m_axis[1];
    z -= t * m_axis[2];
    // sum_a h_a^2/12 e_a' H e_a, with the Hessian H of the distance: (I - nn')/rho beyond the ends
    // of the way, (I - nn' - tt')/rho beside it.
    const float xx = x * x, yy = y * y, zz = z * z;
    const float square = std::max(xx + yy + zz, 1e-12F);
    const float rho = std::sqrt(square);
    const float beside = t > 0.0F && t < 1.0F ? m_tangent : 0.0F;
    const float curved = m_bias[0] * (yy + zz) + m_bias[1] * (xx + zz) + m_bias[2] * (xx + yy);
    const float bias = std::min((curved / square - beside) / rho, m_biasLimit);
    return 0.5F - (rho - m_radius - bias) * m_slope;
  }

  /// What `at` leaves, in steps of the mask.
  static std::uint16_t left(float coverage) noexcept
  {
    const float share = std::min(std::max(1.0F - coverage, 0.0F), 1.0F);
    return static_cast<std::uint16_t>(
        static_cast<int>(share * static_cast<float>(volume::CutMask::kUntouched) + 0.5F));
  }

  /// left(at(...)) of `count` voxels along the first axis.
  void row(int i, int j, int k, int count, std::uint16_t* result) const noexcept
  {
    const Eigen::Vector3f start = offset(i, j, k);
    for (int n = 0; n < count; ++n)
      result[n] = left(at(start[0] + static_cast<float>(n) * m_spacing[0], start[1], start[2]));
  }

private:
  Eigen::Vector3f m_axis; // from -> to
  Eigen::Vector3f m_spacing;
  float m_radius;
  float m_halfWidth;
  Eigen::Vector3f m_bias;
  float m_biasLimit;
  Eigen::Vector3d m_from;
  float m_perSquare = 0.0F;
  float m_tangent = 0.0F;
  float m_slope = 0.0F;
  double m_reach = 0.0;
};

} // namespace petrous::dissection
