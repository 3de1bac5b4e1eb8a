#include "petrous/Volume/SmoothedUnion.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "LabelOccupancy.h"
#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

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
  const core::IndexBox box = boxOf(*labels.voxels, table, within.intersected(extentOf(labels)));
  if (box.empty())
    return nullptr;

  const core::Index3 size = box.size();
  // May extend beyond the label grid, so that a structure cut off at its border is closed there.
  const core::GridGeometry geometry = gridOf(labels.voxels->geometry(), grown(box, kLabelMargin));
  const auto inside = makeZeroVolume<std::uint8_t>(geometry);
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
    {
      const std::uint16_t* labelRow =
          &labels.voxels->at(box.lower[0], box.lower[1] + j, box.lower[2] + k);
      std::uint8_t* row = &inside->at(kLabelMargin, j + kLabelMargin, k + kLabelMargin);
      for (int i = 0; i < size[0]; ++i)
        row[i] = table[labelRow[i]] ? 1 : 0;
    }
  return smoothedOccupancy(*inside, {});
}

} // namespace petrous::volume
