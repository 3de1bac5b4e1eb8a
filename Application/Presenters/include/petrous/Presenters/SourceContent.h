#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::presenters
{

/// What a file or folder holds for a case.
enum class Content
{
  Ct,
  Mr,
  Image, ///< a CT, cone beam or MR: it does not say which
  Labels,
  Mesh
};

/// A DICOM series that can be read.
struct SeriesContent
{
  std::string uid;
  Content content = Content::Image; ///< Ct, Mr or Image
  std::string modality;             ///< DICOM (0008,0060); may be empty
  std::string description;          ///< may say who the patient is: for the user's own screen only
  std::size_t slices = 0;
  Eigen::Vector3d spacing = Eigen::Vector3d::Zero(); ///< mm
  // What tells series of the same description apart; likewise for the user's own screen only.
  std::string taken;           ///< imaging::SliceHeader
  std::string patientPosition; ///< likewise
  std::string kernel;          ///< of the reconstruction; may be empty
  std::string folder;          ///< name of the one that its first slice lies in
};

/// What somebody opens or drops, and what it is.
struct SourceContent
{
  std::filesystem::path path;
  Content content = Content::Image;
  std::string why;         ///< what that was decided by: a phrase that follows "it", for the user
  bool isNameless = false; ///< nothing names its one structure but the file, maybe by a patient
  /// Of a DICOM folder with several series that can be read: the user says which. `content` is then
  /// without meaning.
  std::vector<SeriesContent> series;
};

/// Looks at what `path` is: a mesh and a segmentation of 3D Slicer by their names, DICOM by its
/// modality, other images by their voxels (see contentOf), which are read. Throws as the readers
/// do, and CancelledError.
SourceContent lookAt(const std::filesystem::path& path, const core::Progress& progress);

/// By the voxels alone.
///
/// Labels  whole numbers from 0, at most 16 of them; or at most kMaxLabels, in patches: nine in
/// ten
///         voxels above 0 have a neighbour of their own value. An MR of 8 bits has noise instead.
/// Ct      in Hounsfield units (volume::suggestScale) with values below -500: air.
/// Image   all else. Cone beam and MR both count from 0 in units of their own; nobody can tell.
Content contentOf(const volume::IntensityVolume& image);
constexpr std::size_t kMaxLabels = 1024;

/// "CT", "MR", "structures", "mesh", "image": for the user.
std::string nameOf(Content content);

} // namespace petrous::presenters
