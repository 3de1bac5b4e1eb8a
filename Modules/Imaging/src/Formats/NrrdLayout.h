#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "Component.h"
#include "NrrdHeader.h"

namespace petrous::imaging
{

/// Where the voxels of a NRRD file are and where they lie, from its header
/// (https://teem.sourceforge.net/nrrd/format.html). Our own: ITK 5.2 turns what is stated in
/// left-anterior-superior by 180 degrees about the third axis, and checks no checksum.
struct NrrdLayout
{
  std::vector<std::uint64_t> dims;
  std::size_t components = 1; ///< numbers a voxel: the leading axes that do not lie in space
  Component component = Component::Int16;
  Eigen::Matrix3d linear; ///< d patient / d voxel of the first three axes, LPS mm
  Eigen::Vector3d origin; ///< LPS mm
  std::vector<std::string> notes;

  enum class Encoding
  {
    Raw,
    Gzip,
    Text
  };
  std::filesystem::path file;   ///< where the voxels are
  std::uintmax_t dataBytes = 0; ///< size of that file
  Encoding encoding = Encoding::Raw;
  std::uint64_t offset = 0;         ///< on the disk
  std::uint64_t unpackedOffset = 0; ///< within the unpacked stream
  bool swapped = false;             ///< big-endian
};

/// Throws FileError.
NrrdLayout readNrrdLayout(const std::filesystem::path& path, const NrrdHeader& header);

} // namespace petrous::imaging
