#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

/// Smooth borders between structures inside tissue that belongs to both, instead of voxel faces;
/// used alike by the renderer and the reference.
namespace petrous::volume
{

/// A voxel of `LabelField::borders`: its depth inside the structure of its index, from 1 to
/// kDeepest, which stands for kBorderReach voxels or more; 0 where that is not solid.
constexpr std::uint8_t kDeepest = 127;
constexpr double kBorderReach = 1.7320508;
constexpr double kMarginPerDepth = 0.5 / kDeepest; ///< occupancies 0 to 1 span twice that depth
/// Flag added where two structures meet in tissue around the voxel. Elsewhere the index suffices.
constexpr std::uint8_t kMeeting = 128;

/// Returns nullptr if no two solids meet. A border is relaxed like the surface of a structure
/// (src/Labels/SurfaceNet.h), so that every voxel stays with its own structure and nothing shrinks.
/// `solid`: which indices are solid. Occupancy and index must be on one grid.
std::shared_ptr<const Volume<std::uint8_t>> makeLabelBorders(const Volume<float>& occupancy,
                                                             const Volume<std::uint8_t>& index,
                                                             const std::array<bool, 256>& solid,
                                                             const core::Progress& progress = {});

struct StructureChoice
{
  std::uint8_t index = 0; ///< 0: none, or outside the grid
  double margin = 0.5;    ///< >= 0: distance to another structure, as an occupancy
};

/// The structure at a position inside the tissue of structures (voxel coordinates of the index).
///
/// Where two meet, the one with the largest sum over the eight voxels around the position, weighted
/// trilinearly and by their depth: the border is the 0 level of the interpolated signed depth. At
/// most three structures among the eight are considered: that of the nearest voxel, and the first
/// two others, first axis fastest. Without borders (nullptr), the index of the nearest voxel.
StructureChoice structureAt(const Volume<std::uint8_t>& index, const Volume<std::uint8_t>* borders,
                            const Eigen::Vector3d& voxel);

} // namespace petrous::volume
