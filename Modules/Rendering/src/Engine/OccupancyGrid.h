#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::rendering
{

/// Empty-space skipping: bricks of edge^3 cells of the CT's grid, each with flags for its content
/// and the distance to the next brick that a ray must sample. Plain data on the CPU; one texel per
/// brick.
///
/// Brick b covers the positions [b edge, (b + 1) edge] between voxel centres on each axis, plus the
/// support of interpolation (one more voxel). Flags are conservative: an unset flag excludes its
/// condition. A distance is 0 exactly where its flag is set.
class OccupancyGrid
{
public:
  static constexpr int kLargestDistance = 15;

  enum Flag : std::uint8_t
  {
    Mixed = 1,   ///< the mask is not 1 throughout
    Labels = 2,  ///< a label's occupancy exceeds 0.499
    Tissue = 4,  ///< f may exceed 0
    Inside = 8,  ///< a ray inside tissue may see something: air, a label, or opacity
    Border = 16, ///< a ray inside bone may leave it: air, or a label
    Soft = 32    ///< a ray in soft tissue may see something: opacity, tissue, or a cut
  };

  struct Texel
  {
    std::uint8_t toTissue =
        0; ///< Chebyshev distance in bricks to the next with Tissue; 0: this one
    std::uint8_t toInside = 0; ///< as toTissue, for Inside
    std::uint8_t flags = 0;
    std::uint8_t toSoft = 0; ///< as toTissue, for Soft; without soft tissue 0
  };

  /// Parameters of the flags.
  struct Rules
  {
    double iso = 300.0;
    bool bone = true;     ///< whether the CT is part of f
    bool interior = true; ///< false: rays end at the first surface, and every brick is Inside
    /// Intensities at which bone has opacity: closed ranges, ascending; empty: none.
    std::vector<volume::ValueRange> opaque;
    /// Bone's appearance does not depend on the CT: never skip inside.
    bool interiorEverywhere = false;
    bool soft = false; ///< whether soft tissue is drawn; likewise its ranges
    std::vector<volume::ValueRange> softOpaque;
    bool softEverywhere = false;
  };

  /// Reads every voxel once (in parallel); the texels follow the default rules, without labels and
  /// mask. edge: 4, 8 or 16 voxels, otherwise throws InvalidParameter.
  OccupancyGrid(const volume::IntensityVolume& ct, int edge);

  /// Recomputes every brick; the label field is read only if it is not the previous one.
  void rebuild(const Rules& rules, const volume::LabelField* labels, const volume::CutMask* mask);

  /// The mask decreased or increased in a box of voxels. Returns the box of bricks whose texels,
  /// including distances, changed; the result equals that of a rebuild.
  core::IndexBox maskChanged(const volume::CutMask* mask, const core::IndexBox& voxels);

  const core::Index3& dims() const noexcept { return m_dims; }
  int edge() const noexcept { return m_edge; }
  const std::vector<Texel>& texels() const noexcept { return m_texels; } ///< first axis fastest
  std::size_t bytes() const noexcept;

  /// Range of the finite intensities; 0 to 0 if there are none.
  volume::ValueRange range() const noexcept;

private:
  struct Changes
  {
    core::IndexBox added; // bricks in which the flag of one distance was set, or cleared
    core::IndexBox removed;
  };

  template <class T>
  void readIntensities(const volume::Volume<T>& ct);
  void readLabels(const volume::LabelField* labels);
  std::size_t texelIndex(int i, int j, int k) const noexcept;
  core::IndexBox reach(int i, int j, int k) const noexcept;
  std::uint8_t judge(std::size_t brick, const volume::CutMask* mask,
                     const core::IndexBox& voxels) const;
  core::IndexBox affected(const Changes& changes, std::uint8_t Texel::*distance) const;
  core::IndexBox measure(const core::IndexBox& box, Flag flag, std::uint8_t Texel::*distance);

  core::GridGeometry m_grid;
  int m_edge;
  core::Index3 m_dims{};
  std::vector<float> m_min; // of the CT, per brick; -inf if a voxel has no value
  std::vector<float> m_max;
  std::vector<Texel> m_texels;
  std::vector<std::uint8_t> m_solid;                      // LabelBricks.h; empty: no labels
  std::weak_ptr<const volume::Volume<float>> m_occupancy; // source of m_solid
  Rules m_rules;
};

} // namespace petrous::rendering
