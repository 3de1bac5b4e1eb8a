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
/// in mm. A size or place that cannot be true is rejected, too, and, as these millimetres are, only
/// where the unit of length is known. Throws FileError (NoGeometry, Unsupported).
core::GridGeometry gridFromAffine(const std::filesystem::path& path,
                                  const std::vector<std::uint64_t>& dims,
                                  const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin,
                                  std::vector<std::string>& notes, bool isUnitKnown = true);

/// The unit of length of a file.
struct LengthUnit
{
  double mm = 1.0;
  bool isStated = false;  ///< false: mm is assumed
  std::string name = {};  ///< as the file states it, if it is known and not mm
  bool isUnknown = false; ///< the file states one that is not known; with isStated false
};

/// As named by NRRD and MetaImage ("mm", "um", "m"), with or without quotes; unknown and empty ones
/// are taken as mm.
LengthUnit namedUnit(std::string name);

/// Whether voxels of these axes (mm) are those of a head, an ear or a specimen of one: neither is
/// all of it below a millimetre, nor is it metres of coarse voxels, as of a whole body.
bool isPlausibleSize(const std::vector<std::uint64_t>& dims, const Eigen::Matrix3d& linear);
/// Its longest edge, mm.
double longestEdge(const std::vector<std::uint64_t>& dims, const Eigen::Matrix3d& linear);

} // namespace petrous::imaging
