#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "RegistrationPair.h"

namespace petrous::registration
{

/// Reads an image of the Retrospective Image Registration Evaluation project (RIRE, Fitzpatrick): a
/// folder with header.ascii ("Keyword := value" lines) and image.bin (big-endian 16-bit two's
/// complement, row by row, slice by slice). The origin is the centre of the first voxel; the axes
/// are given by "Patient Orientation", L : P : H by default. Throws Error (BadInput) naming the
/// file and the problem.
std::shared_ptr<const volume::IntensityVolume> readRireImage(const std::filesystem::path& folder);

/// A truth file of RIRE, e.g. ct_T1.standard: eight lines "n x y z new_x new_y new_z" within text,
/// mm from the first voxel of either image along rows, columns and slices.
struct RireStandard
{
  core::RigidTransform toFromFrom; ///< maps "From" points to "To" points; least-squares fit
  double rms = 0.0;                ///< residual of the eight points, mm (rounding: below 0.01)
};
/// Throws Error (BadInput) unless there are eight points that a rigid motion fits within 0.1 mm.
RireStandard readRireStandard(const std::filesystem::path& file);

/// Pairs each RIRE CT below `folder` (ct/header.ascii) with each MR beside it (mr_NAME/), with the
/// truth if ct_NAME.standard is in or below that patient's folder, otherwise without. The targets
/// stand in for the project's unpublished regions of interest: the corners of the CT's hull, shrunk
/// to half about its centre. Throws Error (BadInput) if there is no pair.
std::vector<RegistrationPair> rirePairs(const std::filesystem::path& folder);

} // namespace petrous::registration
