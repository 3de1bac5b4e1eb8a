#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace petrous::presenters
{

/// What the engines and presenters say, in another language. They speak English, as the command
/// does by contract; a phrase is a text as the sources put it together, with places for what is put
/// in:
///
///   "%1: the case needs %#2 MB, %#3 MB are free; nothing was restored; free some space"
///
/// "%1" is a name or a path, "%#1" a number, "%~1" a phrase of its own. A phrase is
/// recognised as a whole: its words are those of the text, all of them and in their order, where
/// the text may begin with a capital, as a sentence does, and what is found then does, too. Of
/// phrases that fit, the one with the most words of its own is taken. Where none fits, the text's
/// parts are looked up, which lines, "; ", ". ", ": ", ", " and parentheses divide; what is not a
/// phrase stays as it is. Immutable, and so safe on any thread.
class Phrasebook
{
public:
  /// English and the other language, with the same places.
  using Phrase = std::pair<std::string, std::string>;

  explicit Phrasebook(const std::vector<Phrase>& phrases);

  /// The text in the other language; nullopt: nothing in it is a phrase.
  std::optional<std::string> find(std::string_view english) const;
  /// The same; what is not known stays as it is.
  std::string text(std::string_view english) const;

private:
  struct Piece
  {
    std::string words;     ///< before the place
    int place = 0;         ///< 0: none, the end
    bool isPhrase = false; ///< of the place
    bool isNumber = false; ///< likewise
  };
  using Pieces = std::vector<Piece>;
  struct Entry
  {
    Pieces english;
    Pieces other;
    std::size_t letters = 0; ///< of its own
    std::size_t characters = 0;
  };
  struct Found
  {
    std::string text;
    bool isWhole = true; ///< each of its phrases was recognised
  };

  /// What was found for parts of a text.
  using Memory = std::map<std::pair<const char*, std::size_t>, std::optional<Found>>;

  static Pieces piecesOf(const std::string& phrase);
  std::optional<Found> lookUp(std::string_view part, Memory& memory) const;
  std::optional<Found> whole(std::string_view core, Memory& memory,
                             bool isCapitalized = false) const;
  std::optional<Found> matched(const Entry& entry, std::string_view core, Memory& memory,
                               bool isCapitalized) const;
  std::optional<Found> divided(std::string_view part, Memory& memory) const;

  std::vector<Entry> m_entries;              ///< those with the most letters first
  std::vector<std::pair<char, char>> m_ends; ///< first and last character of each; 0: any
};

/// Resources/translations/phrases_de.ts.
const Phrasebook& germanPhrases();
const std::vector<Phrasebook::Phrase>& germanPhraseList();

/// A text with a comma in each of its decimal numbers, and semicolons between those of a list, as
/// German has them. What stands in quotation marks is a name; so is a number within a word, a path,
/// a version or a UID.
std::string withDecimalCommas(std::string text);

/// A text of numbers and units alone, with a narrow no-break space between each three digits of
/// what is 10,000 or more [ISO 80000-1, 7.3]: the same in every language, where a comma or a point
/// would be read as the decimal one. For people, not for files.
std::string withGroupedDigits(const std::string& text);

} // namespace petrous::presenters
