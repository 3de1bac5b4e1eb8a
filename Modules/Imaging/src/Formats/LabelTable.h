#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Volume/LabelMap.h"

namespace petrous::imaging
{

/// Names and colours of label values, from a file of their own.
///
/// Formats, known by the content:
/// - 3D Slicer's colour table and FreeSurfer's look-up table: index, name, r, g, b [, a], 0 to 255,
///   separated by white space; a name may hold spaces, also unquoted
/// - ITK-SNAP's label description: index r g b opacity visible mesh "name"
/// - CSV and TSV (comma, semicolon or tab), with a header that names the columns in any order
///   (index, label, value ..; name, structure ..; r, g, b or color as #rrggbb), as 3D Slicer's
///   newer tables, or without one: index, name [, r, g, b]. Colours are 0 to 1 if none is above 1,
///   else 0 to 255; a decimal comma is understood
/// - JSON: {"1": "spleen"}, {"spleen": 1}, or either as "labels" (TotalSegmentator, nnU-Net)
///
/// UTF-8 with or without mark, otherwise Latin-1. Lines that start with '#' are comments, and
/// index 0 is the background.
struct LabelTable
{
  std::vector<volume::Segment> segments; ///< in the order of the file; empty: no table
  bool sameName = false;                 ///< it lies beside a label file, under its base name
  /// Lines that are no entry, or contradict another, one sentence each ("line 3 ..."); of two
  /// entries for an index the first is kept.
  std::vector<std::string> problems;
  std::vector<std::string> notes;
};

LabelTable parseTable(std::string_view text);

/// Reads a table that the user gave. Throws FileError, for the first of `problems` and for a file
/// without entries (Unreadable).
LabelTable readLabelTable(const std::filesystem::path& path);

/// The entries alone, whatever else the text holds.
std::vector<volume::Segment> parseLabelTable(const std::string& text);

/// The largest file that is read as a table, in bytes.
constexpr std::size_t kLargestTable = std::size_t{4} << 20;

} // namespace petrous::imaging
