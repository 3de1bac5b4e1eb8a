#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Library/Library.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Tells whether a text may identify the patient of a case. It cannot find every name: it looks for
/// forms (a name as DICOM writes it, a title before a name, two words with capitals that are no
/// words of anatomy or imaging, an address, a date, also with its month in letters, a number as
/// long as a record's, one of letters and digits), and compares the words with the salted hashes of
/// the patient's ID, name and each word of the name that the case keeps (of a case that an earlier
/// version imported: of the whole name alone). Where the library lost the salt of these, every text
/// may identify the patient that is not of words of the field.
class IdentityText
{
public:
  /// `salt`: of the case's library (library::frameSalter). Without it words are not compared.
  explicit IdentityText(const scene::Case& value, scene::IdentitySalt salt = {});
  /// The same of a case in this library.
  IdentityText(const scene::Case& value, const library::Library& library);

  bool mayIdentify(const std::string& text) const;

  /// Whether words of the patient's name are known: that a text is not the patient's name is not
  /// known otherwise.
  bool knowsName() const noexcept { return m_knowsName; }
  /// library::hasLostSalt.
  bool isSaltLost() const noexcept { return m_isSaltLost; }

  /// The same of a sentence that the program wrote, in which numbers and capitals say nothing.
  bool mayIdentifySentence(const std::string& text) const;

  /// Whether all of its words are of anatomy, imaging and operations: no name is among them.
  bool isOfField(const std::string& text) const;

  /// Of one of its folders, or of the file.
  bool mayIdentifyPath(const std::filesystem::path& path) const;

private:
  bool isOfPatient(const std::string& text) const;
  bool hasName(const std::string& text) const;
  bool isKnownWord(const std::string& word) const;

  appearance::StructurePresets m_presets = appearance::StructurePresets::builtIn();
  scene::IdentitySalt m_salt;
  std::set<std::string> m_salts;    ///< hashes of names and IDs, salted
  std::set<std::string> m_unsalted; ///< of cases that are not saved yet
  bool m_knowsName = false;
  bool m_isSaltLost = false; ///< so that nothing is known of what the case has hashes of
};

} // namespace petrous::presenters
