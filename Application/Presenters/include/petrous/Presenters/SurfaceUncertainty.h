#pragma once

#include <optional>
#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// How well the place of a structure's surface is known: what the picture that it was drawn on can
/// tell, and nothing of how well it was drawn.
struct SurfaceUncertainty
{
  Eigen::Vector3d voxel{0.0, 0.0, 0.0}; ///< mm, of the grid that it was drawn on
  std::string drawnOn;                  ///< the MR on whose grid it lies; empty: the CT or another
  bool registered = true;               ///< that MR; the CT always is
  /// mm; the 95th percentile of the registration's error. Nothing where none was estimated.
  std::optional<double> registration;

  double sliceSpacing() const { return voxel.maxCoeff(); } ///< mm

  /// To either side, mm: half the voxel's longest edge, and the registration's error where there
  /// is one, as the root of the sum of their squares.
  double millimetres() const;

  /// Whether something is missing in `millimetres`, since the MR was not registered or its error
  /// not estimated.
  bool incomplete() const { return !drawnOn.empty() && !registration; }
};

/// Of a structure drawn on `grid`: one that has the grid of an MR, and not the CT's, was drawn on
/// that.
SurfaceUncertainty uncertaintyOf(const scene::Case& value, const core::GridGeometry& grid);

/// "voxels 0.20 x 0.20 x 0.60 mm, slices 0.60 mm apart", and where it was drawn on an MR: "; drawn
/// on the MR 'T2', registration unknown".
std::string inWords(const SurfaceUncertainty& uncertainty);

} // namespace petrous::presenters
