#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/SegmentCodes.h"

#include "LabelTable.h"
#include "NrrdHeader.h"

namespace petrous::imaging
{

/// Names of the structures of a file, each of which has its own: what is read of a structure is
/// kept by its name.
class UniqueNames
{
public:
  /// Names that the file states: no other structure is given one of them when it is numbered.
  void reserve(const std::string& stated) { m_stated.insert(stated); }

  /// `wanted`, or with a number if it is taken ("nerve 2"), which a note says.
  std::string take(const std::string& wanted, std::vector<std::string>& notes);

private:
  std::set<std::string> m_taken, m_stated;
  std::map<std::string, int> m_next; ///< the last number given to a name
};

/// Whether the header is that of a .seg.nrrd: it describes a segment.
bool hasSegments(const NrrdHeader& header);

/// The segments that a .seg.nrrd defines in one layer, as written by 3D Slicer (SegmentN_Name,
/// _LabelValue, _Color, _Layer). Throws FileError for invalid label values and for two segments
/// with the same value.
std::vector<volume::Segment> segmentsOfLayer(const std::filesystem::path& path,
                                             const NrrdHeader& header, std::size_t layer);

/// The codes of the segments of a layer that have some, by label value: 3D Slicer's
/// TerminologyEntry, a tag of SegmentN_Tags.
std::map<std::uint16_t, volume::SegmentCodes> codesOfLayer(const NrrdHeader& header,
                                                           std::size_t layer);

/// Names of the segments that lie in none of the first `layers` layers.
std::vector<std::string> segmentsWithoutLayer(const NrrdHeader& header, std::size_t layers);

/// The key/value lines that define the structures of a map, or of several that are layers of one
/// file, as written by 3D Slicer. `codes`: by label value.
std::string segmentKeys(const std::vector<volume::LabelMap>& layers,
                        const std::map<std::uint16_t, volume::SegmentCodes>& codes = {});

/// The table of names beside a label file: one of its base name (.ctbl, .txt, .label, .csv, .tsv,
/// .json), or the only .ctbl in the folder if its name shares a word with the file's.
LabelTable findLabelTable(const std::filesystem::path& labelFile);

} // namespace petrous::imaging
