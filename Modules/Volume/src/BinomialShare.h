#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace petrous::volume
{

/// A block of voxels, each inside (1) or outside (0), with one voxel of apron to all sides.
class BinomialBlock
{
public:
  static constexpr int kApron = 1;
  static constexpr int kWeight = 64; ///< sum of [1 2 1]^3

  /// `size` counts the voxels without the apron. All are outside.
  void resize(const core::Index3& size);

  /// Voxels from -kApron on along the row, which holds size[0] + 2 kApron of them.
  std::uint8_t* row(int j, int k) noexcept { return &m_inside[at(j, k)]; }
  bool inside(int i, int j, int k) const noexcept
  {
    return m_inside[at(j, k) + static_cast<std::size_t>(i + kApron)] != 0;
  }

  /// Filters what the rows hold by [1 2 1] along each axis.
  void filter();

  /// After `filter`: 64ths of the voxels of a row, without the apron.
  const std::uint8_t* sums(int j, int k) const noexcept;

private:
  std::size_t at(int j, int k) const noexcept;

  core::Index3 m_size{};
  std::vector<std::uint8_t> m_inside;
  std::vector<std::uint8_t> m_alongX;
  std::vector<std::uint8_t> m_alongY;
  std::vector<std::uint8_t> m_sums;
};

/// Share of a voxel (SmoothedUnion.h) from its 64ths: kept at kInsideFloor and above inside, at
/// 1 - kInsideFloor and below outside.
float smoothedShare(int sum, bool inside) noexcept;

} // namespace petrous::volume
