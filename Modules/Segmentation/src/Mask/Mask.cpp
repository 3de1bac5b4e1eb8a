#include "petrous/Segmentation/Mask.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstring>

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace petrous::segmentation
{

namespace
{

constexpr int kBrick = EditableMask::kBrick;

void requireSameGrid(const core::GridGeometry& a, const core::GridGeometry& b)
{
  if (!core::sameGrid(a, b))
    throw core::InvalidParameter("mask: the grids differ; use masks of one image");
}

/// The box that holds the mask's bricks; bricks cut the grid from voxel 0 on.
core::IndexBox wholeBricks(const core::IndexBox& box, const core::Index3& dims)
{
  core::IndexBox result;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] = box.lower[a] / kBrick * kBrick;
    result.upper[a] = std::min((box.upper[a] + kBrick - 1) / kBrick * kBrick, dims[a]);
  }
  return result;
}

} // namespace

Mask emptyMask(const core::GridGeometry& geometry)
{
  return {volume::makeZeroVolume<std::uint8_t>(geometry), {}, 0};
}

Mask makeMask(std::shared_ptr<const volume::Volume<std::uint8_t>> voxels, const core::IndexBox& box)
{
  struct Found
  {
    core::IndexBox box;
    std::uint64_t count = 0;
  };
  const core::IndexBox all = box.intersected(voxels->geometry().fullBox());
  const int width = all.upper[0] - all.lower[0];
  const Found found = tbb::parallel_reduce(
      tbb::blocked_range<int>(all.lower[2], std::max(all.lower[2], all.upper[2])), Found{},
      [&](const tbb::blocked_range<int>& range, Found sum)
      {
        for (int k = range.begin(); k < range.end(); ++k)
          for (int j = all.lower[1]; j < all.upper[1]; ++j)
          {
            const std::uint8_t* row = &voxels->at(all.lower[0], j, k);
            const std::uint8_t* first = static_cast<const std::uint8_t*>(
                std::memchr(row, 1, static_cast<std::size_t>(width)));
            if (!first)
              continue;
            int last = width - 1;
            while (row[last] == 0)
              --last;
            const int from = static_cast<int>(first - row);
            sum.count +=
                static_cast<std::uint64_t>(std::count(row + from, row + last + 1, std::uint8_t{1}));
            sum.box = sum.box.united(
                {{all.lower[0] + from, j, k}, {all.lower[0] + last + 1, j + 1, k + 1}});
          }
        return sum;
      },
      [](const Found& a, const Found& b) {
        return Found{a.box.united(b.box), a.count + b.count};
      });
  return {std::move(voxels), found.box, found.count};
}

Mask maskOf(const volume::LabelMap& labels, std::uint16_t index)
{
  const core::IndexBox box = volume::extentOf(labels);
  auto voxels = volume::makeZeroVolume<std::uint8_t>(labels.voxels->geometry());
  tbb::parallel_for(box.lower[2], std::max(box.lower[2], box.upper[2]),
                    [&](int k)
                    {
                      for (int j = box.lower[1]; j < box.upper[1]; ++j)
                        volume::forEachLabel(&labels.voxels->at(box.lower[0], j, k),
                                             box.upper[0] - box.lower[0],
                                             [&](int i, std::uint16_t label)
                                             {
                                               if (label == index)
                                                 voxels->at(box.lower[0] + i, j, k) = 1;
                                             });
                    });
  return makeMask(std::move(voxels), box);
}

volume::LabelMap labelMapOf(const Mask& mask, const volume::Segment& segment)
{
  if (segment.index == 0)
    throw core::InvalidParameter("mask: label 0 is the background; give 1 to 65535");
  auto voxels = volume::makeZeroVolume<std::uint16_t>(mask.geometry());
  const core::IndexBox& box = mask.extent;
  tbb::parallel_for(box.lower[2], std::max(box.lower[2], box.upper[2]),
                    [&](int k)
                    {
                      for (int j = box.lower[1]; j < box.upper[1]; ++j)
                        for (int i = box.lower[0]; i < box.upper[0]; ++i)
                          if (mask.voxels->at(i, j, k) != 0)
                            voxels->at(i, j, k) = segment.index;
                    });
  volume::LabelMap labels = volume::makeLabelMap(std::move(voxels), {segment});
  labels.extent = box;
  return labels;
}

EditableMask::EditableMask(const core::GridGeometry& geometry)
  : m_voxels(volume::makeZeroVolume<std::uint8_t>(geometry))
{
  std::size_t count = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    m_bricks[a] = (geometry.dims()[a] + kBrick - 1) / kBrick;
    count *= static_cast<std::size_t>(m_bricks[a]);
  }
  m_openAt.assign(count, -1);
}

EditableMask::EditableMask(const Mask& start)
  : EditableMask(start.geometry())
{
  m_extent = start.extent;
  m_count = start.count;
  for (int k = m_extent.lower[2]; k < m_extent.upper[2]; ++k)
    for (int j = m_extent.lower[1]; j < m_extent.upper[1]; ++j)
      std::copy_n(&start.voxels->at(m_extent.lower[0], j, k), m_extent.size()[0],
                  &m_voxels->at(m_extent.lower[0], j, k));
}

Mask EditableMask::snapshot() const
{
  auto voxels = volume::makeZeroVolume<std::uint8_t>(geometry());
  for (int k = m_extent.lower[2]; k < m_extent.upper[2]; ++k)
    for (int j = m_extent.lower[1]; j < m_extent.upper[1]; ++j)
      std::copy_n(&m_voxels->at(m_extent.lower[0], j, k), m_extent.size()[0],
                  &voxels->at(m_extent.lower[0], j, k));
  return makeMask(std::move(voxels), m_extent);
}

core::IndexBox EditableMask::boxOf(std::uint32_t brick) const
{
  core::IndexBox box;
  auto rest = static_cast<int>(brick);
  for (std::size_t a = 0; a < 3; ++a)
  {
    const int at = a == 2 ? rest : rest % m_bricks[a];
    rest /= m_bricks[a];
    box.lower[a] = at * kBrick;
    box.upper[a] = std::min(box.lower[a] + kBrick, geometry().dims()[a]);
  }
  return box;
}

void EditableMask::beginStep()
{
  if (m_stepping)
    throw core::InvalidParameter("mask: a step is under way; end it first");
  m_stepping = true;
}

core::IndexBox
EditableMask::change(const core::IndexBox& wanted,
                     const std::function<void(volume::Volume<std::uint8_t>&)>& change)
{
  if (!m_stepping)
    throw core::InvalidParameter("mask: no step is under way; begin one first");
  const core::IndexBox box = wanted.intersected(geometry().fullBox());
  if (box.empty())
    return {};
  const core::IndexBox bricks = wholeBricks(box, geometry().dims());
  const core::Index3 size = bricks.size();
  const auto widthOf = static_cast<std::size_t>(size[0]);
  std::vector<std::uint8_t> before(bricks.count());
  const auto rowBefore = [&](int j, int k)
  {
    return before.data() +
           (static_cast<std::size_t>(k - bricks.lower[2]) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j - bricks.lower[1])) *
               widthOf;
  };
  tbb::parallel_for(bricks.lower[2], bricks.upper[2],
                    [&](int k)
                    {
                      for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
                        std::memcpy(rowBefore(j, k), &m_voxels->at(bricks.lower[0], j, k), widthOf);
                    });
  change(*m_voxels);

  core::IndexBox differs;
  for (int bk = bricks.lower[2]; bk < bricks.upper[2]; bk += kBrick)
    for (int bj = bricks.lower[1]; bj < bricks.upper[1]; bj += kBrick)
      for (int bi = bricks.lower[0]; bi < bricks.upper[0]; bi += kBrick)
      {
        const auto index = static_cast<std::uint32_t>(
            bi / kBrick + m_bricks[0] * (bj / kBrick + m_bricks[1] * (bk / kBrick)));
        const core::IndexBox own = boxOf(index);
        Brick* brick = nullptr;
        for (int k = own.lower[2]; k < own.upper[2]; ++k)
          for (int j = own.lower[1]; j < own.upper[1]; ++j)
          {
            const std::uint8_t* was = rowBefore(j, k) + (own.lower[0] - bricks.lower[0]);
            const std::uint8_t* is = &m_voxels->at(own.lower[0], j, k);
            const int count = own.upper[0] - own.lower[0];
            if (std::memcmp(was, is, static_cast<std::size_t>(count)) == 0)
              continue;
            if (!brick)
            {
              std::int32_t& at = m_openAt[index];
              if (at < 0)
              {
                at = static_cast<std::int32_t>(m_open.size());
                m_open.push_back({index, {}});
              }
              brick = &m_open[static_cast<std::size_t>(at)];
            }
            for (int i = 0; i < count; ++i)
            {
              if (was[i] == is[i])
                continue;
              const int bit = ((k - own.lower[2]) * kBrick + (j - own.lower[1])) * kBrick + i;
              brick->bits[static_cast<std::size_t>(bit / 64)] ^= std::uint64_t{1} << (bit % 64);
              m_count += is[i] != 0 ? 1 : std::uint64_t(-1);
              const int x = own.lower[0] + i;
              differs = differs.united({{x, j, k}, {x + 1, j + 1, k + 1}});
            }
          }
      }
  m_extent = m_extent.united(differs);
  return differs;
}

core::IndexBox EditableMask::replace(const Mask& mask)
{
  requireSameGrid(mask.geometry(), geometry());
  const core::IndexBox box = mask.extent.united(m_extent);
  const core::IndexBox changed =
      change(box,
             [&](volume::Volume<std::uint8_t>& voxels)
             {
               tbb::parallel_for(box.lower[2], std::max(box.lower[2], box.upper[2]),
                                 [&](int k)
                                 {
                                   for (int j = box.lower[1]; j < box.upper[1]; ++j)
                                     std::copy_n(&mask.voxels->at(box.lower[0], j, k),
                                                 box.size()[0], &voxels.at(box.lower[0], j, k));
                                 });
             });
  m_extent = mask.extent;
  return changed;
}

bool EditableMask::endStep()
{
  if (!m_stepping)
    throw core::InvalidParameter("mask: no step is under way; begin one first");
  m_stepping = false;
  Step step;
  for (const Brick& brick : m_open)
  {
    m_openAt[brick.index] = -1;
    if (std::any_of(brick.bits.begin(), brick.bits.end(), [](auto bits) { return bits != 0; }))
      step.push_back(brick); // else changed there and back
  }
  m_open.clear();
  step.shrink_to_fit();
  if (step.empty())
    return false;
  while (m_steps.size() > m_position)
  {
    m_bytes -= m_steps.back().size() * sizeof(Brick);
    m_steps.pop_back();
  }
  m_bytes += step.size() * sizeof(Brick);
  m_steps.push_back(std::move(step));
  while (m_bytes > kMostHistory && m_steps.size() > 1)
  {
    m_bytes -= m_steps.front().size() * sizeof(Brick);
    m_steps.pop_front();
  }
  m_position = m_steps.size();
  return true;
}

std::size_t EditableMask::lastStepBytes() const noexcept
{
  return m_position == 0 ? 0 : m_steps[m_position - 1].size() * sizeof(Brick);
}

core::IndexBox EditableMask::flip(const Step& step)
{
  core::IndexBox changed;
  for (const Brick& brick : step)
  {
    const core::IndexBox own = boxOf(brick.index);
    for (std::size_t word = 0; word < brick.bits.size(); ++word)
      for (std::uint64_t bits = brick.bits[word]; bits != 0; bits &= bits - 1)
      {
        const int bit = static_cast<int>(word) * 64 +
                        static_cast<int>(std::bitset<64>((bits & -bits) - 1).count());
        const core::Index3 at{own.lower[0] + bit % kBrick, own.lower[1] + bit / kBrick % kBrick,
                              own.lower[2] + bit / kBrick / kBrick};
        std::uint8_t& voxel = m_voxels->at(at[0], at[1], at[2]);
        voxel ^= 1;
        m_count += voxel != 0 ? 1 : std::uint64_t(-1);
        changed = changed.united({at, {at[0] + 1, at[1] + 1, at[2] + 1}});
      }
  }
  m_extent = m_extent.united(changed);
  return changed;
}

core::IndexBox EditableMask::undo()
{
  if (!canUndo())
    throw core::InvalidParameter("mask: there is no step to undo");
  return flip(m_steps[--m_position]);
}

core::IndexBox EditableMask::redo()
{
  if (!canRedo())
    throw core::InvalidParameter("mask: there is no step to redo");
  return flip(m_steps[m_position++]);
}

} // namespace petrous::segmentation
