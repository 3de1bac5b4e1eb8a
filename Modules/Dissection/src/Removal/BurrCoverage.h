#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::dissection
{

/// What a burr leaves of each voxel (SweptSphereCut.h), in quantisation steps of the mask. Shared
/// by cutting and by prediction of a cut, so that both agree to the last bit. Single precision,
/// relative to the burr: the distance is accurate to 1e-6 mm.
class BurrCoverage
{
public:
  static constexpr int kBatch = 64; ///< voxels processed together

  /// generous: for a sweep of which only a part will be cut; never leaves more than that part does.
  BurrCoverage(const SweptSphere& burr, const core::GridGeometry& grid, bool generous = false)
    : m_spacing(grid.spacing())
    , m_from(m_spacing.cwiseProduct(grid.voxelFromPatient(burr.from)))
    , m_axis(grid.direction().transpose() * (burr.to - burr.from))
  {
    const double halfWidth = m_spacing.norm();
    const double square = m_axis.squaredNorm();
    const double biasLimit = 0.25 * grid.minSpacing();
    const Eigen::Vector3d bias = m_spacing.cwiseAbs2() / 12.0;
    for (int a = 0; a < 3; ++a)
    {
      m_shape.axis[a] = static_cast<float>(m_axis[a]);
      m_shape.bias[a] = static_cast<float>(bias[a]);
    }
    m_shape.perSquare = square > 0.0 ? static_cast<float>(1.0 / square) : 0.0F;
    m_shape.tangent = square > 0.0 && !generous
                          ? static_cast<float>(bias.dot(m_axis.cwiseAbs2()) / square)
                          : 0.0F;
    m_shape.radius = static_cast<float>(burr.radius);
    m_shape.biasLimit = static_cast<float>(biasLimit);
    m_shape.slope = static_cast<float>(0.5 / halfWidth);
    m_reach = burr.radius + halfWidth + biasLimit;
  }

  double reach() const noexcept { return m_reach; } ///< mm from the burr's path; no effect beyond

  struct Span
  {
    int begin = 0;
    int end = 0;
  };

  /// Interval of a row of voxels within the bounding sphere of the sweep; all others are unchanged.
  Span span(int j, int k, int begin, int end) const noexcept
  {
    const Eigen::Vector3d middle = m_from + 0.5 * m_axis;
    const double bound = m_reach + 0.5 * m_axis.norm() + kRounding;
    const double y = m_spacing[1] * j - middle[1];
    const double z = m_spacing[2] * k - middle[2];
    const double square = bound * bound - y * y - z * z;
    if (square < 0.0)
      return {};
    const double half = std::sqrt(square);
    return {std::max(begin, static_cast<int>(std::ceil((middle[0] - half) / m_spacing[0]))),
            std::min(end, static_cast<int>(std::floor((middle[0] + half) / m_spacing[0])) + 1)};
  }

  /// Remainder of `count` voxels along the first axis.
  void row(int i, int j, int k, int count, std::uint16_t* result) const noexcept
  {
    const auto y = static_cast<float>(m_spacing[1] * j - m_from[1]);
    const auto z = static_cast<float>(m_spacing[2] * k - m_from[2]);
    for (int done = 0; done < count; done += kBatch)
      batch(std::min(count - done, kBatch), result + done,
            [&](int n, float& px, float& py, float& pz)
            {
              px = static_cast<float>(m_spacing[0] * (i + done + n) - m_from[0]);
              py = y;
              pz = z;
            });
  }

  /// Remainder of `count` voxels at x, y, z: voxel coordinates times spacing.
  void list(const double* x, const double* y, const double* z, std::size_t count,
            std::uint16_t* result) const noexcept
  {
    for (std::size_t done = 0; done < count; done += kBatch)
      batch(static_cast<int>(std::min<std::size_t>(count - done, kBatch)), result + done,
            [&](int n, float& px, float& py, float& pz)
            {
              const std::size_t at = done + static_cast<std::size_t>(n);
              px = static_cast<float>(x[at] - m_from[0]);
              py = static_cast<float>(y[at] - m_from[1]);
              pz = static_cast<float>(z[at] - m_from[2]);
            });
  }

private:
  static constexpr double kRounding = 1e-3; // mm, rounding error of single precision

  struct Shape
  {
    float axis[3], bias[3];
    float perSquare, tangent, radius, biasLimit, slope;

    // Fraction left, scaled to quantisation steps of the mask.
    float left(float x, float y, float z) const noexcept
    {
      const float along = (x * axis[0] + y * axis[1] + z * axis[2]) * perSquare;
      const float above = along < 0.0F ? 0.0F : along;
      const float t = above > 1.0F ? 1.0F : above;
      const float ox = x - t * axis[0], oy = y - t * axis[1], oz = z - t * axis[2];
      // sum_a h_a^2/12 e_a' H e_a, with the Hessian H of the distance: (I - nn')/rho beyond the
      // ends of the path, (I - nn' - tt')/rho beside it.
      const float xx = ox * ox, yy = oy * oy, zz = oz * oz;
      const float sum = xx + yy + zz;
      const float square = sum < 1e-12F ? 1e-12F : sum;
      const float rho = std::sqrt(square);
      const float beside = t == along ? tangent : 0.0F;
      const float curved = bias[0] * (yy + zz) + bias[1] * (xx + zz) + bias[2] * (xx + yy);
      const float wanted = (curved / square - beside) / rho;
      // Unbounded on the path itself, where rho is 0.
      const float least = wanted < -biasLimit ? -biasLimit : wanted;
      const float moved = least < biasLimit ? least : biasLimit;
      const float share = 0.5F + (rho - radius - moved) * slope;
      const float positive = share < 0.0F ? 0.0F : share;
      return (positive > 1.0F ? 1.0F : positive) * float{volume::CutMask::kUntouched} + 0.5F;
    }
  };

  template <typename Place>
  void batch(int count, std::uint16_t* result, const Place& place) const noexcept
  {
    const Shape shape = m_shape;
    float x[kBatch], y[kBatch], z[kBatch];
    std::int32_t left[kBatch];
    for (int n = 0; n < count; ++n)
      place(n, x[n], y[n], z[n]);
    for (int n = 0; n < count; ++n)
      left[n] = static_cast<std::int32_t>(shape.left(x[n], y[n], z[n]));
    for (int n = 0; n < count; ++n)
      result[n] = static_cast<std::uint16_t>(left[n]);
  }

  Eigen::Vector3d m_spacing;
  Eigen::Vector3d m_from; // mm along the grid's axes from the first voxel
  Eigen::Vector3d m_axis; // from -> to, likewise
  Shape m_shape{};
  double m_reach = 0.0;
};

} // namespace petrous::dissection
