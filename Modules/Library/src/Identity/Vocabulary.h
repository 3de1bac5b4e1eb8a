#pragma once

#include <set>
#include <string>

namespace petrous::library
{

/// `text` without words other than those of a vocabulary of anatomy and technique (English, German,
/// French; upper case), and numbers of up to three digits. Empty if none is left.
std::string reducedToVocabulary(const std::string& text);

bool isInVocabulary(const std::string& upperCaseWord);
bool isKnownManufacturer(const std::string& text);

/// Words of a person's name, numbers and the like: what must not occur in what is kept.
class IdentityWords
{
public:
  /// Adds the words of at least three letters or digits that are not in the vocabulary.
  void add(const std::string& text);

  /// A word of the text is among them; or the text looks like an identity by itself: an e-mail
  /// address, a name with "^", a date, six digits in a row.
  bool foundIn(const std::string& text) const;

private:
  std::set<std::string> m_words; ///< upper case
};

} // namespace petrous::library
