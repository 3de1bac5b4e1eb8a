#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "CellTissue.h"

namespace petrous::dissection
{

/// Sums over the points of a cell, weighted by the solid fraction of each point's sub-cell.
///
/// The mask falls into a cut by 1/(2 w) per mm, w = |spacing| (SweptSphereCut.h). So where it
/// interpolates to m at the centre of a sub-cell s mm wide, the fraction left of the sub-cell is
/// clamp(1/2 + (m - 1/2) 2 w/s). The smaller of tissue and mask occupancy counts, as f is the
/// minimum of both.
class QuadratureSums
{
public:
  explicit QuadratureSums(const core::GridGeometry& grid)
    : m_gain(static_cast<float>(2.0 * grid.spacing().norm() * kCellPoints /
                                std::cbrt(grid.voxelVolume())))
    , m_low(static_cast<std::uint16_t>(kFull * (0.5F - 0.5F / m_gain)))
    , m_high(static_cast<std::uint16_t>(kFull * (0.5F + 0.5F / m_gain) + 1.0F))
    , m_partVolume(grid.voxelVolume() / (kCellPoints * kCellPoints * kCellPoints))
  {
  }

  std::uint16_t low() const noexcept { return m_low; }        ///< at or below: nothing is left
  std::uint16_t high() const noexcept { return m_high; }      ///< at or above: all is left
  double partVolume() const noexcept { return m_partVolume; } ///< mm^3 of a sub-cell

  struct Sums
  {
    float work = 0.0F;   ///< sum of resistance; times partVolume: N mm
    float volume = 0.0F; ///< sum of solid fractions; times partVolume: mm^3
  };

  /// As solid(), cached in `content` for the same corners.
  Sums known(const std::array<std::uint16_t, 8>& corners, CellContent& content) const noexcept
  {
    if (!content.reckoned || content.corners != corners)
      keep(corners, solid(corners, content), content);
    return {content.work, content.volume};
  }

  static void keep(const std::array<std::uint16_t, 8>& corners, const Sums& sums,
                   CellContent& content) noexcept
  {
    content.corners = corners;
    content.work = sums.work;
    content.volume = sums.volume;
    content.reckoned = true;
  }

  /// Fractions left of the sub-cells, given their tissue occupancy.
  void left(const std::array<std::uint16_t, 8>& corners, const CellValues& tissue,
            CellValues& shares) const noexcept
  {
    std::size_t point = 0;
    each(corners,
         [&](const Eigen::Array4f& share)
         {
           for (int n = 0; n < 4; ++n, ++point)
             shares[point] = std::min(share[n], tissue[point]);
         });
  }

  /// corners: the mask at the eight corners, first axis fastest.
  Sums solid(const std::array<std::uint16_t, 8>& corners, const CellContent& content) const noexcept
  {
    using Row = Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>;
    Eigen::Array4f work = Eigen::Array4f::Zero();
    Eigen::Array4f volume = Eigen::Array4f::Zero();
    const float* resistance = content.resistance.data();
    const float* tissue = content.occupancy.data();
    each(corners,
         [&](const Eigen::Array4f& mask)
         {
           const Eigen::Array4f share = mask.min(Row(tissue));
           work += share * Row(resistance);
           volume += share;
           resistance += 4;
           tissue += 4;
         });
    return {work.sum(), volume.sum()};
  }

private:
  // Calls `take` with the mask occupancies, >= 0, four at a time along the first axis: as
  // volume::interpolateCell at 64 fixed points, what points share computed once.
  template <typename Take>
  void each(const std::array<std::uint16_t, 8>& corners, const Take& take) const noexcept
  {
    float c[8];
    for (std::size_t n = 0; n < 8; ++n)
      c[n] = static_cast<float>(corners[n]) * (m_gain / kFull) + (0.5F - 0.5F * m_gain);
    const Eigen::Array4f t(0.125F, 0.375F, 0.625F, 0.875F);
    for (int z = 0; z < 4; ++z)
    {
      const float tz = t[z];
      const float c00 = c[0] + (c[4] - c[0]) * tz, c10 = c[1] + (c[5] - c[1]) * tz;
      const float c01 = c[2] + (c[6] - c[2]) * tz, c11 = c[3] + (c[7] - c[3]) * tz;
      for (int y = 0; y < 4; ++y)
      {
        const float low = c00 + (c01 - c00) * t[y];
        const float high = c10 + (c11 - c10) * t[y];
        take(Eigen::Array4f((low + (high - low) * t).max(0.0F)));
      }
    }
  }

  static constexpr float kFull = volume::CutMask::kUntouched;
  float m_gain;
  std::uint16_t m_low;
  std::uint16_t m_high;
  double m_partVolume;
};

} // namespace petrous::dissection
