#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::imaging
{

struct LoadedLabels
{
  /// One map; of a .seg.nrrd whose structures overlap one for each layer.
  std::vector<volume::LabelMap> maps;
  std::vector<std::string> notes; ///< what was assumed or left out, one sentence each
  bool isNamedAfterFile = false;  ///< nothing but the file's name names the one structure
};

/// Reads structures from a NIfTI, NRRD or MetaImage file of whole numbers (0 is nothing), on the
/// grid of the file.
///
/// Names and colours come from the file itself (3D Slicer's .seg.nrrd), else from a colour table
/// of 3D Slicer (.ctbl, .txt) or a label description of ITK-SNAP (.label, .txt) beside it that
/// has the same base name, or that is the only .ctbl in the folder and shares a word with the
/// file's name. A file with one value other than 0 is one structure, index 1, named after the
/// file ("facial_nerve.nii.gz": "facial_nerve"). What stays nameless is "label N".
///
/// Throws FileError; Unsupported names a value below 0, above 65535 or not whole. CancelledError.
LoadedLabels loadLabels(const std::filesystem::path& path, const core::Progress& progress = {});

/// As loadLabels, of a file whose structures do not overlap, without the notes. Throws FileError
/// (Unsupported) for several layers.
volume::LabelMap readLabelFile(const std::filesystem::path& path,
                               const core::Progress& progress = {});

/// Writes .nii, .nii.gz, .nrrd or .seg.nrrd (3D Slicer's segmentation with names and colours);
/// uint8 where every index is at most 255, else uint16; .nrrd and .seg.nrrd gzip-compressed.
/// The file appears whole or not at all, and equal maps give equal bytes.
/// Throws FileError; InvalidParameter when the map holds no voxels.
void writeLabelFile(const std::filesystem::path& path, const volume::LabelMap& labels);

} // namespace petrous::imaging
