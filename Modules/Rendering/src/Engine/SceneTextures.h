#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "GlTexture.h"
#include "OccupancyGrid.h"
#include "TextureReduction.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// A CT or second image in its native type; intensity = texel * unit.
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

  /// `ct`, `second`: the images' intensity ranges.
  void upload(const std::vector<appearance::Material>& materials, int tableSize,
              const volume::ValueRange& ct, const volume::ValueRange& second);
  void release();
};

} // namespace petrous::rendering
