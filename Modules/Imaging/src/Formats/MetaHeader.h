#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "Component.h"

namespace petrous::imaging
{

/// What the header of a MetaImage file (.mha, .mhd) says. ITK's own reader takes voxels that
/// break off, and talks on the error stream.
struct MetaHeader
{
  std::vector<std::uint64_t> dims;
  Component component = Component::Int16;
  Eigen::Matrix3d linear; ///< d patient / d voxel of the first three axes, LPS mm
  Eigen::Vector3d origin; ///< LPS mm
  double slope = 1.0;     ///< of what a voxel's number means (ElementToIntensityFunction)
  double intercept = 0.0;
  std::vector<std::string> notes;

  std::filesystem::path file;   ///< where the voxels are
  std::uint64_t offset = 0;     ///< their first byte
  std::uintmax_t dataBytes = 0; ///< size of that file
  bool packed = false;          ///< zlib
  bool swapped = false;         ///< big-endian
  bool saysBinary = false;
};

/// Throws FileError.
MetaHeader readMetaHeader(const std::filesystem::path& path);

/// Refuses voxels kept as text, in several files, or behind a foreign header.
[[noreturn]] void failMetaKind(const std::filesystem::path& path);

} // namespace petrous::imaging
