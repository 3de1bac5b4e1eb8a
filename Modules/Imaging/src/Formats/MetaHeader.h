#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "Component.h"
#include "GridFromAffine.h"

namespace petrous::imaging
{

/// The header of a MetaImage file (.mha, .mhd). Used instead of ITK's reader, which accepts
/// truncated voxel data and prints to stderr.
struct MetaHeader
{
  std::vector<std::uint64_t> dims;
  Component component = Component::Int16;
  Eigen::Matrix3d linear; ///< d patient / d voxel of the first three axes, LPS mm
  Eigen::Vector3d origin; ///< LPS mm
  LengthUnit unit;
  double slope = 1.0; ///< rescale of the stored values (ElementToIntensityFunction)
  double intercept = 0.0;
  std::string comment;
  bool isHounsfield = false;  ///< as this program's files say (kUnitKey)
  bool isSideAssumed = false; ///< it states no axes in the patient, and LPS is taken
  std::vector<std::string> notes;

  std::filesystem::path file;   ///< containing the voxels
  std::uint64_t offset = 0;     ///< of the first voxel
  std::uintmax_t dataBytes = 0; ///< size of that file
  bool packed = false;          ///< zlib-compressed
  bool swapped = false;         ///< big-endian
  bool saysBinary = false;
};

/// Throws FileError.
MetaHeader readMetaHeader(const std::filesystem::path& path);

/// Rejects voxels stored as text, in several files, or after a foreign header.
[[noreturn]] void failMetaKind(const std::filesystem::path& path);

} // namespace petrous::imaging
