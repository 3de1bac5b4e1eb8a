#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/CaseDicom.h"
#include "petrous/Presenters/LeftOut.h"
#include "petrous/Scene/ImageMask.h"

namespace petrous::presenters
{

/// Choices that do not go together, or one that is missing.
struct ExportChoiceError : core::InvalidParameter
{
  using InvalidParameter::InvalidParameter;
};

/// Structures whose grids are not parts of one lattice go into one file on the CT's grid only
/// (ExportOptions::onCt).
struct ExportGridError : ExportChoiceError
{
  using ExportChoiceError::ExportChoiceError;
};

/// What of a case is written for other programs, and where: `petrous export`.
struct ExportOptions
{
  /// "ct", "mr", "labels", "mask" (of the dissection), "dissected" (the CT after it), "surface" (of
  /// what is left of the bone, with all structures) or "structure" (the surface of one)
  std::string what;
  /// A file, whose ending is its format; a folder that is there, or a name with a slash at its end:
  /// a DICOM series (ct, mr and dissected).
  std::string out;
  std::string part; ///< one MR or structure of several
  /// An MR, or labels, resampled on the CT's grid. Labels on parts of one lattice are brought onto
  /// one grid without resampling (padToOneGrid).
  bool onCt = false;
  std::optional<std::size_t> triangles = {}; ///< of a surface, at most
  scene::ImageMask mask = {}; ///< of the images that are written, or that the surface is one of
};

/// What was written; in which coordinates: coordinatesOf.
struct ExportSummary
{
  struct Decimation
  {
    std::size_t trianglesBefore;
    std::size_t trianglesAsked;
    double fromFull; ///< mm, largest distance of the full surface from it (volume::DecimatedMesh)
    double toFull;   ///< mm, largest distance of it from the full surface
    double mean;     ///< mm, mean distance of it from the full surface
    std::size_t selfIntersections; ///< pairs of triangles
  };
  /// A structure on the CT's grid (nearest voxel), which loses what is thinner than its voxels.
  struct Resampled
  {
    std::string name;
    double own;     ///< mm^3, of its voxels
    double written; ///< mm^3
  };
  std::string words;                         ///< ", 12 DICOM files": after a file's name
  std::optional<std::size_t> instances = {}; ///< of a DICOM series
  std::optional<std::size_t> segments = {};  ///< of a DICOM segmentation
  std::optional<CasePatient> patient = {};   ///< of DICOM files
  std::optional<std::size_t> layers = {};    ///< of label maps
  std::vector<Resampled> resampled = {};     ///< labels
  std::optional<std::string> names = {};     ///< the file with the labels' names
  std::optional<std::size_t> triangles = {}; ///< of a surface
  std::optional<Decimation> decimation = {}; ///< of a surface that has fewer than it had
  bool closed = false;                       ///< of a surface
  std::optional<double> volume = {};         ///< mm^3, of a closed surface
  std::optional<double> voxelsVolume = {};   ///< mm^3, of the structure's voxels
};

/// imaging::FileContent, the formats in which it is written.
unsigned exportContent(const std::string& what);

/// In which coordinates the file states positions: "LPS (DICOM, ITK), mm"; of NIfTI, which is so by
/// definition, "RAS (Slicer, NIfTI), mm".
std::string coordinatesOf(const ExportOptions& options);

/// The files that will be written. Throws ExportChoiceError, FileError (UnknownFormat): before
/// anything is computed.
std::vector<std::string> exportedFiles(const ExportOptions& options);

/// Writes a part of a case that was opened in this library; complete or not at all. Images are
/// checked against their hash before they are written. `leftOut` of the case is not written.
/// `warn` gets one sentence each of what is not as one would expect. Throws ExportChoiceError,
/// InvalidParameter, LibraryError, core::OutputFileError, CancelledError.
ExportSummary exportCase(const library::Library& library, scene::Case& value,
                         const ExportOptions& options, const LeftOut& leftOut,
                         const std::function<void(const std::string&)>& warn,
                         const core::Progress& progress);

} // namespace petrous::presenters
