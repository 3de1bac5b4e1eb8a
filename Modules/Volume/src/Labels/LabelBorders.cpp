#include "petrous/Volume/LabelBorders.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "LabelOccupancy.h"
#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

constexpr auto kThreshold = static_cast<float>(kInsideOccupancy);
constexpr int kBlock = 4; // voxels: the blocks around a border's blocks take part in its relaxation
constexpr int kRound = 2 * kBlock;

constexpr int kWord = 8; // voxels compared at once

using Boxes = std::array<core::IndexBox, 256>;

bool sameWord(const std::uint8_t* voxels, std::uint8_t value)
{
  std::uint64_t word;
  std::memcpy(&word, voxels, sizeof word);
  return word == 0x0101010101010101U * value;
}

// Marks the voxels around which two solids meet in tissue, and returns the bounding box of such
// cells for each solid.
Boxes markMeetings(const Volume<float>& occupancy, const Volume<std::uint8_t>& index,
                   const std::array<bool, 256>& solid, Volume<std::uint8_t>& borders,
                   const core::Progress& progress)
{
  const core::Index3& dims = index.geometry().dims();
  tbb::enumerable_thread_specific<Boxes> found;
  // Whether the solids of a cell of eight voxels meet; `corners` receives their indices.
  const auto cellAt = [&](int i, int j, int k, std::array<std::uint8_t, 8>& corners)
  {
    std::uint8_t first = 0;
    bool meet = false;
    for (int corner = 0; corner < 8; ++corner)
    {
      std::uint8_t own = index.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
      if (!solid[own])
        own = 0;
      corners[static_cast<std::size_t>(corner)] = own;
      meet = meet || (own != 0 && first != 0 && own != first);
      first = first != 0 ? first : own;
    }
    if (!meet)
      return false;
    for (int corner = 0; corner < 8; ++corner)
      if (occupancy.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)) > kThreshold)
        return true;
    return false;
  };
  const auto markTile = [&](const core::Index3&, const core::IndexBox& tile)
  {
    Boxes& boxes = found.local();
    const core::IndexBox cells =
        grown(tile, 1).intersected({{0, 0, 0}, {dims[0] - 1, dims[1] - 1, dims[2] - 1}});
    std::array<std::uint8_t, 8> corners{};
    for (int k = cells.lower[2]; k < cells.upper[2]; ++k)
      for (int j = cells.lower[1]; j < cells.upper[1]; ++j)
      {
        const std::uint8_t* rows[4] = {&index.at(0, j, k), &index.at(0, j + 1, k),
                                       &index.at(0, j, k + 1), &index.at(0, j + 1, k + 1)};
        for (int i = cells.lower[0]; i < cells.upper[0]; ++i)
        {
          const std::uint8_t own = rows[0][i];
          if (i + kWord <= dims[0] &&
              std::all_of(rows, rows + 4,
                          [&](const std::uint8_t* row) { return sameWord(row + i, own); }))
          {
            i += kWord - 2; // the next cell begins at the last voxel of the word
            continue;
          }
          const bool alike = std::all_of(rows, rows + 4,
                                         [&](const std::uint8_t* row)
                                         { return row[i] == own && row[i + 1] == own; });
          if (alike || !cellAt(i, j, k, corners))
            continue;
          for (const std::uint8_t corner : corners)
            if (corner != 0)
              boxes[corner] = boxes[corner].united({{i, j, k}, {i + 2, j + 2, k + 2}});
          const core::IndexBox round =
              core::IndexBox{{i, j, k}, {i + 2, j + 2, k + 2}}.intersected(tile);
          for (int z = round.lower[2]; z < round.upper[2]; ++z)
            for (int y = round.lower[1]; y < round.upper[1]; ++y)
              for (int x = round.lower[0]; x < round.upper[0]; ++x)
                borders.at(x, y, z) = kMeeting;
        }
      }
  };
  forEachTile(dims, progress, "borders of structures", markTile);
  Boxes boxes{};
  for (const Boxes& some : found)
    for (std::size_t n = 0; n < boxes.size(); ++n)
      if (!some[n].empty())
        boxes[n] = boxes[n].united(some[n]);
  return boxes;
}

// Blocks of voxels that contain, or are adjacent to, voxels in which structures meet.
class Blocks
{
public:
  Blocks(const Volume<std::uint8_t>& borders, const core::IndexBox& voxels)
    : m_lower{voxels.lower[0] / kBlock - 1, voxels.lower[1] / kBlock - 1,
              voxels.lower[2] / kBlock - 1}
    , m_dims{(voxels.upper[0] - 1) / kBlock + 2 - m_lower[0],
             (voxels.upper[1] - 1) / kBlock + 2 - m_lower[1],
             (voxels.upper[2] - 1) / kBlock + 2 - m_lower[2]}
    , m_near(core::IndexBox{{0, 0, 0}, m_dims}.count(), 0)
  {
    for (int k = voxels.lower[2]; k < voxels.upper[2]; ++k)
      for (int j = voxels.lower[1]; j < voxels.upper[1]; ++j)
        for (int i = voxels.lower[0]; i < voxels.upper[0]; ++i)
          if ((borders.at(i, j, k) & kMeeting) != 0 && m_near[at({i, j, k})] != kHere)
            mark({i, j, k});
  }

  // `voxel` is at most one outside the given box; false if an index is negative.
  bool hold(const core::Index3& voxel) const
  {
    return voxel[0] >= 0 && voxel[1] >= 0 && voxel[2] >= 0 && m_near[at(voxel)] != 0;
  }

private:
  static constexpr std::uint8_t kHere = 2;

  std::size_t at(const core::Index3& voxel) const
  {
    return static_cast<std::size_t>(voxel[0] / kBlock - m_lower[0]) +
           static_cast<std::size_t>(m_dims[0]) *
               (static_cast<std::size_t>(voxel[1] / kBlock - m_lower[1]) +
                static_cast<std::size_t>(m_dims[1]) *
                    static_cast<std::size_t>(voxel[2] / kBlock - m_lower[2]));
  }

  void mark(const core::Index3& voxel)
  {
    const std::size_t here = at(voxel);
    const auto row = static_cast<std::size_t>(m_dims[0]);
    const std::size_t slice = row * static_cast<std::size_t>(m_dims[1]);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i)
        {
          std::uint8_t& near = m_near[here + i + j * row + k * slice - 1 - row - slice];
          near = std::max<std::uint8_t>(near, 1);
        }
    m_near[here] = kHere;
  }

  core::Index3 m_lower; // blocks
  core::Index3 m_dims;
  std::vector<std::uint8_t> m_near;
};

// Writes the depth of the voxels of one index inside `box`.
void writeDepths(const Volume<std::uint8_t>& index, std::uint8_t own, const core::IndexBox& box,
                 Volume<std::uint8_t>& borders, const core::Progress& progress)
{
  const core::IndexBox source = grown(box, kRound).intersected(index.geometry().fullBox());
  const auto inside = makeZeroVolume<std::uint8_t>(gridOf(index.geometry(), grown(source, 1)));
  for (int k = source.lower[2]; k < source.upper[2]; ++k)
    for (int j = source.lower[1]; j < source.upper[1]; ++j)
    {
      const std::uint8_t* row = &index.at(source.lower[0], j, k);
      std::uint8_t* out = &inside->at(1, j - source.lower[1] + 1, k - source.lower[2] + 1);
      for (int i = 0; i < source.size()[0]; ++i)
        out[i] = row[i] == own ? 1 : 0;
    }
  const Blocks near(borders, source);
  const core::Index3 offset{source.lower[0] - 1, source.lower[1] - 1, source.lower[2] - 1};
  const auto occupancy = smoothedOccupancy(
      *inside, progress,
      [&](const core::Index3& cell) {
        return near.hold({cell[0] + offset[0], cell[1] + offset[1], cell[2] + offset[2]});
      });
  const core::IndexBox target = grown(box, 1).intersected(index.geometry().fullBox());
  for (int k = target.lower[2]; k < target.upper[2]; ++k)
    for (int j = target.lower[1]; j < target.upper[1]; ++j)
      for (int i = target.lower[0]; i < target.upper[0]; ++i)
      {
        if (index.at(i, j, k) != own)
          continue;
        const double depth =
            SurfaceNet::depthOf(occupancy->at(i - source.lower[0] + 1, j - source.lower[1] + 1,
                                              k - source.lower[2] + 1)) /
            kBorderReach;
        std::uint8_t& border = borders.at(i, j, k);
        border = static_cast<std::uint8_t>(
            (border & kMeeting) |
            static_cast<int>(std::lround(std::clamp(depth * kDeepest, 1.0, 1.0 * kDeepest))));
      }
}

} // namespace

std::shared_ptr<const Volume<std::uint8_t>> makeLabelBorders(const Volume<float>& occupancy,
                                                             const Volume<std::uint8_t>& index,
                                                             const std::array<bool, 256>& solid,
                                                             const core::Progress& progress)
{
  const auto borders = makeZeroVolume<std::uint8_t>(index.geometry());
  const Boxes boxes = markMeetings(occupancy, index, solid, *borders, progress.part(0.0, 0.2));
  std::vector<std::uint8_t> meeting;
  for (std::size_t own = 1; own < boxes.size(); ++own)
    if (!boxes[own].empty())
      meeting.push_back(static_cast<std::uint8_t>(own));
  if (meeting.empty())
    return nullptr;
  for (std::size_t n = 0; n < meeting.size(); ++n)
  {
    const auto count = static_cast<double>(meeting.size());
    const double from = 0.2 + 0.8 * static_cast<double>(n) / count;
    writeDepths(index, meeting[n], boxes[meeting[n]], *borders,
                progress.part(from, from + 0.8 / count));
  }
  return borders;
}

StructureChoice structureAt(const Volume<std::uint8_t>& index, const Volume<std::uint8_t>* borders,
                            const Eigen::Vector3d& voxel)
{
  const core::Index3 nearest = nearestVoxel(voxel);
  const core::IndexBox full = index.geometry().fullBox();
  if (!full.contains(nearest))
    return {};
  StructureChoice choice{index.at(nearest[0], nearest[1], nearest[2])};
  if (!borders || (borders->at(nearest[0], nearest[1], nearest[2]) & kMeeting) == 0)
    return choice;
  const core::Index3 lower = flooredVoxel(voxel);
  const Eigen::Vector3d up = voxel - toVector(lower);
  std::array<std::uint8_t, 3> who{choice.index, 0, 0};
  std::array<double, 3> most{};
  for (int corner = 0; corner < 8; ++corner)
  {
    core::Index3 at = lower;
    double weight = 1.0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const bool high = (corner >> a & 1) != 0;
      const double along = up[static_cast<Eigen::Index>(a)];
      at[a] += high ? 1 : 0;
      weight *= high ? along : 1.0 - along;
    }
    if (!full.contains(at))
      continue;
    weight *= borders->at(at[0], at[1], at[2]) & kDeepest;
    const std::uint8_t own = index.at(at[0], at[1], at[2]);
    if (!(weight > 0.0))
      continue;
    std::size_t n = 0;
    while (n < who.size() && who[n] != own && who[n] != 0)
      ++n;
    if (n == who.size())
      continue;
    who[n] = own;
    most[n] += weight;
  }
  std::size_t first = 0;
  for (std::size_t n = 1; n < most.size(); ++n)
    if (most[n] > most[first])
      first = n;
  double next = 0.0;
  for (std::size_t n = 0; n < most.size(); ++n)
    if (n != first)
      next = std::max(next, most[n]);
  choice.index = who[first];
  choice.margin = kMarginPerDepth * (most[first] - next);
  return choice;
}

} // namespace petrous::volume
