#include "OccupancyGrid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Volume/ChebyshevDistance.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Occupancy above which a brick of the CT's grid counts as solid: the surface threshold of
/// structures in pictures, minus a margin (OpticalModel.h, kOccupancyThreshold).
constexpr float kSolidOccupancy = 0.5F - 1e-3F;

/// 1 for every brick of `edge` cells, first axis fastest, that may contain a solid structure,
/// otherwise 0. An occupancy voxel counts for all bricks that its support (one label voxel to all
/// sides, mapped to the CT's grid) overlaps; for rotated grids the support's bounding box is used.
std::vector<std::uint8_t> solidBricks(const volume::Volume<float>& occupancy,
                                      const core::GridGeometry& ct, const core::Index3& bricks,
                                      int edge);

namespace
{

// A support that ends on a brick's face is 0 there. Rounding must not make it reach across.
constexpr double kRounding = 1e-6; // CT voxels

class Marker
{
public:
  Marker(const core::GridGeometry& labels, const core::GridGeometry& ct, const core::Index3& bricks,
         int edge)
    : m_linear(ct.voxelFromPatientLinear() * labels.patientFromVoxelLinear())
    , m_offset(ct.voxelFromPatient(labels.origin()))
    , m_bricks(bricks)
    , m_edge(edge)
    , m_marks(static_cast<std::size_t>(bricks[0]) * static_cast<std::size_t>(bricks[1]) *
              static_cast<std::size_t>(bricks[2]))
  {
    for (std::atomic<std::uint8_t>& mark : m_marks)
      mark.store(0, std::memory_order_relaxed);
    // In a rotated grid a long run is split; its bounding box could span the whole volume.
    Eigen::Vector3d aside = m_linear.col(0).cwiseAbs();
    Eigen::Index along = 0;
    aside.maxCoeff(&along);
    aside[along] = 0.0;
    m_longestRun = static_cast<int>(std::clamp(0.5 * edge / (aside.maxCoeff() + 1e-12), 1.0, 1e6));
  }

  /// Label voxels [first, last) of a row.
  void mark(int first, int last, int j, int k)
  {
    for (int i = first; i < last; i += m_longestRun)
      markBox(i, std::min(i + m_longestRun, last) - 1, j, k);
  }

  std::vector<std::uint8_t> take() const
  {
    std::vector<std::uint8_t> result(m_marks.size());
    std::transform(m_marks.begin(), m_marks.end(), result.begin(),
                   [](const std::atomic<std::uint8_t>& mark)
                   { return mark.load(std::memory_order_relaxed); });
    return result;
  }

private:
  void markBox(int first, int last, int j, int k)
  {
    const Eigen::Vector3d center =
        m_linear * Eigen::Vector3d(0.5 * (first + last), j, k) + m_offset;
    const Eigen::Vector3d half =
        m_linear.cwiseAbs() * Eigen::Vector3d(0.5 * (last - first) + 1.0, 1.0, 1.0);
    core::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const double low = (center[axis] - half[axis] + kRounding) / m_edge;
      const double high = (center[axis] + half[axis] - kRounding) / m_edge;
      if (!(high > 0.0) || !(low < m_bricks[a]))
        return;
      box.lower[a] = std::max(static_cast<int>(std::floor(low)), 0);
      box.upper[a] = static_cast<int>(std::min(std::ceil(high), 1.0 * m_bricks[a]));
    }
    for (int z = box.lower[2]; z < box.upper[2]; ++z)
      for (int y = box.lower[1]; y < box.upper[1]; ++y)
      {
        std::atomic<std::uint8_t>* row =
            &m_marks[static_cast<std::size_t>(m_bricks[0]) *
                     (static_cast<std::size_t>(y) +
                      static_cast<std::size_t>(m_bricks[1]) * static_cast<std::size_t>(z))];
        for (int x = box.lower[0]; x < box.upper[0]; ++x)
          if (row[x].load(std::memory_order_relaxed) == 0) // avoids cache-line contention
            row[x].store(1, std::memory_order_relaxed);
      }
  }

  Eigen::Matrix3d m_linear; // CT voxels per label voxel
  Eigen::Vector3d m_offset;
  core::Index3 m_bricks;
  int m_edge;
  int m_longestRun = 1;
  std::vector<std::atomic<std::uint8_t>> m_marks;
};

// The first voxel from `i` on that may differ from 0: most of an occupancy is 0.
int beyondZeros(const float* row, int i, int end)
{
  constexpr int kRun = 16;
  static constexpr std::array<float, kRun> kZeros{};
  while (i + kRun <= end && std::memcmp(row + i, kZeros.data(), sizeof kZeros) == 0)
    i += kRun;
  return i;
}

} // namespace

std::vector<std::uint8_t> solidBricks(const volume::Volume<float>& occupancy,
                                      const core::GridGeometry& ct, const core::Index3& bricks,
                                      int edge)
{
  const core::Index3& dims = occupancy.geometry().dims();
  Marker marker(occupancy.geometry(), ct, bricks, edge);
  tbb::parallel_for(tbb::blocked_range<int>(0, dims[2]),
                    [&](const tbb::blocked_range<int>& slices)
                    {
                      for (int k = slices.begin(); k < slices.end(); ++k)
                        for (int j = 0; j < dims[1]; ++j)
                        {
                          const float* row = &occupancy.at(0, j, k);
                          for (int i = 0; i < dims[0]; ++i)
                          {
                            i = beyondZeros(row, i, dims[0]);
                            const int first = i;
                            while (i < dims[0] && row[i] > kSolidOccupancy)
                              ++i;
                            if (i > first)
                              marker.mark(first, i, j, k);
                          }
                        }
                    });
  return marker.take();
}

namespace
{

constexpr std::uint16_t kUntouched = volume::CutMask::kUntouched;
// The threshold is one half: 32768 of 65535 is the first value inside tissue.
constexpr std::uint16_t kLastAir = kUntouched / 2;

struct MaskRange
{
  std::uint16_t min = kUntouched;
  std::uint16_t max = 0;
};

// Ends once both air and tissue were met: `judge` asks for no more than that.
MaskRange rangeOf(const volume::CutMask& mask, const core::IndexBox& voxels)
{
  constexpr int edge = volume::CutMask::kBrickEdge;
  MaskRange range;
  core::IndexBox part;
  for (int k = voxels.lower[2]; k < voxels.upper[2]; k = part.upper[2])
  {
    part.upper[2] = std::min((k / edge + 1) * edge, voxels.upper[2]);
    for (int j = voxels.lower[1]; j < voxels.upper[1]; j = part.upper[1])
    {
      part.upper[1] = std::min((j / edge + 1) * edge, voxels.upper[1]);
      for (int i = voxels.lower[0]; i < voxels.upper[0]; i = part.upper[0])
      {
        part.upper[0] = std::min((i / edge + 1) * edge, voxels.upper[0]);
        const volume::CutMask::Brick* brick =
            mask.brick(mask.brickIndex({i / edge, j / edge, k / edge})).get();
        if (!brick)
        {
          range.max = kUntouched;
          continue;
        }
        for (int z = k; z < part.upper[2]; ++z)
          for (int y = j; y < part.upper[1]; ++y)
          {
            const std::uint16_t* row =
                brick->data() + i % edge + edge * (y % edge + edge * (z % edge));
            for (int x = 0; x < part.upper[0] - i; ++x)
            {
              range.min = std::min(range.min, row[x]);
              range.max = std::max(range.max, row[x]);
            }
            if (range.min <= kLastAir && range.max > kLastAir)
              return range;
          }
      }
    }
  }
  return range;
}

core::IndexBox widened(const core::IndexBox& box, int margin, const core::Index3& dims)
{
  core::IndexBox result;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] = std::max(box.lower[a] - margin, 0);
    result.upper[a] = std::min(box.upper[a] + margin, dims[a]);
  }
  return result;
}

core::IndexBox oneBrick(int i, int j, int k)
{
  return {{i, j, k}, {i + 1, j + 1, k + 1}};
}

} // namespace

OccupancyGrid::OccupancyGrid(const volume::IntensityVolume& ct, int edge)
  : m_grid(ct.geometry())
  , m_edge(edge)
{
  if (edge != 4 && edge != 8 && edge != 16)
    throw core::InvalidParameter("occupancy grid: bricks of " + std::to_string(edge) +
                                 " voxels; 4, 8 or 16 are possible");
  for (std::size_t a = 0; a < 3; ++a)
    m_dims[a] = std::max((m_grid.dims()[a] - 1 + edge - 1) / edge, 1);
  const std::size_t count = texelIndex(0, 0, m_dims[2]);
  m_min.resize(count);
  m_max.resize(count);
  m_texels.resize(count);
  ct.visit([this](const auto& voxels) { readIntensities(voxels); });
  rebuild({}, nullptr, nullptr);
}

std::size_t OccupancyGrid::texelIndex(int i, int j, int k) const noexcept
{
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(m_dims[0]) *
             (static_cast<std::size_t>(j) +
              static_cast<std::size_t>(m_dims[1]) * static_cast<std::size_t>(k));
}

core::IndexBox OccupancyGrid::reach(int i, int j, int k) const noexcept
{
  const core::Index3 brick{i, j, k};
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = brick[a] * m_edge;
    box.upper[a] = std::min((brick[a] + 1) * m_edge + 1, m_grid.dims()[a]);
  }
  return box;
}

// Rows are reduced voxel by voxel into one row, and that row into bricks at the end, so that the
// inner loop vectorizes; it is bound by memory bandwidth.
template <class T>
void OccupancyGrid::readIntensities(const volume::Volume<T>& ct)
{
  const auto count = static_cast<std::size_t>(m_grid.dims()[0]);
  tbb::parallel_for(tbb::blocked_range<int>(0, m_dims[2]),
                    [&](const tbb::blocked_range<int>& layers)
                    {
                      std::vector<T> least(count);
                      std::vector<T> most(count);
                      std::vector<float> lost(std::is_floating_point_v<T> ? count : 0);
                      for (int k = layers.begin(); k < layers.end(); ++k)
                        for (int j = 0; j < m_dims[1]; ++j)
                        {
                          T* low = least.data();
                          T* high = most.data();
                          float* bad = lost.data();
                          const T top = std::is_floating_point_v<T>
                                            ? std::numeric_limits<T>::infinity()
                                            : std::numeric_limits<T>::max();
                          const T bottom = std::is_floating_point_v<T>
                                               ? -std::numeric_limits<T>::infinity()
                                               : std::numeric_limits<T>::lowest();
                          std::fill(least.begin(), least.end(), top);
                          std::fill(most.begin(), most.end(), bottom);
                          std::fill(lost.begin(), lost.end(), 0.0F);
                          const core::IndexBox box = reach(0, j, k);
                          for (int z = box.lower[2]; z < box.upper[2]; ++z)
                            for (int y = box.lower[1]; y < box.upper[1]; ++y)
                            {
                              const T* row = &ct.at(0, y, z);
                              for (std::size_t x = 0; x < count; ++x)
                              {
                                low[x] = row[x] < low[x] ? row[x] : low[x]; // false for NaN
                                high[x] = row[x] > high[x] ? row[x] : high[x];
                              }
                              if constexpr (std::is_floating_point_v<T>)
                                for (std::size_t x = 0; x < count; ++x)
                                  bad[x] += 0.0F * row[x]; // sticky NaN from NaN or infinity
                            }
                          for (int i = 0; i < m_dims[0]; ++i)
                          {
                            const core::IndexBox own = reach(i, j, k);
                            float min = std::numeric_limits<float>::infinity();
                            float max = -min;
                            for (int x = own.lower[0]; x < own.upper[0]; ++x)
                            {
                              min = std::min(min, static_cast<float>(low[x]));
                              max = std::max(max, static_cast<float>(high[x]));
                              if (std::is_floating_point_v<T> && std::isnan(bad[x]))
                                min = -std::numeric_limits<float>::infinity();
                            }
                            m_min[texelIndex(i, j, k)] = min;
                            m_max[texelIndex(i, j, k)] = max;
                          }
                        }
                    });
}

void OccupancyGrid::readLabels(const volume::LabelField* labels)
{
  if (!labels || !labels->occupancy)
  {
    m_solid.clear();
    m_occupancy.reset();
    return;
  }
  if (m_occupancy.lock() == labels->occupancy)
    return;
  m_solid = solidBricks(*labels->occupancy, m_grid, m_dims, m_edge);
  m_occupancy = labels->occupancy;
}

std::uint8_t OccupancyGrid::judge(std::size_t brick, const volume::CutMask* mask,
                                  const core::IndexBox& voxels) const
{
  const MaskRange left = mask ? rangeOf(*mask, voxels) : MaskRange{kUntouched, kUntouched};
  const double min = m_min[brick];
  const double max = m_max[brick];

  unsigned flags = 0;
  if (left.min < kUntouched)
    flags |= Mixed;
  const bool solidLabel = !m_solid.empty() && m_solid[brick] != 0;
  if (solidLabel)
    flags |= Labels;
  if (((m_rules.bone && max > m_rules.iso) || solidLabel) && left.max > kLastAir)
    flags |= Tissue;
  const bool solidBone = m_rules.bone && min > m_rules.iso && left.min > kLastAir;
  const auto hasOpacity = [&](const std::vector<volume::ValueRange>& ranges)
  {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const volume::ValueRange& r) { return min <= r.max && max >= r.min; });
  };
  const bool opaque = hasOpacity(m_rules.opaque);
  if (!solidBone || solidLabel || opaque || !m_rules.interior || m_rules.interiorEverywhere)
    flags |= Inside;
  if (!solidBone || solidLabel)
    flags |= Border;
  if (m_rules.soft &&
      ((flags & (Tissue | Mixed)) || m_rules.softEverywhere || hasOpacity(m_rules.softOpaque)))
    flags |= Soft;
  return static_cast<std::uint8_t>(flags);
}

// Recomputes the distances to one flag in a box from the current flags. Returns the box of changes.
core::IndexBox OccupancyGrid::measure(const core::IndexBox& box, Flag flag,
                                      std::uint8_t Texel::*distance)
{
  const auto found = volume::chebyshevDistances(&m_texels.front().flags, sizeof(Texel), flag,
                                                m_dims, box, kLargestDistance);
  core::IndexBox changed;
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
    {
      const std::uint8_t* row = found.row(j, k);
      Texel* texel = &m_texels[texelIndex(box.lower[0], j, k)];
      int first = box.upper[0];
      int last = box.lower[0] - 1;
      for (int i = box.lower[0]; i < box.upper[0]; ++i, ++row, ++texel)
        if (texel->*distance != *row)
        {
          texel->*distance = *row;
          first = std::min(first, i);
          last = i;
        }
      changed = changed.united({{first, j, k}, {last + 1, j + 1, k + 1}});
    }
  return changed;
}

// Box of the texels whose distance may change with the flags, searched within `reached`. A texel
// whose distance is less than that to the changed bricks has a nearer flagged brick.
core::IndexBox OccupancyGrid::affected(const Changes& changes, std::uint8_t Texel::*distance) const
{
  const core::IndexBox center = changes.added.united(changes.removed);
  core::IndexBox result;
  if (center.empty())
    return result;
  const core::IndexBox reached = widened(center, kLargestDistance - 1, m_dims);
  const auto beyond = [&center](int x, std::size_t axis) {
    return std::max({center.lower[axis] - x, x - center.upper[axis] + 1, 0});
  };
  const bool nearer = !changes.added.empty();
  const bool further = !changes.removed.empty();
  for (int k = reached.lower[2]; k < reached.upper[2]; ++k)
    for (int j = reached.lower[1]; j < reached.upper[1]; ++j)
    {
      const int aside = std::max(beyond(j, 1), beyond(k, 2));
      const Texel* texel = &m_texels[texelIndex(reached.lower[0], j, k)];
      int first = reached.upper[0];
      int last = reached.lower[0] - 1;
      for (int i = reached.lower[0]; i < reached.upper[0]; ++i, ++texel)
      {
        const int own = texel->*distance;
        const int there = std::max(aside, beyond(i, 0));
        if ((nearer && own > there) || (further && own >= there && own < kLargestDistance))
        {
          first = std::min(first, i);
          last = i;
        }
      }
      result = result.united({{first, j, k}, {last + 1, j + 1, k + 1}});
    }
  return result;
}

void OccupancyGrid::rebuild(const Rules& rules, const volume::LabelField* labels,
                            const volume::CutMask* mask)
{
  m_rules = rules;
  readLabels(labels);
  const volume::CutMask* cut = mask && !mask->untouched() ? mask : nullptr;
  tbb::parallel_for(tbb::blocked_range<int>(0, m_dims[2]),
                    [&](const tbb::blocked_range<int>& layers)
                    {
                      for (int k = layers.begin(); k < layers.end(); ++k)
                        for (int j = 0; j < m_dims[1]; ++j)
                          for (int i = 0; i < m_dims[0]; ++i)
                          {
                            const std::size_t brick = texelIndex(i, j, k);
                            m_texels[brick].flags = judge(brick, cut, reach(i, j, k));
                          }
                    });
  const core::IndexBox all{{0, 0, 0}, m_dims};
  measure(all, Tissue, &Texel::toTissue);
  measure(all, Inside, &Texel::toInside);
  if (m_rules.soft)
    measure(all, Soft, &Texel::toSoft);
  else
    for (Texel& texel : m_texels)
      texel.toSoft = 0;
}

core::IndexBox OccupancyGrid::maskChanged(const volume::CutMask* mask, const core::IndexBox& voxels)
{
  const core::IndexBox inside = voxels.intersected(m_grid.fullBox());
  if (inside.empty())
    return {};
  core::IndexBox bricks; // whose reach intersects the voxels
  for (std::size_t a = 0; a < 3; ++a)
  {
    bricks.lower[a] = std::max((inside.lower[a] + m_edge - 1) / m_edge - 1, 0);
    bricks.upper[a] = std::min((inside.upper[a] - 1) / m_edge + 1, m_dims[a]);
  }
  const core::Index3 size = bricks.size();
  std::vector<std::uint8_t> flags(bricks.count()); // first axis fastest
  tbb::parallel_for(bricks.lower[2], bricks.upper[2],
                    [&](int k)
                    {
                      auto* judged = flags.data() + static_cast<std::ptrdiff_t>(size[0]) * size[1] *
                                                        (k - bricks.lower[2]);
                      for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
                        for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
                          *judged++ = judge(texelIndex(i, j, k), mask, reach(i, j, k));
                    });
  core::IndexBox changed;
  Changes tissue;
  Changes seen;
  Changes soft;
  auto judged = flags.begin();
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
      {
        const std::size_t brick = texelIndex(i, j, k);
        const std::uint8_t before = m_texels[brick].flags;
        const std::uint8_t after = *judged++;
        if (before == after)
          continue;
        m_texels[brick].flags = after;
        changed = changed.united(oneBrick(i, j, k));
        const auto note = [&](Flag flag, Changes& changes)
        {
          if ((before ^ after) & flag)
          {
            core::IndexBox& box = after & flag ? changes.added : changes.removed;
            box = box.united(oneBrick(i, j, k));
          }
        };
        note(Tissue, tissue);
        note(Inside, seen);
        note(Soft, soft);
      }
  const core::IndexBox tissueBox = affected(tissue, &Texel::toTissue);
  if (!tissueBox.empty())
    changed = changed.united(measure(tissueBox, Tissue, &Texel::toTissue));
  const core::IndexBox seenBox = affected(seen, &Texel::toInside);
  if (!seenBox.empty())
    changed = changed.united(measure(seenBox, Inside, &Texel::toInside));
  const core::IndexBox softBox = affected(soft, &Texel::toSoft);
  if (!softBox.empty())
    changed = changed.united(measure(softBox, Soft, &Texel::toSoft));
  return changed;
}

std::size_t OccupancyGrid::bytes() const noexcept
{
  return m_texels.size() * (sizeof(Texel) + 2 * sizeof(float)) + m_solid.size();
}

volume::ValueRange OccupancyGrid::range() const noexcept
{
  volume::ValueRange range{std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()};
  for (const float value : m_min)
    if (std::isfinite(value))
      range.min = std::min(range.min, static_cast<double>(value));
  for (const float value : m_max)
    if (std::isfinite(value))
      range.max = std::max(range.max, static_cast<double>(value));
  return range.min <= range.max ? range : volume::ValueRange{};
}

} // namespace petrous::rendering
