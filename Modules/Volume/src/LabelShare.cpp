#include "LabelShare.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "BinomialShare.h"

namespace petrous::volume
{

namespace
{

constexpr double kSteps = 65535.0;

using ShareTable = std::array<float, BinomialBlock::kWeight + 1>;

ShareTable shareTable(bool inside)
{
  ShareTable table{};
  for (int sum = 0; sum <= BinomialBlock::kWeight; ++sum)
    table[static_cast<std::size_t>(sum)] = quantisedShare(smoothedShare(sum, inside));
  return table;
}

} // namespace

core::IndexBox grown(const core::IndexBox& box, int voxels) noexcept
{
  core::IndexBox result = box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] -= voxels;
    result.upper[a] += voxels;
  }
  return result;
}

core::IndexBox moved(const core::IndexBox& box, const core::Index3& by) noexcept
{
  core::IndexBox result = box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] += by[a];
    result.upper[a] += by[a];
  }
  return result;
}

Eigen::Vector3d toVector(const core::Index3& index) noexcept
{
  return {1.0 * index[0], 1.0 * index[1], 1.0 * index[2]};
}

core::Index3 nearestVoxel(const Eigen::Vector3d& position) noexcept
{
  return flooredVoxel(position + Eigen::Vector3d::Constant(0.5));
}

core::Index3 flooredVoxel(const Eigen::Vector3d& position) noexcept
{
  return {static_cast<int>(std::floor(position[0])), static_cast<int>(std::floor(position[1])),
          static_cast<int>(std::floor(position[2]))};
}

core::GridGeometry gridOf(const core::GridGeometry& grid, const core::IndexBox& box)
{
  return {box.size(), grid.spacing(), grid.patientFromVoxel(toVector(box.lower)), grid.direction()};
}

float quantisedShare(double share) noexcept
{
  return static_cast<float>(std::round(share * kSteps) / kSteps);
}

std::shared_ptr<Volume<float>> smoothRanks(const LabelRanks& ranks, const LabelOrder& order,
                                           const core::Progress& progress)
{
  const core::IndexBox box = grown(ranks.box, kLabelMargin);
  const auto field = makeZeroVolume<float>(gridOf(ranks.geometry(), box));
  const core::IndexBox full = ranks.geometry().fullBox();
  const std::array<ShareTable, 2> tables{shareTable(false), shareTable(true)};
  const auto smoothTile = [&](const core::Index3&, const core::IndexBox& tile)
  {
    const core::IndexBox source =
        grown(moved(tile, box.lower), BinomialBlock::kApron).intersected(full);
    if (!ranks.tiles.any(source))
      return;
    const core::Index3 size = tile.size();
    BinomialBlock block;
    block.resize(size);
    // First voxel of the block's rows on the grid of the ranks.
    const core::Index3 start = moved(tile, box.lower).lower;
    const int width = source.size()[0];
    std::size_t count = 0;
    for (int k = source.lower[2]; k < source.upper[2]; ++k)
      for (int j = source.lower[1]; j < source.upper[1]; ++j)
      {
        const LabelRank* from = &ranks.voxels->at(source.lower[0], j, k);
        std::uint8_t* inside = block.row(j - start[1], k - start[2]) + BinomialBlock::kApron +
                               (source.lower[0] - start[0]);
        for (int i = 0; i < width; ++i)
          inside[i] = order.isSolid(from[i]) ? 1 : 0;
        count += static_cast<std::size_t>(std::count(inside, inside + width, std::uint8_t{1}));
      }
    if (count == 0)
      return;
    if (count == grown(tile, BinomialBlock::kApron).count())
    {
      for (int k = tile.lower[2]; k < tile.upper[2]; ++k)
        for (int j = tile.lower[1]; j < tile.upper[1]; ++j)
          std::fill_n(&field->at(tile.lower[0], j, k), size[0], 1.0F);
      return;
    }
    block.filter();
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
      {
        const std::uint8_t* sums = block.sums(j, k);
        const std::uint8_t* inside = block.row(j, k) + BinomialBlock::kApron;
        float* shares = &field->at(tile.lower[0], tile.lower[1] + j, tile.lower[2] + k);
        for (int i = 0; i < size[0]; ++i)
          shares[i] = tables[inside[i]][sums[i]];
      }
  };
  forEachTile(field->geometry().dims(), progress, "smoothing structures", smoothTile);
  return field;
}

} // namespace petrous::volume
