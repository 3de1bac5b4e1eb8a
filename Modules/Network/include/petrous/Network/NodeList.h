#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Network/DicomNode.h"

namespace petrous::network
{

/// The DICOM nodes of a library: `nodes.json` in its folder. It names the files of keys and
/// certificates, and holds no secret.
class NodeList
{
public:
  /// Throws InvalidParameter if the file cannot be read, or is of a newer version.
  explicit NodeList(std::filesystem::path library);

  const std::vector<Node>& nodes() const noexcept { return m_nodes; } ///< sorted by name

  /// Throws InvalidParameter listing the names that there are.
  const Node& at(const std::string& name) const;

  /// All read the file again and write it once under a lock, atomically. `add` and `replace` (the
  /// node of that name) throw InvalidParameter (checkNode), `add` also if the name is taken,
  /// `replace` and `remove` if there is no such node; all core::OutputFileError.
  void add(const Node& node);
  void replace(const Node& node);
  void remove(const std::string& name);

private:
  std::filesystem::path m_library;
  std::vector<Node> m_nodes;
};

} // namespace petrous::network
