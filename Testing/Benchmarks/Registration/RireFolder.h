#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "RegistrationPair.h"

namespace petrous::registration
{

/// An image of the Retrospective Image Registration Evaluation project (RIRE, Fitzpatrick): a
/// folder with header.ascii ("Keyword := value" lines) and image.bin (big-endian 16-bit two's
/// complement, row after row, slice after slice). The centre of the first voxel is the origin; the
/// axes are those that "Patient Orientation" names, L : P : H where it names none. Throws Error
/// (BadInput) naming the file and what is wrong with it.
std::shared_ptr<const volume::IntensityVolume> readRireImage(const std::filesystem::path& folder);

/// A truth file of RIRE, e.g. ct_T1.standard: eight lines "n x y z new_x new_y new_z" amid its
/// words, mm from the first voxel of either image along rows, columns and slices.
struct RireStandard
{
  core::RigidTransform toFromFrom; ///< of "From" points to "To" points, the least-squares fit
  double rms = 0.0;                ///< of the eight points from that fit, mm (rounding: below 0.01)
};
/// Throws Error (BadInput) where there are not eight points, or no rigid motion takes them there
/// within 0.1 mm.
RireStandard readRireStandard(const std::filesystem::path& file);

/// Every CT of RIRE below `folder` (ct/header.ascii) with every MR beside it (mr_NAME/), with the
/// truth where ct_NAME.standard lies at or below that patient's folder; without truth where not.
/// The targets stand for the project's regions of interest, which are not published: the corners of
/// the CT's hull shrunk to half about its middle. Throws Error (BadInput) where there is no pair.
std::vector<RegistrationPair> rirePairs(const std::filesystem::path& folder);

} // namespace petrous::registration
