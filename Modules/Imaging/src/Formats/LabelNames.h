#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Volume/LabelMap.h"

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

/// Names from a colour table (3D Slicer) or label description (ITK-SNAP) next to a label file.
struct LabelTable
{
  std::vector<volume::Segment> segments; ///< empty if there is no table
  bool sameName = false;                 ///< the table has the base name of the label file
};
LabelTable findLabelTable(const std::filesystem::path& labelFile);

/// Parses the segments of a table; lines that are not entries are skipped, the first entry of an
/// index wins, index 0 is background.
std::vector<volume::Segment> parseLabelTable(const std::string& text);

} // namespace petrous::imaging
