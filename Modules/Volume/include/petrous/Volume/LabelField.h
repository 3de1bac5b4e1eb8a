#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::volume
{

/// One structure contributing to a label field.
struct LabelSource
{
  std::shared_ptr<const LabelMap> labels;
  std::uint16_t segment = 0; ///< its voxel value in `labels`
  std::uint8_t material = 0; ///< value in `LabelField::index`, >= 1; sources may share one
  bool solid = true;         ///< false: a lumen, with an index but no occupancy
};

/// Combines structures, each on the grid of its file, into the two channels that rendering and
/// haptics sample [Chan2013, 2.1-2.2]: a smoothed union and a dilated index, on one grid.
///
/// If the maps share a grid nothing is resampled: the field has that grid, cropped to the bounding
/// box of the structures or extended beyond it, with a margin of two voxels. Otherwise it is the
/// grid of the finest map (the smallest voxel volume; of the maps with a solid structure, if there
/// is one, so that a lumen does not affect haptics), extended over all of them. Resampling, and the
/// treatment of thin structures, are described in src/Labels/LabelResampling.h. Structures of
/// different grids are combined by maximum occupancy, so between two that only touch there may be a
/// crease where their occupancies are 1/2.
struct LabelField
{
  /// Smoothed union of the solid sources, 0 to 1, in steps of 1/65535 (exact in a 16-bit texture);
  /// its 0.5 level is their surface. See SmoothedUnion.h.
  std::shared_ptr<const Volume<float>> occupancy;

  /// Material of each voxel, 0 none; where it is dilated, that of the nearest structure:
  ///   every voxel nearest to a point where `occupancy` > 0.5 - 1e-3   a solid, even in a lumen
  ///   a lumen's other voxels                                          the lumen
  ///   unlabelled, within one voxel of a lumen                         the lumen (its wall)
  ///   unlabelled, within two voxels of a solid                        the solid
  std::shared_ptr<const Volume<std::uint8_t>> index;

  /// Borders between solids; nullptr if no two meet. See LabelBorders.h.
  std::shared_ptr<const Volume<std::uint8_t>> borders;

  bool hasSolid = false;
  bool hasLumen = false;
  std::vector<std::string> notes; ///< messages on what was reduced to fit into memory
};

/// Above this the common grid of different maps is coarsened along its finest axes: 2.5 GB if every
/// voxel were used. The grid of a single map is never changed.
constexpr std::size_t kMaxLabelVoxels = 500'000'000;

/// Version of the results of makeLabelField and makeSolidOccupancy: incremented with every change,
/// so that results cached by an older program are not used (core::DerivedStore).
constexpr int kLabelFieldVersion = 1;

/// Where structures overlap, the first one in `sources` owns the voxel; a lumen never takes a voxel
/// from a solid structure. A structure thinner than a voxel of the common grid gets every voxel
/// that it touches even partially (SmoothedUnion.h, kInsideFloor).
///
/// Returns nullptr if no source has a voxel. Memory is used only around the structures. Throws
/// InvalidParameter (no map, segment or material 0, more than 65535 sources), CancelledError.
std::shared_ptr<const LabelField> makeLabelField(const std::vector<LabelSource>& sources,
                                                 const core::Progress& progress = {},
                                                 std::size_t maxVoxels = kMaxLabelVoxels);

/// Only LabelField::occupancy, with all sources treated as solid: what haptics and drilling need,
/// at a fraction of the time and memory. Returns nullptr if no source has a voxel. Throws as
/// makeLabelField.
std::shared_ptr<Volume<float>> makeSolidOccupancy(const std::vector<LabelSource>& sources,
                                                  const core::Progress& progress = {},
                                                  std::size_t maxVoxels = kMaxLabelVoxels);

} // namespace petrous::volume
