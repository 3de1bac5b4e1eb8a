#pragma once

#include <set>
#include <string>

namespace petrous::library
{

bool isInVocabulary(const std::string& upperCaseWord);
bool isKnownManufacturer(const std::string& text);

/// Words of a person's name, numbers and the like: what must not occur in what is kept.
class IdentityWords
{
public:
  /// Adds the words of at least three letters or digits that are not in the vocabulary.
  void add(const std::string& text);

  /// Adds a person's name: its words of at least two letters or digits, those of the vocabulary too
  /// (Sharp, Plain, Head).
  void addName(const std::string& text);

  /// Adds an identifier: its words as add() does, and all of it.
  void addIdentifier(const std::string& text);

  /// One of the words.
  bool hasWord(const std::string& text) const;

  /// An identifier of at least five characters, all of it, or a number in it (MRN4711471,
  /// 4711471-3; with its separators or without: 943-476-919) in any form (blanks around it, leading
  /// zeros, a sign, ".0", an exponent).
  bool isIdentifier(const std::string& text) const;
  bool isIdentifier(double number) const;

  /// A word of the text is among them; or the text looks like an identity by itself: an e-mail
  /// address, a name with "^", a date, six digits in a row.
  bool foundIn(const std::string& text) const;

private:
  static constexpr double kMinNumber = 10000.0;

  std::set<std::string> m_words, m_identifiers; ///< upper case
  std::set<double> m_numbers;                   ///< of identifiers, at least kMinNumber
};

/// `text` without words other than those of a vocabulary of anatomy and technique (English, German,
/// French; upper case) and numbers of up to three digits, and without the words of `people`. Empty
/// if none is left.
std::string reducedToVocabulary(const std::string& text, const IdentityWords& people);

} // namespace petrous::library
