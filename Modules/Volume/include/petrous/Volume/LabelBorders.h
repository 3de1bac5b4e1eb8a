#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

/// Where one structure ends and the next begins inside tissue that belongs to both: a smooth border
/// in place of the faces of voxels, on which eye and reference agree.
namespace petrous::volume
{

/// A voxel of `LabelField::borders`: how deep it lies inside what has its index, from 1 to
/// kDeepest, which is kBorderReach voxels or more; 0 where that is not solid.
constexpr std::uint8_t kDeepest = 127;
constexpr double kBorderReach = 1.7320508;
constexpr double kMarginPerDepth = 0.5 / kDeepest; ///< an occupancy is twice as deep from 0 to 1
/// Added where, round the voxel, two structures meet in tissue. Elsewhere the index alone tells.
constexpr std::uint8_t kMeeting = 128;

/// Null where no two solids meet. A border is relaxed as the surface of a structure is
/// (src/Labels/SurfaceNet.h), so that every voxel stays with its own structure and nothing shrinks.
/// `solid`: which indices are. Share and index must be on one grid.
std::shared_ptr<const Volume<std::uint8_t>> makeLabelBorders(const Volume<float>& occupancy,
                                                             const Volume<std::uint8_t>& index,
                                                             const std::array<bool, 256>& solid,
                                                             const core::Progress& progress = {});

struct StructureChoice
{
  std::uint8_t index = 0; ///< 0: none, or beyond the grid
  double margin = 0.5;    ///< >= 0: from another structure, in occupancies
};

/// The structure at a position inside the tissue of structures (voxels of the index' grid).
///
/// Where two meet, the one whose voxels have most, of the eight round the position, weighted
/// trilinearly and by their depth: the border is the 0 level of the interpolated signed depth.
/// Of the eight no more than three structures count: the nearest voxel's, and of the others the
/// first two, the first axis going fastest.
/// Without borders (null) the index of the nearest voxel.
StructureChoice structureAt(const Volume<std::uint8_t>& index, const Volume<std::uint8_t>* borders,
                            const Eigen::Vector3d& voxel);

} // namespace petrous::volume
