#pragma once

#include <optional>
#include <string>

#include "petrous/Scene/StructureOccupancy.h"

namespace petrous::presenters
{

/// Error of an MR's registration where something lies, mm: 95th percentile of the length of the
/// displacement in space.
struct RegistrationErrorHere
{
  double p95 = 0.0;
  /// Where it holds, as text; empty: here, by the registration's spread. Cases of older programs
  /// have that of one point only, and so has a registration whose point lies beside the rest.
  std::string place;
  double away = 0.0; ///< mm, from that point to the middle of what lies here; 0: here
};

/// The greatest over the corners of a box in CT space (LPS mm), which may be a point. None if the
/// error was not estimated, or there is no such MR.
std::optional<RegistrationErrorHere>
registrationErrorIn(const scene::Case& value, const std::string& mr, const core::PatientBox& box);

/// "registered to 0.41 mm (p95) here", or "registered to 0.24 mm (p95) at the incus, 14 mm from
/// here, where it may be more".
std::string toString(const RegistrationErrorHere& error);

/// Position uncertainty of a structure's surface, from the image on which it was drawn; excludes
/// the quality of the drawing.
struct SurfaceUncertainty
{
  Eigen::Vector3d voxel{0.0, 0.0, 0.0}; ///< mm, of the grid on which it was drawn
  std::string drawnOn;                  ///< the MR on which it was drawn; empty: the CT or another
  std::string madeFrom; ///< the MRs that it was made from on the CT's grid: "'T2', 'T1'"; or none
  std::string outdated; ///< why their error is not that of the structure (outdatedReading)
  /// Of those MRs the largest, in the structure's bounding box. None if that of one is not known.
  std::optional<RegistrationErrorHere> registration;

  bool isOfMr() const { return !drawnOn.empty() || !madeFrom.empty(); }

  double sliceSpacing() const { return voxel.maxCoeff(); } ///< mm

  /// Half-width, mm: root sum of squares of half the voxel's longest edge and the registration
  /// error, if any.
  double millimetres() const;

  /// Whether `millimetres` is incomplete since the registration error was not estimated.
  bool incomplete() const { return isOfMr() && !registration; }
};

SurfaceUncertainty uncertaintyOf(const scene::Case& value,
                                 const scene::StructureOccupancy& structure);

/// "voxels 0.20 x 0.20 x 0.60 mm, slices 0.60 mm apart", and if drawn on an MR, or made from one:
/// "; drawn on the MR 'T2'; registered to 0.41 mm (p95) here".
std::string toString(const SurfaceUncertainty& uncertainty);

} // namespace petrous::presenters
