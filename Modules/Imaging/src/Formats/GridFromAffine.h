#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace petrous::imaging
{

/// The grid of a file whose voxel (i, j, k) lies at origin + linear * (i, j, k), patient LPS mm.
///
/// Axes that deviate from perpendicular by at most 1e-3 (dot product of two unit axes) and at most
/// 0.1 mm are orthogonalized, with a note from 0.001 mm; others are rejected, reporting the error
/// in mm. Throws FileError (NoGeometry, Unsupported).
core::GridGeometry gridFromAffine(const std::filesystem::path& path,
                                  const std::vector<std::uint64_t>& dims,
                                  const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin,
                                  std::vector<std::string>& notes);

/// Millimetres per unit as named by NRRD and MetaImage ("mm", "um", "m"), with or without quotes;
/// units other than mm, and unknown or empty ones, which are taken as mm, are noted.
double unitInMillimetres(std::string name, std::vector<std::string>& notes);

} // namespace petrous::imaging
