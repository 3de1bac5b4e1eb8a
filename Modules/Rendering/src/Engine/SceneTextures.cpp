#include "SceneTextures.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <type_traits>
#include <utility>

#include "petrous/Core/Log.h"

namespace petrous::rendering
{

core::Index3 reducedDims(const core::Index3& dims, const core::Index3& factor)
{
  core::Index3 result;
  for (std::size_t a = 0; a < 3; ++a)
    result[a] = (dims[a] + factor[a] - 1) / factor[a];
  return result;
}

core::Index3 reductionFor(const TexelFormat& format, core::Index3 dims, int largest)
{
  core::Index3 factor{1, 1, 1};
  const core::Index3 whole = dims;
  const auto fits = [&](std::size_t longest)
  { return (largest == 0 || dims[longest] <= largest) && GlTexture::fits(format, dims); };
  for (;;)
  {
    const auto longest =
        static_cast<std::size_t>(std::max_element(dims.begin(), dims.end()) - dims.begin());
    if (fits(longest))
      break;
    if (dims[longest] == 1)
      break; // even one texel is refused: the upload reports the error
    factor[longest] *= 2;
    dims = reducedDims(whole, factor);
  }
  return factor;
}

TextureMap textureMap(const core::Index3& dims, const core::Index3& factor)
{
  const core::Index3 texels = reducedDims(dims, factor);
  TextureMap map;
  for (int a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<std::size_t>(a);
    // The centre of block t lies at voxel factor * t + (factor - 1) / 2.
    map.scale[a] = 1.0 / (static_cast<double>(factor[axis]) * texels[axis]);
    map.offset[a] = (0.5 - 0.5 * (factor[axis] - 1.0) / factor[axis]) / texels[axis];
  }
  return map;
}

namespace
{

core::IndexBox wholeBox(const core::Index3& dims)
{
  return {{0, 0, 0}, dims};
}

// Texture value of a voxel without a value: far below every threshold, and finite, so that it does
// not propagate, as is the square of a gradient towards it.
constexpr float kNoValue = -1e15F;

template <class T>
TexelFormat formatOf()
{
  if constexpr (std::is_same_v<T, std::int16_t>)
    return texel::kShort;
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return texel::kUnsignedShort;
  else
    return texel::kFloat;
}

template <class T>
double unitOf()
{
  return std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
}

// A copy with NaN and infinities replaced; empty if there are none.
std::vector<float> cleaned(const float* values, std::size_t count)
{
  if (std::all_of(values, values + count, [](float v) { return std::isfinite(v); }))
    return {};
  std::vector<float> copy;
  copy.reserve(count);
  std::transform(values, values + count, std::back_inserter(copy),
                 [](float value)
                 { return std::isnan(value) ? kNoValue : std::clamp(value, kNoValue, -kNoValue); });
  return copy;
}

} // namespace

void IntensityTexture::upload(const volume::IntensityVolume& volume, int largest)
{
  volume.visit(
      [this, largest](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        const core::Index3& dims = voxels.geometry().dims();
        const TexelFormat format = formatOf<T>();
        reduction = reductionFor(format, dims, largest);
        map = textureMap(dims, reduction);
        unit = unitOf<T>();
        if (reduction != core::Index3{1, 1, 1})
        {
          const core::Index3 texels = reducedDims(dims, reduction);
          core::log::warning("ray caster: a volume is drawn reduced, every " +
                             std::to_string(reduction[0]) + " x " + std::to_string(reduction[1]) +
                             " x " + std::to_string(reduction[2]) + " voxels");
          const auto reduced = reduceBox<T>(dims, reduction, wholeBox(texels),
                                            [&voxels](int i, int j, int k)
                                            {
                                              const T value = voxels.at(i, j, k);
                                              if constexpr (std::is_same_v<T, float>)
                                                return std::isfinite(value) ? value : kNoValue;
                                              else
                                                return value;
                                            });
          texture.create(format, texels, reduced.data(), GL_LINEAR);
          return;
        }
        if constexpr (std::is_same_v<T, float>)
          if (const auto copy = cleaned(voxels.data(), voxels.size()); !copy.empty())
          {
            texture.create(format, dims, copy.data(), GL_LINEAR);
            return;
          }
        texture.create(format, dims, voxels.data(), GL_LINEAR);
      });
}

// ---- mask

void MaskTexture::reset(std::shared_ptr<const volume::CutMask> mask, int bits, int largest)
{
  m_mask = std::move(mask);
  m_bits = bits;
  m_largest = largest;
  m_pending.clear();
  m_reduction = {0, 0, 0}; // computed by upload
}

void MaskTexture::changed(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box)
{
  m_mask = std::move(mask);
  if (!m_mask || m_reduction[0] == 0)
    return; // nothing to show, or everything is uploaded anyway
  core::IndexBox merged = box.intersected(m_mask->geometry().fullBox());
  if (merged.empty())
    return;
  // Merge boxes if the union is hardly larger than its parts.
  for (auto other = m_pending.begin(); other != m_pending.end();)
  {
    const core::IndexBox both = merged.united(*other);
    if (both.count() <= (merged.count() + other->count()) * 5 / 4)
    {
      merged = both;
      m_pending.erase(other);
      other = m_pending.begin();
    }
    else
      ++other;
  }
  m_pending.push_back(merged);
}

bool MaskTexture::compare()
{
  if (!m_mask || m_reduction[0] == 0)
    return false;
  bool any = false;
  for (std::size_t brick = 0; brick < m_uploaded.size(); ++brick)
    if (m_uploaded[brick] != m_mask->brick(brick))
    {
      changed(m_mask, m_mask->brickBox(brick));
      any = true;
    }
  return any;
}

std::size_t MaskTexture::pendingVoxels() const noexcept
{
  std::size_t voxels = 0;
  for (const core::IndexBox& box : m_pending)
    voxels += box.count();
  return voxels;
}

template <class T>
void MaskTexture::uploadAs(const core::IndexBox& texels)
{
  const volume::CutMask& mask = *m_mask;
  const core::Index3& dims = mask.geometry().dims();
  if (m_reduction != core::Index3{1, 1, 1})
  {
    const auto reduced = reduceBox<T>(dims, m_reduction, texels,
                                      [&mask](int i, int j, int k)
                                      {
                                        constexpr int shift = sizeof(T) == 1 ? 8 : 0;
                                        return mask.at(i, j, k) >> shift;
                                      });
    m_texture.update(texels, reduced.data());
    return;
  }
  std::vector<T> values(texels.count(), std::numeric_limits<T>::max());
  const core::Index3 size = texels.size();
  const core::IndexBox bricks = mask.bricksCovering(texels);
  constexpr int edge = volume::CutMask::kBrickEdge;
  for (int bk = bricks.lower[2]; bk < bricks.upper[2]; ++bk)
    for (int bj = bricks.lower[1]; bj < bricks.upper[1]; ++bj)
      for (int bi = bricks.lower[0]; bi < bricks.upper[0]; ++bi)
      {
        const std::size_t index = mask.brickIndex({bi, bj, bk});
        const auto& brick = mask.brick(index);
        if (!brick)
          continue;
        const core::IndexBox part = mask.brickBox(index).intersected(texels);
        for (int k = part.lower[2]; k < part.upper[2]; ++k)
          for (int j = part.lower[1]; j < part.upper[1]; ++j)
          {
            const std::uint16_t* from = brick->data() + (part.lower[0] - bi * edge) +
                                        edge * ((j - bj * edge) + edge * (k - bk * edge));
            T* to = values.data() + (part.lower[0] - texels.lower[0]) +
                    static_cast<std::ptrdiff_t>(size[0]) *
                        ((j - texels.lower[1]) +
                         static_cast<std::ptrdiff_t>(size[1]) * (k - texels.lower[2]));
            for (int i = part.lower[0]; i < part.upper[0]; ++i, ++from, ++to)
              *to = sizeof(T) == 1 ? static_cast<T>((*from + 128U) / 257U) : static_cast<T>(*from);
          }
      }
  m_texture.update(texels, values.data());
}

void MaskTexture::uploadBox(const core::IndexBox& box)
{
  core::IndexBox texels;
  for (std::size_t a = 0; a < 3; ++a)
  {
    texels.lower[a] = box.lower[a] / m_reduction[a];
    texels.upper[a] = (box.upper[a] + m_reduction[a] - 1) / m_reduction[a];
  }
  if (m_bits == 8)
    uploadAs<std::uint8_t>(texels);
  else
    uploadAs<std::uint16_t>(texels);
  const core::IndexBox bricks = m_mask->bricksCovering(box);
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
      {
        const std::size_t brick = m_mask->brickIndex({i, j, k});
        m_uploaded[brick] = m_mask->brick(brick);
      }
}

void MaskTexture::upload()
{
  if (!m_mask)
  {
    m_texture.release();
    return;
  }
  if (m_reduction[0] == 0)
  {
    const TexelFormat format = m_bits == 8 ? texel::kByte : texel::kUnsignedShort;
    const core::Index3& dims = m_mask->geometry().dims();
    m_reduction = reductionFor(format, dims, m_largest);
    m_map = textureMap(dims, m_reduction);
    m_texture.create(format, reducedDims(dims, m_reduction), nullptr, GL_LINEAR);
    const std::uint16_t untouched = volume::CutMask::kUntouched;
    m_texture.fill(&untouched);
    m_pending.clear();
    m_uploaded.assign(m_mask->brickCount(), nullptr);
    for (std::size_t brick = 0; brick < m_mask->brickCount(); ++brick)
      if (m_mask->brick(brick))
        uploadBox(m_mask->brickBox(brick));
    return;
  }
  std::size_t room = kVoxelsPerFrame;
  while (!m_pending.empty() && room > 0)
  {
    core::IndexBox& box = m_pending.front();
    const core::Index3 size = box.size();
    const std::size_t slice = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    const int slices = static_cast<int>(std::min<std::size_t>(
        std::max<std::size_t>(room / slice, 1), static_cast<std::size_t>(size[2])));
    core::IndexBox part = box;
    part.upper[2] = part.lower[2] + slices;
    uploadBox(part);
    room -= std::min(room, slice * static_cast<std::size_t>(slices));
    box.lower[2] += slices;
    if (box.empty())
      m_pending.erase(m_pending.begin());
  }
}

void MaskTexture::release()
{
  m_texture.release();
  m_reduction = {0, 0, 0};
  m_pending.clear();
}

// ---- labels

void LabelTextures::upload(const volume::LabelField& labels, int largest)
{
  const volume::Volume<float>& occupancies = *labels.occupancy;
  const core::Index3& dims = occupancies.geometry().dims();
  // 16 bits store an occupancy exactly: its resolution is 1/65535.
  const auto inSixteenBits = [](float value)
  {
    // As std::lround, but vectorized: adding 1/2 is exact in double.
    const double steps = 65535.0F * std::clamp(value, 0.0F, 1.0F);
    return static_cast<std::uint16_t>(static_cast<int>(steps + 0.5));
  };
  reduction = reductionFor(texel::kUnsignedShort, dims, largest);
  map = textureMap(dims, reduction);
  const core::Index3 texels = reducedDims(dims, reduction);
  const bool whole = reduction == core::Index3{1, 1, 1};
  borders = whole && labels.borders;
  if (whole)
  {
    // Some slices at a time: no second copy of the whole volume.
    constexpr int kSlices = 16;
    const std::size_t slice = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]);
    std::vector<std::uint16_t> values(slice * static_cast<std::size_t>(std::min(kSlices, dims[2])));
    const auto fill =
        [&](GlTexture& texture, const TexelFormat& format, GLint filter, const auto& valueAt)
    {
      texture.create(format, dims, nullptr, filter);
      for (int k = 0; k < dims[2]; k += kSlices)
      {
        const core::IndexBox part{{0, 0, k}, {dims[0], dims[1], std::min(k + kSlices, dims[2])}};
        const std::size_t first = slice * static_cast<std::size_t>(k);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.count(), 1U << 16U),
                          [&](const tbb::blocked_range<std::size_t>& range)
                          {
                            for (std::size_t i = range.begin(); i < range.end(); ++i)
                              values[i] = valueAt(first + i);
                          });
        texture.update(part, values.data());
      }
    };
    fill(occupancy, texel::kUnsignedShort, GL_LINEAR,
         [&](std::size_t i) { return inSixteenBits(occupancies.data()[i]); });
    if (!borders)
    {
      index.create(texel::kIndex, dims, labels.index->data(), GL_NEAREST);
      return;
    }
    fill(index, texel::kIndexPair, GL_NEAREST,
         [&](std::size_t i)
         {
           const std::uint8_t pair[2] = {labels.index->data()[i], labels.borders->data()[i]};
           std::uint16_t both = 0;
           std::memcpy(&both, pair, sizeof both);
           return both;
         });
    return;
  }
  const auto means = reduceBox<std::uint16_t>(dims, reduction, wholeBox(texels),
                                              [&](int i, int j, int k)
                                              { return inSixteenBits(occupancies.at(i, j, k)); });
  occupancy.create(texel::kUnsignedShort, texels, means.data(), GL_LINEAR);
  std::vector<std::uint8_t> indices(means.size());
  std::size_t texel = 0;
  // Labels cannot be averaged: take that of the block's voxel with the greatest occupancy.
  for (int z = 0; z < texels[2]; ++z)
    for (int y = 0; y < texels[1]; ++y)
      for (int x = 0; x < texels[0]; ++x, ++texel)
      {
        float most = -1.0F;
        for (int k = z * reduction[2]; k < std::min((z + 1) * reduction[2], dims[2]); ++k)
          for (int j = y * reduction[1]; j < std::min((y + 1) * reduction[1], dims[1]); ++j)
            for (int i = x * reduction[0]; i < std::min((x + 1) * reduction[0], dims[0]); ++i)
              if (labels.index->at(i, j, k) != 0 && occupancies.at(i, j, k) > most)
              {
                most = occupancies.at(i, j, k);
                indices[texel] = labels.index->at(i, j, k);
              }
      }
  index.create(texel::kIndex, texels, indices.data(), GL_NEAREST);
}

void LabelTextures::release()
{
  occupancy.release();
  index.release();
}

} // namespace petrous::rendering
