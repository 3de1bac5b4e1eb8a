#pragma once

#include <optional>
#include <string>

#include "petrous/Scene/StructureOccupancy.h"

namespace petrous::presenters
{

/// How well the place of a structure's surface is known: what the picture that it was drawn on can
/// tell, and nothing of how well it was drawn.
struct SurfaceUncertainty
{
  Eigen::Vector3d voxel{0.0, 0.0, 0.0}; ///< mm, of the grid that it was drawn on
  std::string drawnOn;                  ///< the MR that it was drawn on; empty: the CT or another
  /// mm; the 95th percentile of the error with which that MR lies on the CT, at `place`. Nothing
  /// where none was estimated.
  std::optional<double> registration;
  std::string place; ///< where that error was estimated, in words
  double away = 0.0; ///< mm from there to the structure's centre

  double sliceSpacing() const { return voxel.maxCoeff(); } ///< mm

  /// To either side, mm: half the voxel's longest edge, and the registration's error where there
  /// is one, as the root of the sum of their squares.
  double millimetres() const;

  /// Whether something is missing in `millimetres`, since the registration's error was not
  /// estimated.
  bool incomplete() const { return !drawnOn.empty() && !registration; }
};

SurfaceUncertainty uncertaintyOf(const scene::Case& value, const scene::StructureOccupancy& structure);

/// "voxels 0.20 x 0.20 x 0.60 mm, slices 0.60 mm apart", and where it was drawn on an MR: "; drawn
/// on the MR 'T2', registered to 0.24 mm (p95) at the incus, 14 mm from here".
std::string toString(const SurfaceUncertainty& uncertainty);

} // namespace petrous::presenters
