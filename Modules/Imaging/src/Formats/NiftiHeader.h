#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "GridFromAffine.h"
#include "petrous/Core/GridGeometry.h"

namespace petrous::imaging
{

/// Where the two placements of a file (sform and qform) may lie apart without being noted, mm.
constexpr double kPlacementsDiffer = 0.1;

/// As GridFromAffine.h.
struct NiftiPlacement
{
  Eigen::Matrix3d linear; ///< d patient / d voxel, LPS mm
  Eigen::Vector3d origin; ///< LPS mm
};

/// A NIfTI-1 or NIfTI-2 header (nifti1.h, nifti2.h of the NIfTI data format working group).
struct NiftiHeader
{
  std::vector<std::uint64_t> dims; ///< without trailing ones, at least 3
  int storedDims = 0;              ///< as stated in the file
  int dataType = 0;                ///< DT_ code
  bool swapped = false;            ///< big-endian
  bool packed = false;             ///< the whole file is gzip-compressed
  std::filesystem::path file;      ///< containing the voxels
  std::uint64_t voxelOffset = 0;   ///< bytes, in the uncompressed file
  double slope = 0.0;              ///< scl_slope; 0: none
  double intercept = 0.0;
  NiftiPlacement placement;
  /// The other one, where the file states a sform and a qform that can be a place.
  std::optional<NiftiPlacement> other;
  bool isQform = false;           ///< `placement` is the qform, `other` the sform
  bool isSformOfTemplate = false; ///< and the qform is of the scanner's space
  double apart = 0.0; ///< mm, by which the qform places a corner elsewhere than the sform
  LengthUnit unit;
  std::string description;
  std::string intentName;
  bool isSideAssumed = false; ///< it states no place in the patient, and RAS is taken
  std::vector<std::string> notes;

  bool rescaled() const { return slope != 0.0 && (slope != 1.0 || intercept != 0.0); }
};

/// Reads the header of a .nii, .nii.gz or of a pair .hdr, .img (either named) according to the
/// standard: sform if present, but for one of a template beside a qform of the scanner's space;
/// else qform, else voxel size only (noted). ITK would silently orthogonalize a sheared sform.
/// ANALYZE 7.5 is refused: it leaves left and right open. Throws FileError.
NiftiHeader readNiftiHeader(const std::filesystem::path& path);

/// The 352 bytes before the voxels of a .nii: identical sform and qform, RAS, mm. `dataType` and
/// `bits` as the standard's DT_ codes; at most 79 bytes of description and 15 of intent_name.
std::string niftiHeaderBytes(const core::GridGeometry& geometry, int dataType, int bits,
                             const std::string& description = {},
                             const std::string& intentName = {});

} // namespace petrous::imaging
