#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Appearance/StructureAppearance.h"
#include "petrous/Volume/SegmentCodes.h"

namespace petrous::appearance
{

/// What a structure is, as SNOMED CT codes with their meanings.
struct StructureCode
{
  std::string category = "123037004";
  std::string categoryMeaning = "Anatomical Structure";
  std::string type = "123037004";
  std::string typeMeaning = "Anatomical Structure";
};

/// Which nerve a name denotes.
enum class NerveKind
{
  None,
  Other,
  Facial,
  ChordaTympani
};

/// The catalogue of appearance presets, selected by structure name (Resources/structures.json).
class StructurePresets
{
public:
  /// The built-in catalogue.
  static StructurePresets builtIn();

  /// From JSON text. Throws InvalidParameter naming the invalid entry.
  explicit StructurePresets(std::string_view json);

  /// The default appearance of a structure of this name, e.g. "facial_nerve", "N. facialis" or
  /// "Gesichtsnerv links" -> nerve; "other" if the catalogue does not know the name.
  StructureAppearance lookFor(const std::string& structureName) const;

  /// Whether a name is that of a nerve: a nerve's own word decides, whatever place or segment
  /// stands beside it ("Fazialis mastoid"), unless that is a vessel, a tumour, or another thing
  /// that is named after the nerve ("facial recess").
  NerveKind nerveOf(const std::string& structureName) const;

  /// The appearance by what a file says that a structure is: by the codes that the catalogue has,
  /// else by the words of their meanings; nullopt if neither says more. Of what is abnormal, the
  /// region does not count: a mass at an artery is none.
  std::optional<StructureAppearance> lookForCodes(const volume::SegmentCodes& codes) const;

  /// The words of a name that denote structures, sides (also abbreviated, in several languages) and
  /// parts, those that change its meaning ("not", "resected"), and short numbers, in order and in
  /// lower case: "Doe_John-FacialNerve_left" -> "facial nerve left". Empty if none of them denotes
  /// a structure.
  std::string knownWords(const std::string& name) const;

  /// The same of a part of a name, which need not denote a structure by itself: "Left" -> "left".
  std::string knownWordsOfPart(const std::string& part) const;

  /// Whether a name would mean something else without this word ("not", "resected", "post").
  bool isQualifier(const std::string& word) const;

  /// The preset of this name, or the one that a structure of this name would get, e.g. "vessel" ->
  /// artery. Throws InvalidParameter listing the presets.
  StructureAppearance preset(const std::string& name) const;

  /// The code of a structure by its name or else by its preset; an anatomical structure if neither
  /// says more.
  StructureCode codeFor(const std::string& structureName, const std::string& preset) const;

  /// Every preset, "other" last.
  std::vector<StructureAppearance> all() const;

private:
  /// Words that follow one another in a name, folded (lower case, ASCII: "steigbuegel").
  struct Phrase
  {
    std::vector<std::string> words;
    bool isWhole = false; ///< the last word has no other ending
    bool isAlone = false; ///< nothing but neutral words stands beside them
  };
  using Phrases = std::vector<Phrase>;
  struct Words
  {
    Phrases phrases;
    std::size_t preset;              ///< index in `m_presets`
    std::vector<std::size_t> unless; ///< presets of which a word decides instead
  };
  /// Patterns of a folded word: '*' at either end stands for any letters.
  using Patterns = std::vector<std::string>;
  struct NerveNames
  {
    std::size_t preset = 0; ///< index in `m_presets`
    Patterns nerve, facial, notFacial, number, course, place, isNot, isFacial, isChorda;
    std::string facialCode;          ///< its words in `m_codes` denote the facial nerve
    std::vector<std::size_t> unless; ///< presets of which a word decides instead
  };
  struct Code
  {
    Phrases phrases;
    std::string preset;
    StructureCode code;
  };
  struct KnownWords
  {
    std::string text;
    bool hasStructure = false; ///< not only what stands beside one
  };
  KnownWords knownIn(const std::string& name) const;
  const StructureAppearance* find(const std::string& name) const; ///< nullptr: no such preset
  const StructureAppearance* lookByWord(const std::string& structureName) const;
  bool hasPhrase(const std::vector<std::string>& name, const Phrases& phrases) const;
  bool hasPhraseOf(const std::vector<std::string>& name,
                   const std::vector<std::size_t>& presets) const;
  NerveKind nerveOfWords(const std::vector<std::string>& name) const;
  std::size_t indexOf(const std::string& preset, const char* where) const;
  bool isNeutral(const std::string& foldedWord) const;
  bool isSide(const std::string& foldedWord) const;
  static void addPhrases(Phrases& phrases, const std::vector<std::string>& texts, bool isAlone);

  std::vector<StructureAppearance> m_presets;
  std::vector<Words> m_words;
  std::optional<NerveNames> m_nerveNames;
  std::vector<std::string> m_sides;      ///< words and abbreviations of left and right
  std::vector<std::string> m_neutral;    ///< words accepted besides those of structures
  std::vector<std::string> m_qualifiers; ///< without which a name would mean something else
  std::vector<Code> m_codes;
  StructureAppearance m_other;
};

/// Bytes of letters and digits. Of a name from which knownWords leaves nothing out, its result has
/// as many.
std::size_t letterBytes(const std::string& text);

/// The default appearance of bone: the preset "bone".
StructureAppearance boneLook();

/// The default appearance of what is neither bone nor a structure: the preset "soft-tissue", not
/// shown, and air to haptics and drilling.
StructureAppearance softTissueLook();

/// Has a look of soft tissue that reads an MR read the primary image again, with the transfer
/// function of the default: values of the MR mean nothing there.
void readPrimaryImage(StructureAppearance& softTissue);

} // namespace petrous::appearance
