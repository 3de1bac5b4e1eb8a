#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImageGrid.h"
#include "petrous/Imaging/PatientKey.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/SegmentCodes.h"

namespace petrous::imaging
{

/// A structure that a file, or its table of names, lists and that is in none of the maps.
struct UnreadStructure
{
  std::string name;
  std::uint16_t index = 0; ///< 0: not known
  bool isEmpty = true;     ///< it has no voxel; otherwise it could not be read
  std::string why = {};    ///< it could not be read: "it ..", if known; names no file
};

struct LoadedLabels
{
  /// Structures have different names: of several with one name the later ones are numbered
  /// ("nerve 2"), which a note says. One map; for overlapping structures (.seg.nrrd, DICOM SEG, a
  /// folder) one per layer, and for a folder with several grids at least one for each.
  std::vector<volume::LabelMap> maps;
  std::vector<std::string> notes; ///< what was assumed or left out, one sentence each
  /// A file leaves open which side of the patient is left, and neither the caller nor the grid of
  /// an image settled it: the place of the maps is a guess.
  bool isSideOpen = false;
  /// Whether RAS (true) or LPS (false) axes were taken where a file leaves that open; of a folder,
  /// of the first that does. nullopt: it is stated.
  std::optional<bool> assumedRas = {};
  /// Likewise of the unit of length (unitDoubtOf), which the grid of an image settles, too.
  UnitDoubt unitDoubt = {};
  bool isNamedAfterFile = false; ///< structures are named only by the names of their files
  /// DICOM: what structures are, by the codes of the file; by name. An appearance may be chosen by
  /// it where the name says nothing.
  std::map<std::string, std::string> meanings = {};
  /// The codes themselves, of DICOM and of 3D Slicer's .seg.nrrd, by name.
  std::map<std::string, volume::SegmentCodes> codes = {};
  std::string frameOfReferenceUid = {}; ///< DICOM; identifies the patient's study: not to be shown
  PatientKey patient = {};              ///< DICOM: whose structures they are
  std::vector<UnreadStructure> unread = {};
  /// mm^3 by the file itself, by name: what its frames, masks or contours enclose, counted or
  /// computed before they became voxels here. None for a label map, whose voxels are kept.
  std::map<std::string, double> fileVolumes = {};
  /// What was left out of a folder, one sentence each. They name files, possibly after a patient:
  /// for the user at once, and not to be stored.
  std::vector<std::string> leftOut = {};
};

/// Where the names of label values come from.
struct LabelNaming
{
  std::filesystem::path
      table; ///< a table of names (formats: README.md); empty: the one beside the file
  /// Whether `table` also names a file of a single structure, which otherwise its own name does.
  bool namesSingle = true;
};

/// Whether a file is a DICOM segmentation (SEG, also of label maps), whatever its name.
bool isDicomSegmentation(const std::filesystem::path& path);

/// Reads structures from a NIfTI, NRRD or MetaImage file of integers (0 is background), from a
/// DICOM segmentation, on the grid of the file, or from a folder of such files, one structure each.
///
/// A DICOM segmentation is BINARY, FRACTIONAL (voxels of 50 % and more, noted) or LABELMAP; places
/// without a frame are empty. It is known by its first bytes, under any name. Of one that declares
/// no spacing of its slices it is that of the image in `images` (on which it may have been drawn)
/// on whose slices its frames lie, else their thickness or distance, which is noted.
///
/// Of another file that leaves open which side of the patient is left (readImageFile) `isRas` says
/// how its axes count. Without it they count so that its grid is that of one of `images`, if only
/// one side gives such a grid, and if it tells a side: the file states an origin beside the middle,
/// or the image's own file left its side open, too. Any two files from 0, 0, 0 of one size share
/// their grid. `unit`: of length, in mm, instead of the file's.
///
/// Names and colours are taken from the file itself (3D Slicer's .seg.nrrd), else from the table
/// given in `naming`, else from a table in the same folder that has the same base name (.ctbl,
/// .txt, .label, .csv, .tsv, .json), or that is the only .ctbl in the folder and shares a word with
/// the file name. A file with a single nonzero value is one structure, index 1, named after the
/// file ("facial_nerve.nii.gz": "facial_nerve"). Structures without a name become "label N", which
/// is noted if there is a table.
///
/// In a folder each file with one nonzero value is a structure, named after the file and numbered
/// from 1 in the order of names; other files, and links to what lies outside the folder, are left
/// out and told of. Structures on one grid share
/// a map unless they overlap; different grids are kept apart. Files are read in parallel, one slice
/// at a time.
///
/// `memory`: bytes that the voxels of a DICOM segmentation may take; 0: what the machine has left.
///
/// Throws FileError; Unsupported reports a value below 0, above 65535 or not integral, and a folder
/// without a structure. CancelledError.
LoadedLabels loadLabels(const std::filesystem::path& path, const core::Progress& progress = {},
                        const LabelNaming& naming = {}, const std::vector<ImageGrid>& images = {},
                        const std::optional<bool>& isRas = std::nullopt, std::uint64_t memory = 0,
                        const std::optional<double>& unit = std::nullopt);

/// Like loadLabels, without the notes, for a file whose structures do not overlap. Throws FileError
/// (Unsupported) for several layers.
volume::LabelMap readLabelFile(const std::filesystem::path& path,
                               const core::Progress& progress = {});

/// The structures of a .seg.nrrd (its first layer) by its header alone: the number of their voxels
/// is not known, 0. None for other files. Throws FileError.
std::vector<volume::Segment> readSegments(const std::filesystem::path& path);

/// Writes .nii, .nii.gz, .nrrd or .seg.nrrd (3D Slicer segmentation with names and colours); uint8
/// if every index is at most 255, else uint16; .nrrd and .seg.nrrd are gzip-compressed. The file is
/// written atomically, and equal maps give equal bytes. Throws FileError; InvalidParameter if the
/// map has no voxels.
void writeLabelFile(const std::filesystem::path& path, const volume::LabelMap& labels);

/// Writes structures that overlap, each map a layer of one .seg.nrrd file (3D Slicer); a single map
/// as writeLabelFile does. Layers are on one grid. Throws like it, FileError (UnknownFormat) for
/// several layers in another format, CancelledError.
///
/// codes  by label value, which then differ between layers: written as 3D Slicer's TerminologyEntry
void writeLabelLayers(const std::filesystem::path& path,
                      const std::vector<volume::LabelMap>& layers,
                      const core::Progress& progress = {},
                      const std::map<std::uint16_t, volume::SegmentCodes>& codes = {});

/// Names and colours as an ITK-SNAP label description (.label), which loadLabels finds beside a
/// file of the same base name. Throws core::OutputFileError.
void writeLabelTable(const std::filesystem::path& path,
                     const std::vector<volume::Segment>& segments);

} // namespace petrous::imaging
