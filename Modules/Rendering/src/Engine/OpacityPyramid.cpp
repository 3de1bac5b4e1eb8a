#include "OpacityPyramid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Volume/Sampling.h"

namespace petrous::rendering
{

namespace
{

constexpr int kBlock = 4;              // texels of the unit of work, along each axis
constexpr double kFieldScale = 1000.0; // unit of c_CT, as the tissue field's default

std::uint8_t inBits(double value)
{
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

std::size_t indexIn(const core::Index3& dims, int i, int j, int k)
{
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(dims[0]) *
             (static_cast<std::size_t>(j) +
              static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(k));
}

int roundedUp(int value, int multiple)
{
  return (value + multiple - 1) / multiple * multiple;
}

// The tissue field and the opacity of what decides it, at voxel centres.
template <class T>
class VoxelField
{
public:
  VoxelField(const OpacityPyramid::Scene& scene, const volume::Volume<T>& ct)
    : m_scene(scene)
    , m_ct(ct)
  {
    if (!scene.labels)
      return;
    const core::GridGeometry& labels = scene.labels->occupancy->geometry();
    m_linear = labels.voxelFromPatientLinear() * ct.geometry().patientFromVoxelLinear();
    m_offset = labels.voxelFromPatient(ct.geometry().origin());
  }

  struct Value
  {
    float f = -1.0F;
    float opacity = 0.0F;
  };

  /// `labelled`: a structure may be near.
  Value at(int i, int j, int k, bool labelled) const
  {
    const double bone =
        m_scene.bone ? (static_cast<double>(m_ct.at(i, j, k)) - m_scene.iso) / kFieldScale : -1.0;
    Value value{static_cast<float>(bone), m_scene.materials.front().surfaceOpacity};
    if (labelled)
      addStructure(m_linear * Eigen::Vector3d(i, j, k) + m_offset, value);
    // Uncut is 0.5, also without a mask, so that one in which nothing is cut changes nothing.
    const float uncut =
        m_scene.mask ? static_cast<float>(m_scene.mask->at(i, j, k)) / volume::CutMask::kUntouched
                     : 1.0F;
    if (value.f > uncut - 0.5F)
      value.f = uncut - 0.5F;
    if (!std::isfinite(value.f)) // written so that NaN is air
      value.f = value.f > 0.0F ? 1.0F : -1.0F;
    return value;
  }

private:
  void addStructure(const Eigen::Vector3d& voxel, Value& value) const
  {
    const volume::Volume<float>& occupancy = *m_scene.labels->occupancy;
    if (!occupancy.geometry().hullContains(voxel))
      return;
    const auto share = static_cast<float>(volume::sampleTrilinear(occupancy, voxel) - 0.5);
    if (!(share > std::min(value.f, 0.0F) || std::isnan(value.f)))
      return;
    value.f = std::fmax(share, value.f);
    const core::Index3& dims = m_scene.labels->index->geometry().dims();
    core::Index3 nearest{};
    for (std::size_t a = 0; a < 3; ++a)
      nearest[a] = std::clamp(static_cast<int>(std::lround(voxel[static_cast<Eigen::Index>(a)])), 0,
                              dims[a] - 1);
    const std::uint8_t index = m_scene.labels->index->at(nearest[0], nearest[1], nearest[2]);
    if (index < m_scene.materials.size() && !m_scene.materials[index].lumen)
      value.opacity = m_scene.materials[index].surfaceOpacity;
  }

  const OpacityPyramid::Scene& m_scene;
  const volume::Volume<T>& m_ct;
  Eigen::Matrix3d m_linear = Eigen::Matrix3d::Identity(); // label voxels per CT voxel
  Eigen::Vector3d m_offset = Eigen::Vector3d::Zero();
};

// What the bricks tell of a box of voxels.
struct Content
{
  bool tissue = false;
  bool border = false;
};

int brickOf(int voxel, int edge, int count)
{
  return std::clamp(voxel / edge, 0, count - 1);
}

const OccupancyGrid::Texel& brickAt(const OccupancyGrid& grid, int i, int j, int k)
{
  const core::Index3& dims = grid.dims();
  return grid.texels()[indexIn(dims, brickOf(i, grid.edge(), dims[0]),
                               brickOf(j, grid.edge(), dims[1]), brickOf(k, grid.edge(), dims[2]))];
}

Content contentOf(const OccupancyGrid& grid, const core::IndexBox& voxels)
{
  const int edge = grid.edge();
  const auto last = [&](std::size_t a)
  { return brickOf(voxels.upper[a] - 1, edge, grid.dims()[a]); };
  const auto first = [&](std::size_t a) { return brickOf(voxels.lower[a], edge, grid.dims()[a]); };
  Content content;
  for (int k = first(2); k <= last(2); ++k)
    for (int j = first(1); j <= last(1); ++j)
      for (int i = first(0); i <= last(0); ++i)
      {
        const std::uint8_t flags = grid.texels()[indexIn(grid.dims(), i, j, k)].flags;
        content.tissue = content.tissue || (flags & OccupancyGrid::Tissue) != 0;
        content.border = content.border || (flags & OccupancyGrid::Border) != 0;
      }
  return content;
}

// The stopped fraction of the voxels of a box, from their values and those of their neighbours.
template <class T>
class Block
{
public:
  Block(const VoxelField<T>& field, const OccupancyGrid& grid, const core::IndexBox& voxels,
        const core::Index3& dims)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      m_box.lower[a] = std::max(voxels.lower[a] - 1, 0);
      m_box.upper[a] = std::min(voxels.upper[a] + 1, dims[a]);
    }
    m_size = m_box.size();
    m_values.reserve(m_box.count());
    for (int k = m_box.lower[2]; k < m_box.upper[2]; ++k)
      for (int j = m_box.lower[1]; j < m_box.upper[1]; ++j)
        for (int i = m_box.lower[0]; i < m_box.upper[0]; ++i)
          m_values.push_back(
              field.at(i, j, k, (brickAt(grid, i, j, k).flags & OccupancyGrid::Labels) != 0));
  }

  struct Measure
  {
    double tissue;
    double stopped;
  };
  Measure at(int i, int j, int k) const
  {
    const core::Index3 at{i - m_box.lower[0], j - m_box.lower[1], k - m_box.lower[2]};
    const core::Index3 stride{1, m_size[0], m_size[0] * m_size[1]};
    const auto* here = &m_values[indexIn(m_size, at[0], at[1], at[2])];
    const bool inside = here->f > 0.0F;
    bool changes = false;
    double slope = 0.0; // squared, per voxel
    for (std::size_t a = 0; a < 3; ++a)
    {
      const int down = at[a] > 0 ? 1 : 0;
      const int up = at[a] + 1 < m_size[a] ? 1 : 0;
      const float low = here[-down * stride[a]].f;
      const float high = here[up * stride[a]].f;
      changes = changes || (low > 0.0F) != inside || (high > 0.0F) != inside;
      const double rise = static_cast<double>(high - low) / std::max(down + up, 1);
      slope += rise * rise;
    }
    const double share =
        changes && slope > 0.0
            ? std::clamp(0.5 + static_cast<double>(here->f) / std::sqrt(slope), 0.0, 1.0)
            : (inside ? 1.0 : 0.0);
    return {share, share * static_cast<double>(here->opacity)};
  }

private:
  core::IndexBox m_box;
  core::Index3 m_size{};
  std::vector<typename VoxelField<T>::Value> m_values;
};

} // namespace

OpacityPyramid::OpacityPyramid(const core::GridGeometry& ct)
  : m_grid(ct)
{
  double edge = kEdge;
  core::Index3 dims{};
  const auto choose = [&]
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double spacing = ct.spacing()[static_cast<Eigen::Index>(a)];
      m_factor[a] = std::clamp(static_cast<int>(std::lround(edge / spacing)), 1, ct.dims()[a]);
      dims[a] = (ct.dims()[a] + m_factor[a] - 1) / m_factor[a];
    }
    return core::IndexBox{{0, 0, 0}, dims}.count();
  };
  while (choose() > kMostTexels)
    edge *= 1.25;
  int levels = 1;
  for (double width = edge; width < kWidest; width *= 2.0)
    ++levels;
  // Whole texels on every level, so that all have the same scale.
  for (std::size_t a = 0; a < 3; ++a)
    dims[a] = roundedUp(dims[a], 1 << (levels - 1));
  for (int level = 0; level < levels; ++level)
  {
    m_levels.push_back({dims, std::vector<Texel>(core::IndexBox{{0, 0, 0}, dims}.count())});
    for (int& size : dims)
      size /= 2;
  }
}

core::IndexBox OpacityPyramid::boxAt(std::size_t level, const core::IndexBox& texels) noexcept
{
  core::IndexBox box = texels;
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] >>= level;
    box.upper[a] = (box.upper[a] + (1 << level) - 1) >> level;
  }
  return box;
}

core::IndexBox OpacityPyramid::voxelsOf(const core::IndexBox& texels) const noexcept
{
  core::IndexBox voxels;
  for (std::size_t a = 0; a < 3; ++a)
  {
    voxels.lower[a] = texels.lower[a] * m_factor[a];
    voxels.upper[a] = std::min(texels.upper[a] * m_factor[a], m_grid.dims()[a]);
  }
  return voxels;
}

void OpacityPyramid::update(const Scene& scene, const OccupancyGrid& grid,
                            const core::IndexBox& texels)
{
  if (scene.meshes && !scene.meshes->empty())
    keepTissue();
  const core::Index3& first = m_levels.front().dims;
  std::vector<Texel>& measured = m_tissue.empty() ? m_levels.front().texels : m_tissue;
  const core::Index3& dims = m_grid.dims();
  const auto around = [&](core::IndexBox voxels)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      voxels.lower[a] = std::max(voxels.lower[a] - 1, 0);
      voxels.upper[a] = std::min(voxels.upper[a] + 1, dims[a]);
    }
    return voxels;
  };
  const auto fill = [&](const core::IndexBox& block, const Texel& value)
  {
    for (int k = block.lower[2]; k < block.upper[2]; ++k)
      for (int j = block.lower[1]; j < block.upper[1]; ++j)
        std::fill_n(measured.begin() +
                        static_cast<std::ptrdiff_t>(indexIn(first, block.lower[0], j, k)),
                    block.upper[0] - block.lower[0], value);
  };
  const Texel nothing;
  const Texel inside{255,
                     inBits(255.0 * static_cast<double>(scene.materials.front().surfaceOpacity))};
  const std::size_t voxelsPerTexel = core::IndexBox{{0, 0, 0}, m_factor}.count();
  const double perTexel = 255.0 / static_cast<double>(voxelsPerTexel);
  scene.ct.visit(
      [&](const auto& ct)
      {
        using T = typename std::decay_t<decltype(ct)>::Value;
        const VoxelField<T> field(scene, ct);
        const auto measure = [&](const core::IndexBox& block)
        {
          const core::IndexBox voxels = voxelsOf(block);
          if (voxels.empty())
            return fill(block, nothing);
          const Content content = contentOf(grid, around(voxels));
          if (!content.tissue)
            return fill(block, nothing);
          if (!content.border && voxels.count() == block.count() * voxelsPerTexel)
            return fill(block, inside);
          const Block<T> values(field, grid, voxels, dims);
          for (int z = block.lower[2]; z < block.upper[2]; ++z)
            for (int y = block.lower[1]; y < block.upper[1]; ++y)
              for (int x = block.lower[0]; x < block.upper[0]; ++x)
              {
                const core::IndexBox part = voxelsOf({{x, y, z}, {x + 1, y + 1, z + 1}});
                double tissue = 0.0;
                double stopped = 0.0;
                for (int k = part.lower[2]; k < part.upper[2]; ++k)
                  for (int j = part.lower[1]; j < part.upper[1]; ++j)
                    for (int i = part.lower[0]; i < part.upper[0]; ++i)
                    {
                      const auto own = values.at(i, j, k);
                      tissue += own.tissue;
                      stopped += own.stopped;
                    }
                measured[indexIn(first, x, y, z)] = {inBits(perTexel * tissue),
                                                     inBits(perTexel * stopped)};
              }
        };
        tbb::parallel_for(
            tbb::blocked_range<int>(texels.lower[2] / kBlock,
                                    (texels.upper[2] + kBlock - 1) / kBlock),
            [&](const tbb::blocked_range<int>& layers)
            {
              for (int z = layers.begin(); z < layers.end(); ++z)
                for (int y = texels.lower[1] / kBlock; y * kBlock < texels.upper[1]; ++y)
                  for (int x = texels.lower[0] / kBlock; x * kBlock < texels.upper[0]; ++x)
                    measure(core::IndexBox{{x * kBlock, y * kBlock, z * kBlock},
                                           {(x + 1) * kBlock, (y + 1) * kBlock, (z + 1) * kBlock}}
                                .intersected(texels));
            });
      });
  combine(scene, texels);
}

// From now on the tissue is also kept without the meshes.
void OpacityPyramid::keepTissue()
{
  if (m_tissue.empty())
    m_tissue = m_levels.front().texels;
}

// The first level from the tissue and the meshes, and the levels above it.
void OpacityPyramid::combine(const Scene& scene, const core::IndexBox& texels)
{
  Level& first = m_levels.front();
  if (!m_tissue.empty())
    for (int k = texels.lower[2]; k < texels.upper[2]; ++k)
      for (int j = texels.lower[1]; j < texels.upper[1]; ++j)
      {
        const auto row = static_cast<std::ptrdiff_t>(indexIn(first.dims, texels.lower[0], j, k));
        std::copy_n(m_tissue.begin() + row, texels.size()[0], first.texels.begin() + row);
      }
  if (scene.meshes)
    for (const Mesh& mesh : *scene.meshes)
      addMesh(mesh, scene.mask, texels);
  m_stopping = m_stopping.united(stoppingIn(texels));
  for (std::size_t level = 1; level < m_levels.size(); ++level)
    reduce(level, boxAt(level, texels));
}

core::IndexBox OpacityPyramid::stoppingIn(const core::IndexBox& texels) const
{
  const Level& first = m_levels.front();
  const auto stops = [](const Texel& texel) { return texel.tissue > 0; };
  core::IndexBox found;
  for (int k = texels.lower[2]; k < texels.upper[2]; ++k)
    for (int j = texels.lower[1]; j < texels.upper[1]; ++j)
    {
      const Texel* row = first.texels.data() + indexIn(first.dims, 0, j, k);
      const Texel* end = row + texels.upper[0];
      const Texel* lower = std::find_if(row + texels.lower[0], end, stops);
      if (lower == end)
        continue;
      while (!stops(end[-1]))
        --end;
      found = found.united(
          {{static_cast<int>(lower - row), j, k}, {static_cast<int>(end - row), j + 1, k + 1}});
    }
  return found;
}

// The mask's mean is what the drill left of a texel.
void OpacityPyramid::addMesh(const Mesh& mesh, const volume::CutMask* mask,
                             const core::IndexBox& texels)
{
  const core::IndexBox& own = mesh.shares->box;
  const core::IndexBox box = own.intersected(texels);
  if (box.empty())
    return;
  const bool isCut = mesh.drilled && mask && !mask->untouched(voxelsOf(box));
  const auto left = [&](const core::IndexBox& voxels)
  {
    if (!isCut || mask->untouched(voxels))
      return 1.0;
    double sum = 0.0;
    for (int k = voxels.lower[2]; k < voxels.upper[2]; ++k)
      for (int j = voxels.lower[1]; j < voxels.upper[1]; ++j)
        for (int i = voxels.lower[0]; i < voxels.upper[0]; ++i)
          sum += mask->at(i, j, k);
    return sum / (static_cast<double>(voxels.count()) * volume::CutMask::kUntouched);
  };
  Level& first = m_levels.front();
  const core::Index3 size = own.size();
  const auto addLayer = [&](int k)
  {
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        double share =
            mesh.shares
                ->shares[indexIn(size, i - own.lower[0], j - own.lower[1], k - own.lower[2])];
        if (!(share > 0.0))
          continue;
        share *= left(voxelsOf({{i, j, k}, {i + 1, j + 1, k + 1}}));
        Texel& texel = first.texels[indexIn(first.dims, i, j, k)];
        texel.tissue = std::max(texel.tissue, inBits(share));
        texel.stopped = std::max(texel.stopped, inBits(share * mesh.opacity));
      }
  };
  tbb::parallel_for(tbb::blocked_range<int>(box.lower[2], box.upper[2]),
                    [&](const tbb::blocked_range<int>& layers)
                    {
                      for (int k = layers.begin(); k < layers.end(); ++k)
                        addLayer(k);
                    });
}

void OpacityPyramid::meshesChanged(const Scene& scene, const core::IndexBox& texels)
{
  const core::IndexBox box = texels.intersected({{0, 0, 0}, m_levels.front().dims});
  if (box.empty())
    return;
  keepTissue();
  combine(scene, box);
  if (!scene.meshes || scene.meshes->empty())
    m_tissue = {};
}

void OpacityPyramid::reduce(std::size_t level, const core::IndexBox& texels)
{
  const Level& finer = m_levels[level - 1];
  Level& own = m_levels[level];
  tbb::parallel_for(
      tbb::blocked_range<int>(texels.lower[2], texels.upper[2]),
      [&](const tbb::blocked_range<int>& layers)
      {
        for (int k = layers.begin(); k < layers.end(); ++k)
          for (int j = texels.lower[1]; j < texels.upper[1]; ++j)
            for (int i = texels.lower[0]; i < texels.upper[0]; ++i)
            {
              unsigned tissue = 4; // rounded
              unsigned stopped = 4;
              for (int n = 0; n < 8; ++n)
              {
                const Texel& part = finer.texels[indexIn(finer.dims, 2 * i + (n & 1),
                                                         2 * j + (n >> 1 & 1), 2 * k + (n >> 2))];
                tissue += part.tissue;
                stopped += part.stopped;
              }
              own.texels[indexIn(own.dims, i, j, k)] = {static_cast<std::uint8_t>(tissue / 8),
                                                        static_cast<std::uint8_t>(stopped / 8)};
            }
      });
}

void OpacityPyramid::rebuild(const Scene& scene, const OccupancyGrid& grid)
{
  m_stopping = {};
  m_tissue = {};
  update(scene, grid, {{0, 0, 0}, m_levels.front().dims});
}

core::IndexBox OpacityPyramid::maskChanged(const Scene& scene, const OccupancyGrid& grid,
                                           const core::IndexBox& voxels)
{
  core::IndexBox texels;
  for (std::size_t a = 0; a < 3; ++a) // the values of neighbours take part
  {
    texels.lower[a] = std::max(voxels.lower[a] - 1, 0) / m_factor[a];
    texels.upper[a] =
        std::min((voxels.upper[a] + m_factor[a]) / m_factor[a], m_levels.front().dims[a]);
  }
  if (texels.empty())
    return {};
  update(scene, grid, texels);
  return texels;
}

std::size_t OpacityPyramid::bytes() const noexcept
{
  std::size_t bytes = m_tissue.size() * sizeof(Texel);
  for (const Level& level : m_levels)
    bytes += level.texels.size() * sizeof(Texel);
  return bytes;
}

} // namespace petrous::rendering
