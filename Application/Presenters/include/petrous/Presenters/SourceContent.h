#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::presenters
{

/// What a file or folder contains.
enum class Content
{
  Ct,
  Mr,
  Image, ///< a CT, cone beam or MR: undetermined
  Labels,
  Mesh
};

/// A DICOM series, or one of its volumes; or structures or meshes beside it: a DICOM segmentation,
/// or other files (PartFiles).
struct SeriesContent
{
  std::string selector;             ///< of imaging::chooseSeries
  Content content = Content::Image; ///< Labels, Mesh: of parts beside a series
  std::string modality;             ///< DICOM (0008,0060), or a file's format; may be empty
  std::string description;          ///< may identify the patient: for local display only
  std::size_t slices = 0;
  Eigen::Vector3d spacing = Eigen::Vector3d::Zero(); ///< mm
  // These distinguish series of the same description; likewise for local display only.
  std::string taken;           ///< imaging::SliceHeader
  std::string patientPosition; ///< likewise
  std::string kernel;          ///< reconstruction kernel; may be empty
  std::filesystem::path place; ///< folder of its first slice
  std::filesystem::path first; ///< name of that slice's file
  /// The end of its place, as long as it takes to tell it from the others', and its first slice
  /// where that does not.
  std::string folder;
  imaging::Verdict verdict = imaging::Verdict::Ok; ///< Refused: cannot be chosen
  std::vector<imaging::Finding> findings;          ///< the reasons for it
  bool isTooLarge = false;                         ///< as SourceContent's
  std::string name;                                ///< see sequenceName
  /// Of parts: a file, a folder of masks, or several meshes; else empty.
  std::vector<std::filesystem::path> files;
  std::string what;      ///< of parts: "12 masks, one structure a file"
  std::string image;     ///< of parts: the selector of the image whose grid they have; else empty
  bool isDicom = true;   ///< of parts: a segmentation or structure set
  bool isBeside = false; ///< of parts: not below what was opened, but in a folder beside it
};

/// The folder that names a case of what was chosen of `series`: that of the image, if one alone was
/// chosen and others lie in other folders. Else empty: what was opened names the case.
std::filesystem::path namingFolder(const std::vector<SeriesContent>& chosen,
                                   const std::vector<SeriesContent>& series);

/// A file or folder that the user opens or drops, and its content.
struct SourceContent
{
  std::filesystem::path path;
  Content content = Content::Image;
  std::string why;           ///< the reason for `content`: a phrase that follows "it", for the user
  bool isNameless = false;   ///< only the file names its structure, possibly after a patient
  std::string selector = {}; ///< of imaging::chooseSeries; empty: the only one
  std::string name = {};     ///< proposed for an MR, see sequenceName; may be empty
  /// A DICOM series that can be read only with repair (CaseSources): why. Else empty.
  std::vector<imaging::Finding> repair = {};
  /// Of a DICOM folder with several series that may be meant, sound or not, or with structures or
  /// meshes below it: all of them; the user chooses. `content` is then meaningless. Of an image
  /// file with several volumes these.
  std::vector<SeriesContent> series = {};
  /// Structures of a label map that neither it nor a table beside it names.
  std::size_t unnamed = 0;
  std::size_t structureCount = 0;           ///< of a label map; objects of a mesh; 0: not known
  std::vector<std::string> structures = {}; ///< of a folder of masks (maskNames)
  bool isTooLarge = false; ///< an image that the memory does not hold: a region of it may do
  /// A file that leaves open which side of the patient is left (imaging::assumedRasOf).
  bool isSideOpen = false;
  imaging::UnitDoubt unitDoubt = {}; ///< of a file of voxels
  /// Of a series that was chosen: namingFolder.
  std::filesystem::path naming = {};
  std::string description = {}; ///< of a DICOM series: as SeriesContent's, for local display only
  /// Of a DICOM series that cannot be used, repaired or not: why. Else empty.
  std::vector<imaging::Finding> refused = {};
};

/// Determines the content of `path`: meshes and 3D Slicer segmentations by their file names, DICOM
/// by SOP class and modality, a folder without DICOM images by the masks in it, other images by
/// their voxels (see contentOf), which are read. Throws as the readers do, and CancelledError.
/// `expected`, Mr or Labels: what the user says of an image file; its voxels then decide nothing.
/// Labels also says that of a folder with masks and DICOM images the masks are meant.
SourceContent lookAt(const std::filesystem::path& path, const core::Progress& progress,
                     std::optional<Content> expected = std::nullopt);

/// What a series description or a file name says about an MR sequence ("T2 CISS", "DWI b 1000"),
/// without anything that may be a patient's name. May be empty.
std::string sequenceName(const std::string& description);

/// By the voxels alone.
///
/// Labels  integers from 0, at most 16 of them; or at most kMaxLabels, in patches: nine in ten
///         voxels above 0 have a neighbour of equal value. An 8-bit MR is noisier than that.
/// Ct      in Hounsfield units (volume::suggestScale) with values below -500: air.
/// Image   anything else. Cone beam and MR both start at 0 in units of their own and cannot be told
///         apart.
Content contentOf(const volume::IntensityVolume& image);
constexpr std::size_t kMaxLabels = 1024;

/// Display name: "CT", "MR", "structures", "mesh", "image".
std::string nameOf(Content content);

} // namespace petrous::presenters
