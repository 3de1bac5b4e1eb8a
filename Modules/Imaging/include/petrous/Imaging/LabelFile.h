#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::imaging
{

struct LoadedLabels
{
  /// One map; for a file with overlapping structures (.seg.nrrd, DICOM SEG) one per layer.
  std::vector<volume::LabelMap> maps;
  std::vector<std::string> notes; ///< what was assumed or left out, one sentence each
  bool isNamedAfterFile = false;  ///< the single structure is named only by the file name
  /// DICOM: what structures are, by the codes of the file; by name. An appearance may be chosen by
  /// it where the name says nothing.
  std::map<std::string, std::string> meanings = {};
  std::string frameOfReferenceUid = {}; ///< DICOM; identifies the patient's study: not to be shown
};

/// Whether a file is a DICOM segmentation (SEG, also of label maps), whatever its name.
bool isDicomSegmentation(const std::filesystem::path& path);

/// Reads structures from a NIfTI, NRRD or MetaImage file of integers (0 is background) or from a
/// DICOM segmentation, on the grid of the file.
///
/// A DICOM segmentation is BINARY, FRACTIONAL (voxels of 50 % and more, noted) or LABELMAP; places
/// without a frame are empty. It is known by its first bytes, under any name.
///
/// Names and colours are taken from the file itself (3D Slicer's .seg.nrrd), else from a 3D Slicer
/// colour table (.ctbl, .txt) or an ITK-SNAP label description (.label, .txt) in the same folder
/// that has the same base name, or that is the only .ctbl in the folder and shares a word with the
/// file name. A file with a single nonzero value is one structure, index 1, named after the file
/// ("facial_nerve.nii.gz": "facial_nerve"). Structures without a name become "label N".
///
/// Throws FileError; Unsupported reports a value below 0, above 65535 or not integral.
/// CancelledError.
LoadedLabels loadLabels(const std::filesystem::path& path, const core::Progress& progress = {});

/// Like loadLabels, without the notes, for a file whose structures do not overlap. Throws FileError
/// (Unsupported) for several layers.
volume::LabelMap readLabelFile(const std::filesystem::path& path,
                               const core::Progress& progress = {});

/// Writes .nii, .nii.gz, .nrrd or .seg.nrrd (3D Slicer segmentation with names and colours); uint8
/// if every index is at most 255, else uint16; .nrrd and .seg.nrrd are gzip-compressed. The file is
/// written atomically, and equal maps give equal bytes. Throws FileError; InvalidParameter if the
/// map has no voxels.
void writeLabelFile(const std::filesystem::path& path, const volume::LabelMap& labels);

/// Writes structures that overlap, each map a layer of one .seg.nrrd file (3D Slicer); a single map
/// as writeLabelFile does. Layers are on one grid. Throws like it, FileError (UnknownFormat) for
/// several layers in another format, CancelledError.
void writeLabelLayers(const std::filesystem::path& path,
                      const std::vector<volume::LabelMap>& layers,
                      const core::Progress& progress = {});

/// Names and colours as an ITK-SNAP label description (.label), which loadLabels finds beside a
/// file of the same base name. Throws core::OutputFileError.
void writeLabelTable(const std::filesystem::path& path,
                     const std::vector<volume::Segment>& segments);

} // namespace petrous::imaging
