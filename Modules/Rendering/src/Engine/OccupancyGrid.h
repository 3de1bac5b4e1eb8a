#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::rendering
{

/// What a ray can skip: bricks of edge^3 cells of the CT's grid, each with what it holds and how
/// far the next brick is that a ray must look into. Plain data on the CPU; one texel a brick.
///
/// Brick b covers the positions [b edge, (b + 1) edge] between voxel centres on each axis; what
/// interpolation there can reach (one voxel more) is counted in. Flags err to one side only: one
/// that is not set rules out what it stands for. A distance is 0 exactly where its flag is set.
class OccupancyGrid
{
public:
  static constexpr int kLargestDistance = 15;

  enum Flag : std::uint8_t
  {
    Mixed = 1,  ///< the mask is not 1 throughout
    Labels = 2, ///< an occupancy of a label above 0.499
    Tissue = 4, ///< f may exceed 0
    Inside = 8, ///< a ray inside tissue has something to see: air, a label, or opacity
    Border = 16 ///< a ray inside bone may come to an end of it: air, or a label
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
    bool interior = true; ///< false: rays end at the first surface; every brick is then Inside
    /// Intensities at which bone has opacity, closed ranges, rising; empty: nowhere.
    std::vector<volume::ValueRange> opaque;
    bool interiorEverywhere = false; ///< bone's look does not come from the CT: never skip inside
  };

  /// Reads every voxel once (in parallel); the texels are those of the default rules, without
  /// labels and mask. edge: 4, 8 or 16 voxels, else InvalidParameter.
  OccupancyGrid(const volume::IntensityVolume& ct, int edge);

  /// Judges every brick anew; the label field is read only when it is another one than before.
  void rebuild(const Rules& rules, const volume::LabelField* labels, const volume::CutMask* mask);

  /// The mask changed in a box of voxels, to less or to more. Returns the box of bricks whose
  /// texels changed, distances included; afterwards the texels are as after a rebuild.
  core::IndexBox maskChanged(const volume::CutMask* mask, const core::IndexBox& voxels);

  const core::Index3& dims() const noexcept { return m_dims; }
  int edge() const noexcept { return m_edge; }
  const std::vector<Texel>& texels() const noexcept { return m_texels; } ///< first axis fastest
  std::size_t bytes() const noexcept;

  /// The intensities that occur, without those that are no numbers; 0 to 0 where none is left.
  volume::ValueRange range() const noexcept;

private:
  struct Changes
  {
    core::IndexBox added; // bricks that the flag of one distance came to, or left
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
  std::vector<float> m_min; // of the CT, per brick; -inf where a voxel has no value
  std::vector<float> m_max;
  std::vector<Texel> m_texels;
  std::vector<std::uint8_t> m_solid;                  // LabelBricks.h; empty: no labels
  std::weak_ptr<const volume::Volume<float>> m_occupancy; // that m_solid is of
  Rules m_rules;
};

} // namespace petrous::rendering
