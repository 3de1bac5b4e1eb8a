#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "GlTexture.h"
#include "OccupancyGrid.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Reduction factor along each axis (1: none) for the driver to accept a volume, with no edge
/// longer than `largest` texels; 0: only the driver's limit.
core::Index3 reductionFor(const TexelFormat& format, core::Index3 dims, int largest);

/// Texels along each axis after reduction.
core::Index3 reducedDims(const core::Index3& dims, const core::Index3& factor);

/// Maps voxel position to texture coordinate, per axis: v * scale + offset.
struct TextureMap
{
  Eigen::Vector3d scale{1.0, 1.0, 1.0};
  Eigen::Vector3d offset{0.0, 0.0, 0.0};
};
TextureMap textureMap(const core::Index3& dims, const core::Index3& factor);

/// Means of `at(i, j, k)` over blocks of `factor` voxels, for a box of texels.
template <class T, class At>
std::vector<T> reduceBox(const core::Index3& dims, const core::Index3& factor,
                         const core::IndexBox& texels, const At& at)
{
  const core::Index3 size = texels.size();
  std::vector<T> result(texels.count());
  const auto meanOf = [&](int x, int y, int z)
  {
    double sum = 0.0;
    int count = 0;
    for (int k = z * factor[2]; k < std::min((z + 1) * factor[2], dims[2]); ++k)
      for (int j = y * factor[1]; j < std::min((y + 1) * factor[1], dims[1]); ++j)
        for (int i = x * factor[0]; i < std::min((x + 1) * factor[0], dims[0]); ++i, ++count)
          sum += static_cast<double>(at(i, j, k));
    return static_cast<T>(sum / count);
  };
  tbb::parallel_for(
      tbb::blocked_range<int>(0, size[2]),
      [&](const tbb::blocked_range<int>& slices)
      {
        for (int z = slices.begin(); z < slices.end(); ++z)
          for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x)
              result[static_cast<std::size_t>(x) +
                     static_cast<std::size_t>(size[0]) *
                         (static_cast<std::size_t>(y) +
                          static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(z))] =
                  meanOf(texels.lower[0] + x, texels.lower[1] + y, texels.lower[2] + z);
      });
  return result;
}

/// A CT or another image in its native type; intensity = texel * unit.
struct IntensityTexture
{
  GlTexture texture;
  TextureMap map;
  core::Index3 reduction{1, 1, 1};
  double unit = 1.0;

  /// largest: see RenderQuality::largestTexture.
  void upload(const volume::IntensityVolume& volume, int largest);
};

/// The cut mask on the CT's grid. Edits are collected and uploaded with the next frame, up to a
/// maximum number of voxels; the rest is deferred.
class MaskTexture
{
public:
  static constexpr std::size_t kVoxelsPerFrame = std::size_t{4} << 20U;

  /// Sets another mask (null: none) or another precision; everything is uploaded again.
  void reset(std::shared_ptr<const volume::CutMask> mask, int bits, int largest);

  /// Marks the voxels of a box as changed. Touching boxes are merged.
  void changed(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  /// Detects unreported changes of the mask by comparing brick versions. Returns whether there were
  /// any.
  bool compare();

  /// Call on the render thread before a frame.
  void upload();
  void release();

  const GlTexture& texture() const noexcept { return m_texture; }
  const TextureMap& map() const noexcept { return m_map; }
  std::size_t pendingVoxels() const noexcept;
  bool inUse() const noexcept { return static_cast<bool>(m_mask); }

private:
  void uploadBox(const core::IndexBox& box);
  template <class T>
  void uploadAs(const core::IndexBox& texels);

  std::shared_ptr<const volume::CutMask> m_mask;
  int m_bits = 16;
  int m_largest = 0;
  GlTexture m_texture;
  TextureMap m_map;
  core::Index3 m_reduction{1, 1, 1};
  std::vector<core::IndexBox> m_pending;
  std::vector<volume::CutMask::BrickVersion> m_uploaded;
};

struct LabelTextures
{
  GlTexture occupancy;
  GlTexture index;
  TextureMap map; ///< of the occupancy; index texel = voxel / reduction
  core::Index3 reduction{1, 1, 1};
  bool borders = false; ///< the index texture has a second channel, LabelField::borders

  /// Reduced labels have no borders. largest: see RenderQuality::largestTexture.
  void upload(const volume::LabelField& labels, int largest);
  void release();
};

/// Distances to a structure; mm = texel * unit.
struct ThicknessTexture
{
  static constexpr double kReach = 2.0; ///< values are clamped to this multiple of `farthest`

  GlTexture texture;
  TextureMap map;
  double unit = 1.0;

  void upload(const ThicknessOverlay& overlay);
};

/// Material lookup tables over intensity; see RayCast.frag.glsl.
struct MaterialTables
{
  GlTexture look;
  GlTexture depth;
  GlTexture material;

  /// `ranges`: of the images' intensities, in the order of appearance::IntensitySource.
  void upload(const std::vector<appearance::Material>& materials, int tableSize,
              const std::array<volume::ValueRange, 3>& ranges);
  void release();
};

} // namespace petrous::rendering
