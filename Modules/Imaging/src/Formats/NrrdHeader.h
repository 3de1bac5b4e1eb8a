#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace petrous::imaging
{

/// NRRD header up to and including "space origin": type, sizes, directions, kinds, units, endian,
/// encoding. `type` as named by NRRD; more than one layer is a first axis of kind "list". Further
/// fields, key/value pairs and a blank line follow.
std::string nrrdHeaderText(const core::GridGeometry& geometry, const std::string& type,
                           const std::string& encoding, std::size_t layers = 1);

/// A key/value line; line ends and backslashes in the value are escaped.
std::string nrrdKeyText(const std::string& key, const std::string& value);

/// The text header of a NRRD. Field names are in lower case.
struct NrrdHeader
{
  std::vector<std::pair<std::string, std::string>> fields;
  std::vector<std::pair<std::string, std::string>> keys;
  std::unordered_map<std::string, std::size_t>
      byName;                         ///< the keys: of segments there are thousands
  std::vector<std::string> dataFiles; ///< the lines after "data file: LIST"
  std::size_t dataOffset = 0;         ///< first byte after the blank line

  const std::string* field(const std::string& name) const;
  const std::string* key(const std::string& name) const;
};

/// Throws FileError: UnknownFormat if the file does not start as NRRD, Unreadable if the header
/// does not end or has a line that is neither field, key nor comment.
NrrdHeader readNrrdHeader(const std::filesystem::path& path);

} // namespace petrous::imaging
