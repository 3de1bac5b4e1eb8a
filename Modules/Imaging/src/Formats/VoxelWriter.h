#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// Names of a voxel type in each format.
struct VoxelType
{
  const char* nrrd; ///< "short"
  const char* meta; ///< "MET_SHORT"
  int nifti;        ///< DT_ code
  int bits;
};

template <class T>
VoxelType voxelTypeOf();

/// Writes voxels in the format given by the file extension (.nrrd .nii .nii.gz .mha); `nrrdKeys`
/// are complete key/value lines for .nrrd. Throws FileError, CancelledError.
void writeVoxelFile(const std::filesystem::path& path, const core::GridGeometry& geometry,
                    const VoxelType& type, const void* voxels, const std::string& nrrdKeys,
                    const core::Progress& progress);

} // namespace petrous::imaging
