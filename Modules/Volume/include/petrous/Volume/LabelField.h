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

/// One structure that goes into a label field.
struct LabelSource
{
  std::shared_ptr<const LabelMap> labels;
  std::uint16_t segment = 0; ///< its voxel value in `labels`
  std::uint8_t material = 0; ///< what `LabelField::index` says of it, >= 1; sources may share one
  bool solid = true;         ///< false: a lumen, which has an index but no occupancy
};

/// Many structures, each on the grid of its file, as the two channels that eye and hand sample
/// [Chan2013, 2.1-2.2]: a smoothed union and a dilated index, on one grid.
///
/// Where the maps share a grid nothing is resampled: the field is that grid, cut to the box of the
/// structures or reaching beyond it, with a margin of two voxels. Otherwise it is the grid of the
/// finest map (the smallest voxel volume; of maps with a solid structure, where there is one, so
/// that a lumen does not change what the hand feels), extended over all of them. How the others
/// come onto it, and what becomes of thin structures, is said in src/Labels/LabelResampling.h. Structures
/// of different grids are united by their larger occupancy, so between two that only touch there may
/// be a crease where their occupancies are 1/2.
struct LabelField
{
  /// Smoothed union of the solid sources, 0 to 1, in steps of 1/65535 (so that a 16-bit texture
  /// holds the same numbers); its level 0.5 is their surface. See SmoothedUnion.h.
  std::shared_ptr<const Volume<float>> occupancy;

  /// Material of each voxel, 0 none; that of the nearest structure where it is grown:
  ///   every voxel nearest to a point where `occupancy` > 0.5 - 1e-3   a solid, even in a lumen's voxel
  ///   a lumen's other voxels                                      the lumen
  ///   nothing, within one voxel of a lumen                        the lumen: the wall around it
  ///   nothing, within two voxels of a solid                       the solid
  std::shared_ptr<const Volume<std::uint8_t>> index;

  /// Where one solid ends and the next begins; null where no two meet. See LabelBorders.h.
  std::shared_ptr<const Volume<std::uint8_t>> borders;

  bool hasSolid = false;
  bool hasLumen = false;
  std::vector<std::string> notes; ///< what was given up to fit into memory, in words
};

/// Above this the common grid of different maps is made coarser along its finest axes: 2.5 GB if
/// every voxel were used. A single map's own grid is never touched.
constexpr std::size_t kMaxLabelVoxels = 500'000'000;

/// Of what makeLabelField and makeSolidOccupancy return: raised with every change of it, so that
/// nothing is taken for theirs that an older program kept (core::DerivedStore).
constexpr int kLabelFieldVersion = 1;

/// Where structures overlap, the one that comes first in `sources` has the voxel; a lumen never
/// takes a voxel from a solid structure. A structure thinner than a voxel of the common grid keeps
/// every voxel that it touches for at least a part (SmoothedUnion.h, kInsideFloor).
///
/// Null when no source has a voxel. Memory is used only round the structures. Throws
/// InvalidParameter (no map, segment or material 0, more than 65535 sources), CancelledError.
std::shared_ptr<const LabelField> makeLabelField(const std::vector<LabelSource>& sources,
                                                 const core::Progress& progress = {},
                                                 std::size_t maxVoxels = kMaxLabelVoxels);

/// LabelField::occupancy alone, with all sources taken as solid: what hand and drill ask for, at a part
/// of the time and memory. Null when no source has a voxel. Throws as makeLabelField.
std::shared_ptr<Volume<float>> makeSolidOccupancy(const std::vector<LabelSource>& sources,
                                              const core::Progress& progress = {},
                                              std::size_t maxVoxels = kMaxLabelVoxels);

} // namespace petrous::volume
