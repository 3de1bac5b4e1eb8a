#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "Component.h"
#include "GridFromAffine.h"
#include "NrrdHeader.h"
#include "VoxelStream.h"

namespace petrous::imaging
{

/// Location of the voxels of a NRRD file, in the file and in the patient, from its header
/// (https://teem.sourceforge.net/nrrd/format.html). Used instead of ITK 5.2, which rotates
/// left-anterior-superior data by 180 degrees about the third axis and verifies no checksum.
struct NrrdLayout
{
  std::vector<std::uint64_t> dims;
  std::size_t components = 1; ///< numbers per voxel: the leading non-spatial axes
  bool isList = false;        ///< these are one axis of kind "list" or "time": of volumes
  Component component = Component::Int16;
  Eigen::Matrix3d linear; ///< d patient / d voxel of the first three axes, LPS mm
  Eigen::Vector3d origin; ///< LPS mm
  LengthUnit unit;
  bool isSideAssumed = false; ///< it states no frame of a patient, and LPS is taken
  std::vector<std::string> notes;

  VoxelPlace place;             ///< without partBytes
  std::uintmax_t dataBytes = 0; ///< size of its files together
  bool isText = false;          ///< decimal numbers
  bool swapped = false;         ///< big-endian
};

/// Throws FileError.
NrrdLayout readNrrdLayout(const std::filesystem::path& path, const NrrdHeader& header);

} // namespace petrous::imaging
