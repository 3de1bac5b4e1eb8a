#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace petrous::imaging
{

/// What a NIfTI-1 header says (nifti1.h of the NIfTI data format working group).
struct NiftiHeader
{
  std::vector<std::uint64_t> dims; ///< without trailing ones, at least 3 long
  int storedDims = 0;              ///< as counted by the file
  int dataType = 0;                ///< DT_ code
  bool swapped = false;            ///< numbers are big-endian
  bool packed = false;             ///< the whole file is gzip
  std::uint64_t voxelOffset = 0;   ///< in bytes, of the unpacked file
  double slope = 0.0;              ///< scl_slope; 0 is none
  double intercept = 0.0;
  Eigen::Matrix3d linear; ///< d patient / d voxel, LPS mm
  Eigen::Vector3d origin; ///< LPS mm
  std::vector<std::string> notes;

  bool rescaled() const { return slope != 0.0 && (slope != 1.0 || intercept != 0.0); }
};

/// Reads the header of a .nii or .nii.gz by the standard's methods: sform where it has one, else
/// qform, else the voxel size alone (noted). ITK would straighten a sheared sform in silence.
/// Throws FileError.
NiftiHeader readNiftiHeader(const std::filesystem::path& path);

/// The 352 bytes before the voxels of a .nii: sform and qform equal, RAS, mm.
/// `dataType` and `bits` as the standard's DT_ codes.
std::string niftiHeaderBytes(const core::GridGeometry& geometry, int dataType, int bits);

} // namespace petrous::imaging
