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
/// Axes that are off perpendicular by no more than 1e-3 (the dot product of two unit axes) and
/// cost less than 0.1 mm are straightened, and noted from 0.001 mm on; others are refused with
/// the millimetres at stake. Throws FileError (NoGeometry, Unsupported).
core::GridGeometry gridFromAffine(const std::filesystem::path& path,
                                  const std::vector<std::uint64_t>& dims,
                                  const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin,
                                  std::vector<std::string>& notes);

/// Millimetres in a unit as NRRD and MetaImage name it ("mm", "um", "m"), quotes around it or
/// not; another than mm, and one that is unknown or empty and so taken as mm, is noted.
double unitInMillimetres(std::string name, std::vector<std::string>& notes);

} // namespace petrous::imaging
