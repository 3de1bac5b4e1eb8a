#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Volume/LabelMap.h"

#include "NrrdHeader.h"

namespace petrous::imaging
{

/// The segments that a .seg.nrrd names in one layer, as 3D Slicer writes them
/// (SegmentN_Name, _LabelValue, _Color, _Layer). Throws FileError for values that are no label
/// and for two segments with one value.
std::vector<volume::Segment> segmentsOfLayer(const std::filesystem::path& path,
                                             const NrrdHeader& header, std::size_t layer);

/// Names of the segments that lie in none of so many layers.
std::vector<std::string> segmentsWithoutLayer(const NrrdHeader& header, std::size_t layers);

/// The key/value lines that name the structures of a map, as 3D Slicer writes them.
std::string segmentKeys(const volume::LabelMap& labels);

/// Names from a colour table (3D Slicer) or a label description (ITK-SNAP) beside a label file.
struct LabelTable
{
  std::vector<volume::Segment> segments; ///< empty where there is no table
  bool sameName = false;                 ///< the table is named as the label file is
};
LabelTable findLabelTable(const std::filesystem::path& labelFile);

/// The segments of a table's text; lines that are no entry are skipped, the first entry of an
/// index counts, index 0 is nothing.
std::vector<volume::Segment> parseLabelTable(const std::string& text);

} // namespace petrous::imaging
