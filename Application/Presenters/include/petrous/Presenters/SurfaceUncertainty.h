#pragma once

#include <optional>
#include <string>

#include "petrous/Scene/StructureOccupancy.h"

namespace petrous::presenters
{

/// Position uncertainty of a structure's surface, from the image on which it was drawn; excludes
/// the quality of the drawing.
struct SurfaceUncertainty
{
  Eigen::Vector3d voxel{0.0, 0.0, 0.0}; ///< mm, of the grid on which it was drawn
  std::string drawnOn;                  ///< the MR on which it was drawn; empty: the CT or another
  /// mm; 95th percentile of that MR's registration error, at `place`. None if not estimated.
  std::optional<double> registration;
  std::string place; ///< where that error was estimated, as text
  double away = 0.0; ///< mm from there to the structure's centre

  double sliceSpacing() const { return voxel.maxCoeff(); } ///< mm

  /// Half-width, mm: root sum of squares of half the voxel's longest edge and the registration
  /// error, if any.
  double millimetres() const;

  /// Whether `millimetres` is incomplete since the registration error was not estimated.
  bool incomplete() const { return !drawnOn.empty() && !registration; }
};

SurfaceUncertainty uncertaintyOf(const scene::Case& value,
                                 const scene::StructureOccupancy& structure);

/// "voxels 0.20 x 0.20 x 0.60 mm, slices 0.60 mm apart", and if drawn on an MR: "; drawn on the MR
/// 'T2', registered to 0.24 mm (p95) at the incus, 14 mm from here".
std::string toString(const SurfaceUncertainty& uncertainty);

} // namespace petrous::presenters
