#include "petrous/Volume/LabelMap.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace petrous::volume
{

LabelMap makeLabelMap(std::shared_ptr<const Volume<std::uint16_t>> voxels,
                      std::vector<Segment> names)
{
  if (!voxels)
    throw core::InvalidParameter("label map: no voxels given");
  const auto byIndex = [](const Segment& a, const Segment& b) { return a.index < b.index; };
  std::sort(names.begin(), names.end(), byIndex);
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    if (names[n].index == 0)
      throw core::InvalidParameter("label map: segment '" + names[n].name +
                                   "' has index 0, which means nothing");
    if (n > 0 && names[n].index == names[n - 1].index)
      throw core::InvalidParameter("label map: segments '" + names[n - 1].name + "' and '" +
                                   names[n].name + "' share index " +
                                   std::to_string(names[n].index));
  }

  struct Found
  {
    std::vector<std::uint64_t> count =
        std::vector<std::uint64_t>(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1);
    core::IndexBox box;
  };
  tbb::enumerable_thread_specific<Found> parts;
  const core::Index3& dims = voxels->geometry().dims();
  tbb::parallel_for(0, dims[2],
                    [&](int k)
                    {
                      Found& found = parts.local();
                      for (int j = 0; j < dims[1]; ++j)
                      {
                        int first = dims[0];
                        int last = -1;
                        forEachLabel(&voxels->at(0, j, k), dims[0],
                                     [&](int i, std::uint16_t label)
                                     {
                                       ++found.count[label];
                                       first = std::min(first, i);
                                       last = i;
                                     });
                        if (last >= 0)
                          found.box = found.box.united({{first, j, k}, {last + 1, j + 1, k + 1}});
                      }
                    });
  std::vector<std::uint64_t> count = Found().count;
  core::IndexBox extent;
  for (const Found& found : parts)
  {
    std::transform(count.begin(), count.end(), found.count.begin(), count.begin(), std::plus<>());
    extent = extent.united(found.box);
  }

  for (Segment& segment : names)
  {
    segment.voxels = count[segment.index];
    count[segment.index] = 0;
  }
  for (std::size_t index = 1; index < count.size(); ++index)
    if (count[index] > 0)
    {
      Segment segment;
      segment.name = "label " + std::to_string(index);
      segment.index = static_cast<std::uint16_t>(index);
      segment.voxels = count[index];
      names.push_back(std::move(segment));
    }
  std::sort(names.begin(), names.end(), byIndex);
  return {std::move(voxels), std::move(names), extent};
}

core::IndexBox extentOf(const LabelMap& labels)
{
  return labels.extent.value_or(labels.voxels->geometry().fullBox());
}

std::vector<core::IndexBox> boxesOf(const LabelMap& labels)
{
  constexpr std::uint16_t none = std::numeric_limits<std::uint16_t>::max();
  std::vector<std::uint16_t> segmentOf(std::size_t{none} + 1, none);
  for (std::size_t n = 0; n < labels.segments.size(); ++n)
    segmentOf[labels.segments[n].index] = static_cast<std::uint16_t>(n);
  using Boxes = std::vector<core::IndexBox>;
  tbb::enumerable_thread_specific<Boxes> parts(Boxes(labels.segments.size()));
  const core::IndexBox extent = extentOf(labels);
  tbb::parallel_for(extent.lower[2], extent.upper[2],
                    [&](int k)
                    {
                      Boxes& boxes = parts.local();
                      for (int j = extent.lower[1]; j < extent.upper[1]; ++j)
                      {
                        const std::uint16_t* row = &labels.voxels->at(0, j, k);
                        for (int i = extent.lower[0]; i < extent.upper[0];)
                        {
                          const std::uint16_t value = row[i];
                          const int first = i;
                          while (i < extent.upper[0] && row[i] == value)
                            ++i;
                          if (value == 0 || segmentOf[value] == none)
                            continue;
                          core::IndexBox& box = boxes[segmentOf[value]];
                          box = box.united({{first, j, k}, {i, j + 1, k + 1}});
                        }
                      }
                    });
  Boxes all(labels.segments.size());
  for (const Boxes& boxes : parts)
    for (std::size_t n = 0; n < all.size(); ++n)
      all[n] = all[n].united(boxes[n]);
  return all;
}

} // namespace petrous::volume
