#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petrous/Appearance/StructureLook.h"

namespace petrous::appearance
{

/// The catalogue of looks by a structure's name (Resources/structures.json).
class StructurePresets
{
public:
  /// The catalogue that the program carries.
  static StructurePresets builtIn();

  /// From JSON text. Throws InvalidParameter naming the entry that is wrong.
  explicit StructurePresets(std::string_view json);

  /// The look that a structure of this name starts with, e.g. "facial_nerve" -> nerve.
  StructureLook lookFor(const std::string& structureName) const;

private:
  struct Entry
  {
    std::vector<std::string> words;
    StructureLook look;
  };
  std::vector<Entry> m_entries;
  StructureLook m_other;
};

} // namespace petrous::appearance
