#include "BinomialShare.h"

#include <algorithm>

#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::volume
{

namespace
{

// [1 2 1] across three lines of voxels, each voxel by itself. Nothing exceeds 64.
void addLines(const std::uint8_t* before, const std::uint8_t* own, const std::uint8_t* after,
              std::size_t count, std::uint8_t* result)
{
  for (std::size_t i = 0; i < count; ++i)
    result[i] = static_cast<std::uint8_t>(before[i] + 2 * own[i] + after[i]);
}

std::size_t product(int a, int b, int c)
{
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

} // namespace

void BinomialBlock::resize(const core::Index3& size)
{
  constexpr int apron = 2 * kApron;
  m_size = size;
  m_inside.assign(product(size[0] + apron, size[1] + apron, size[2] + apron), 0);
  m_alongX.resize(product(size[0], size[1] + apron, size[2] + apron));
  m_alongY.resize(product(size[0], size[1], size[2] + apron));
  m_sums.resize(product(size[0], size[1], size[2]));
}

std::size_t BinomialBlock::at(int j, int k) const noexcept
{
  return product(m_size[0] + 2 * kApron, (j + kApron) + (m_size[1] + 2 * kApron) * (k + kApron), 1);
}

void BinomialBlock::filter()
{
  const auto width = static_cast<std::size_t>(m_size[0]);
  const int rows = m_size[1] + 2 * kApron;
  for (int k = -kApron; k < m_size[2] + kApron; ++k)
  {
    for (int j = -kApron; j < m_size[1] + kApron; ++j)
    {
      const std::uint8_t* row = &m_inside[at(j, k)];
      addLines(row, row + 1, row + 2, width,
               &m_alongX[product(m_size[0], j + kApron + rows * (k + kApron), 1)]);
    }
    const std::uint8_t* slice = &m_alongX[product(m_size[0], rows, k + kApron)];
    const std::size_t area = product(m_size[0], m_size[1], 1);
    addLines(slice, slice + width, slice + 2 * width, area,
             &m_alongY[area * static_cast<std::size_t>(k + kApron)]);
  }
  const std::size_t area = product(m_size[0], m_size[1], 1);
  addLines(m_alongY.data(), m_alongY.data() + area, m_alongY.data() + 2 * area, m_sums.size(),
           m_sums.data());
}

const std::uint8_t* BinomialBlock::sums(int j, int k) const noexcept
{
  return &m_sums[product(m_size[0], j + m_size[1] * k, 1)];
}

float smoothedShare(int sum, bool inside) noexcept
{
  const float share = static_cast<float>(sum) / float{BinomialBlock::kWeight};
  return inside ? std::max(share, kInsideFloor) : std::min(share, 1.0F - kInsideFloor);
}

} // namespace petrous::volume
