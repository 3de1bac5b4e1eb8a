#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "OutputFile.h"
#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileFormats.h"

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

struct VoxelsToWrite
{
  const std::filesystem::path& path; ///< for messages
  const core::GridGeometry& geometry;
  const VoxelType& type;
  const void* voxels;
  const std::string& nrrdKeys; ///< complete key/value lines for NRRD
  const core::Progress& progress;
  std::size_t layers = 1; ///< values of a voxel, which adjoin; for NRRD
  /// Value of voxels outside the scanned field, kept in the header; NRRD: among its keys.
  std::optional<double> padding = std::nullopt;
  bool isHounsfield = false; ///< kept in the header; NRRD: among its keys

  std::size_t bytes() const
  {
    return layers * geometry.voxelCount() * static_cast<std::size_t>(type.bits / 8);
  }
};

// Of the table of formats.
void writeNrrd(OutputFile& file, const VoxelsToWrite& voxels);
void writeNifti(OutputFile& file, const VoxelsToWrite& voxels);
void writeNiftiGz(OutputFile& file, const VoxelsToWrite& voxels);
void writeMeta(OutputFile& file, const VoxelsToWrite& voxels);

/// Writes voxels in the format of the file's name. Throws FileError, CancelledError.
void writeVoxelFile(const std::filesystem::path& path, FileContent content,
                    const core::GridGeometry& geometry, const VoxelType& type, const void* voxels,
                    const std::string& nrrdKeys, const core::Progress& progress,
                    const std::optional<double>& padding = std::nullopt, bool isHounsfield = false);

} // namespace petrous::imaging
