#pragma once

#include <cstdint>
#include <memory>
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
  bool solid = true;         ///< false: a lumen, which has an index but no share
};

/// Many structures, each on the grid of its file, as the two channels that eye and hand sample
/// [Chan2013, 2.1-2.2]: a smoothed union and a dilated index, on one grid.
///
/// The grid is that of the maps where they share one (nothing is resampled then), cut to the box of
/// the structures; otherwise the finest of them, over all of them.
struct LabelField
{
  /// Smoothed union of the solid sources, 0 to 1, in steps of 1/65535 (so that a 16-bit texture
  /// holds the same numbers); its level 0.5 is their surface. See SmoothedUnion.h.
  std::shared_ptr<const Volume<float>> share;

  /// Material of each voxel, 0 none. Grown by two voxels into what is nothing, so that the voxel
  /// nearest to any point where `share` exceeds 0.5 - 1e-3 carries an index.
  std::shared_ptr<const Volume<std::uint8_t>> index;

  bool hasSolid = false;
  bool hasLumen = false;
};

/// Where structures overlap, the one that comes first in `sources` has the voxel; a lumen never
/// takes a voxel from a solid structure. A structure thinner than a voxel of the common grid keeps
/// every voxel that it touches for at least a part (SmoothedUnion.h, kInsideFloor).
/// Null when no source has a voxel. Throws InvalidParameter (no map, material 0), CancelledError.
std::shared_ptr<const LabelField> makeLabelField(const std::vector<LabelSource>& sources,
                                                 const core::Progress& progress = {});

} // namespace petrous::volume
