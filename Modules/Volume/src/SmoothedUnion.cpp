#include "petrous/Volume/SmoothedUnion.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

#include "BinomialShare.h"

namespace petrous::volume
{

namespace
{

// Two voxels beyond the structure the filtered union is 0 for certain.
constexpr int kMargin = 2;

std::vector<bool> wantedTable(const LabelMap& labels,
                              const std::function<bool(std::uint16_t)>& wanted)
{
  std::vector<bool> table(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1, false);
  for (const Segment& segment : labels.segments)
    table[segment.index] = wanted(segment.index);
  return table;
}

core::IndexBox boxOf(const Volume<std::uint16_t>& voxels, const std::vector<bool>& table,
                     const core::IndexBox& within)
{
  core::IndexBox box;
  const int width = within.size()[0];
  for (int k = within.lower[2]; k < within.upper[2]; ++k)
    for (int j = within.lower[1]; j < within.upper[1]; ++j)
    {
      const std::uint16_t* row = &voxels.at(within.lower[0], j, k);
      const auto isWanted = [&table](std::uint16_t value) { return table[value]; };
      const std::uint16_t* first = std::find_if(row, row + width, isWanted);
      if (first == row + width)
        continue;
      int last = width - 1;
      while (!table[row[last]])
        --last;
      box = box.united({{within.lower[0] + static_cast<int>(first - row), j, k},
                        {within.lower[0] + last + 1, j + 1, k + 1}});
    }
  return box;
}

// Slices that one task filters.
constexpr int kSlab = 16;

} // namespace

std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted)
{
  return makeSmoothedUnion(labels, wanted, labels.voxels->geometry().fullBox());
}

std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted,
                  const core::IndexBox& within)
{
  const auto table = wantedTable(labels, wanted);
  const core::IndexBox box =
      boxOf(*labels.voxels, table, within.intersected(labels.voxels->geometry().fullBox()));
  if (box.empty())
    return nullptr;

  const core::GridGeometry& grid = labels.voxels->geometry();
  const core::Index3 size = box.size();
  // May reach beyond the label grid, so that a structure cut off by its border is closed there.
  const core::GridGeometry geometry(
      {size[0] + 2 * kMargin, size[1] + 2 * kMargin, size[2] + 2 * kMargin}, grid.spacing(),
      grid.patientFromVoxel(
          Eigen::Vector3d(box.lower[0] - kMargin, box.lower[1] - kMargin, box.lower[2] - kMargin)),
      grid.direction());
  auto field = std::make_shared<Volume<float>>(geometry);
  const core::Index3 dims = geometry.dims();
  std::array<std::array<float, BinomialBlock::kWeight + 1>, 2> tables;
  for (int sum = 0; sum <= BinomialBlock::kWeight; ++sum)
    for (const bool inside : {false, true})
      tables[inside ? 1 : 0][static_cast<std::size_t>(sum)] = smoothedShare(sum, inside);
  const auto filterSlab = [&](int first, int last)
  {
    BinomialBlock block;
    block.resize({dims[0], dims[1], last - first});
    constexpr int apron = BinomialBlock::kApron;
    const int from = std::max(first - apron, kMargin);
    const int to = std::min(last + apron, dims[2] - kMargin);
    for (int k = from; k < to; ++k)
      for (int j = 0; j < size[1]; ++j)
      {
        const std::uint16_t* labelRow =
            &labels.voxels->at(box.lower[0], box.lower[1] + j, box.lower[2] + k - kMargin);
        std::uint8_t* inside = block.row(j + kMargin, k - first) + apron + kMargin;
        for (int i = 0; i < size[0]; ++i)
          inside[i] = table[labelRow[i]] ? 1 : 0;
      }
    block.filter();
    for (int k = first; k < last; ++k)
      for (int j = 0; j < dims[1]; ++j)
      {
        const std::uint8_t* sums = block.sums(j, k - first);
        const std::uint8_t* inside = block.row(j, k - first) + apron;
        float* shares = &field->at(0, j, k);
        for (int i = 0; i < dims[0]; ++i)
          shares[i] = tables[inside[i]][sums[i]];
      }
  };
  tbb::parallel_for(0, (dims[2] + kSlab - 1) / kSlab,
                    [&](int slab)
                    { filterSlab(slab * kSlab, std::min((slab + 1) * kSlab, dims[2])); });
  return field;
}

} // namespace petrous::volume
