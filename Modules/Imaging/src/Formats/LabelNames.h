#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Volume/LabelMap.h"

#include "LabelTable.h"
#include "NrrdHeader.h"

namespace petrous::imaging
{

/// The segments that a .seg.nrrd defines in one layer, as written by 3D Slicer (SegmentN_Name,
/// _LabelValue, _Color, _Layer). Throws FileError for invalid label values and for two segments
/// with the same value.
std::vector<volume::Segment> segmentsOfLayer(const std::filesystem::path& path,
                                             const NrrdHeader& header, std::size_t layer);

/// Names of the segments that lie in none of the first `layers` layers.
std::vector<std::string> segmentsWithoutLayer(const NrrdHeader& header, std::size_t layers);

/// The key/value lines that define the structures of a map, or of several that are layers of one
/// file, as written by 3D Slicer.
std::string segmentKeys(const std::vector<volume::LabelMap>& layers);

/// The table of names beside a label file: one of its base name (.ctbl, .txt, .label, .csv, .tsv,
/// .json), or the only .ctbl in the folder if its name shares a word with the file's.
LabelTable findLabelTable(const std::filesystem::path& labelFile);

} // namespace petrous::imaging
