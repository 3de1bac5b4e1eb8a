#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "CellTissue.h"

namespace petrous::dissection
{

/// Sums over the points of a cell by the share of each point's part that is solid.
///
/// The mask falls along the way into a cut by 1/(2 w) a mm, w = |spacing| (SweptSphereCut.h). So
/// where it interpolates to m in the middle of a part that is s mm wide, the share of the part that
/// is left is clamp(1/2 + (m - 1/2) 2 w/s).
class BiteSums
{
public:
  explicit BiteSums(const core::GridGeometry& grid)
    : m_gain(static_cast<float>(2.0 * grid.spacing().norm() * CellContent::kPoints /
                                std::cbrt(grid.voxelVolume())))
    , m_low(static_cast<std::uint16_t>(kFull * (0.5F - 0.5F / m_gain)))
    , m_high(static_cast<std::uint16_t>(kFull * (0.5F + 0.5F / m_gain) + 1.0F))
    , m_partVolume(grid.voxelVolume() /
                   (CellContent::kPoints * CellContent::kPoints * CellContent::kPoints))
  {
  }

  std::uint16_t low() const noexcept { return m_low; }        ///< at and below: nothing is left
  std::uint16_t high() const noexcept { return m_high; }      ///< at and above: all is left
  double partVolume() const noexcept { return m_partVolume; } ///< mm^3 of a point

  struct Sums
  {
    float work = 0.0F;   ///< of resistance: times partVolume, N mm
    float volume = 0.0F; ///< of solid points: times partVolume, mm^3
  };

  /// The same, or what is known of the same corners; known from now on.
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

  /// corners: the mask at the eight corners, first axis fastest.
  Sums solid(const std::array<std::uint16_t, 8>& corners, const CellContent& content) const noexcept
  {
    using Four = Eigen::Array4f;
    float c[8];
    for (int n = 0; n < 8; ++n)
      c[n] = static_cast<float>(corners[static_cast<std::size_t>(n)]) * (m_gain / kFull) +
             (0.5F - 0.5F * m_gain);
    const Four t(0.125F, 0.375F, 0.625F, 0.875F);
    Four work = Four::Zero();
    Four volume = Four::Zero();
    const float* resistance = content.resistance.data();
    for (int z = 0; z < 4; ++z)
    {
      const float tz = t[z];
      const float c00 = c[0] + (c[4] - c[0]) * tz, c10 = c[1] + (c[5] - c[1]) * tz;
      const float c01 = c[2] + (c[6] - c[2]) * tz, c11 = c[3] + (c[7] - c[3]) * tz;
      for (int y = 0; y < 4; ++y, resistance += 4)
      {
        const float low = c00 + (c01 - c00) * t[y];
        const float high = c10 + (c11 - c10) * t[y];
        const Four share = (low + (high - low) * t).max(0.0F).min(1.0F);
        const Four r = Eigen::Map<const Four, Eigen::Aligned16>(resistance);
        work += share * r;
        volume += (r > 0.0F).select(share, 0.0F);
      }
    }
    return {work.sum(), volume.sum()};
  }

private:
  static constexpr float kFull = volume::CutMask::kUntouched;
  float m_gain;
  std::uint16_t m_low;
  std::uint16_t m_high;
  double m_partVolume;
};

} // namespace petrous::dissection
