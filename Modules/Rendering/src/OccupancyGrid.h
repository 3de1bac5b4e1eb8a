#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::rendering
{

/// What a ray can skip: bricks of kEdge^3 cells of the CT's grid, each with what it holds and how
/// far the next brick is that a ray must look into. Plain data on the CPU; one texel a brick.
///
/// Brick b covers the positions [b kEdge, (b + 1) kEdge] between voxel centres on each axis; what
/// interpolation there can reach (one voxel more) is counted in.
class OccupancyGrid
{
public:
  static constexpr int kLargestDistance = 15;

  enum Flag : std::uint8_t
  {
    Mixed = 1,  ///< the mask is not 1 throughout
    Labels = 2, ///< an index or a share of a label
    Tissue = 4, ///< f may exceed 0
    Inside = 8  ///< a ray inside tissue has something to see: air, a label, or opacity
  };

  struct Texel
  {
    std::uint8_t toTissue =
        0; ///< Chebyshev distance in bricks to the next with Tissue; 0: this one
    std::uint8_t toInside = 0; ///< the same for Inside
    std::uint8_t flags = 0;
    std::uint8_t unused = 0;
  };

  /// What the flags are judged by.
  struct Rules
  {
    double iso = 300.0;
    bool bone = true;     ///< whether the CT takes part in f
    bool interior = true; ///< false: rays end at the first surface; Inside is not needed
    /// Intensities at which bone has opacity, closed ranges, rising; empty: nowhere.
    std::vector<volume::ValueRange> opaque;
    bool interiorEverywhere = false; ///< bone's look does not come from the CT: never skip inside
  };

  /// Reads every voxel once (in parallel). edge: 4, 8 or 16 voxels.
  OccupancyGrid(const volume::IntensityVolume& ct, int edge);

  /// Judges every brick anew.
  void rebuild(const Rules& rules, const volume::LabelField* labels, const volume::CutMask* mask);

  /// The mask changed in a box of voxels, to less or to more. Returns the box of bricks whose
  /// texels changed, distances included; afterwards the texels are as after a rebuild.
  core::IndexBox maskChanged(const volume::CutMask* mask, const core::IndexBox& voxels);

  const core::Index3& dims() const noexcept { return m_dims; }
  int edge() const noexcept { return m_edge; }
  const std::vector<Texel>& texels() const noexcept { return m_texels; } ///< first axis fastest
  std::size_t bytes() const noexcept;

private:
  core::GridGeometry m_grid;
  int m_edge;
  core::Index3 m_dims{};
  std::vector<float> m_min; // of the CT, per brick
  std::vector<float> m_max;
  std::vector<Texel> m_texels;
  std::vector<std::uint8_t> m_labelFlags;
  Rules m_rules;
};

} // namespace petrous::rendering
