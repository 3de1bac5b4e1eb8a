#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petrous/Appearance/StructureAppearance.h"

namespace petrous::appearance
{

/// The catalogue of looks, and which one a structure's name asks for (Resources/structures.json).
class StructurePresets
{
public:
  /// The catalogue that the program carries.
  static StructurePresets builtIn();

  /// From JSON text. Throws InvalidParameter naming the entry that is wrong.
  explicit StructurePresets(std::string_view json);

  /// The look that a structure of this name starts with, e.g. "facial_nerve" -> nerve.
  StructureAppearance lookFor(const std::string& structureName) const;

  /// The words of a name by which structures, sides and parts are called, and short numbers, in
  /// their order and in lower case: "Doe_John-FacialNerve_left" -> "facial nerve left". Empty where
  /// no structure is among them.
  std::string knownWords(const std::string& name) const;

  /// The preset of this name, or the one that the name would get as a structure's, e.g. "vessel" ->
  /// artery. Throws InvalidParameter listing the presets.
  StructureAppearance preset(const std::string& name) const;

  /// Every preset, "other" last.
  std::vector<StructureAppearance> all() const;

private:
  struct Words
  {
    std::vector<std::string> words;
    std::size_t preset; ///< index in `m_presets`
  };
  const StructureAppearance* find(const std::string& name) const; ///< null: no such preset
  const StructureAppearance* lookByWord(const std::string& structureName) const;

  std::vector<StructureAppearance> m_presets;
  std::vector<Words> m_words;
  std::vector<std::string> m_neutral; ///< words beside those of structures in their names
  StructureAppearance m_other;
};

/// What bone starts with: the preset "bone".
StructureAppearance boneLook();

} // namespace petrous::appearance
