#include "petrous/Presenters/Phrasebook.h"

#include <algorithm>
#include <array>
#include <map>

#include "GermanPhrases.h"

namespace petrous::presenters
{

namespace
{

// A phrase with fewer letters takes no long names, with fewer yet no names of several words: what
// is no phrase would be found as one.
constexpr std::size_t kFewLetters = 12;
constexpr std::size_t kFewestLetters = 4;
// In a place that ends a phrase: "removal of left lateral semicircular canal".
constexpr std::ptrdiff_t kLongestName = 8; // words
constexpr std::size_t kLongestLine = 2000; // bytes; a longer one is no message
// A list of more is one of names or numbers: each of its parts would be looked up with each other.
constexpr std::ptrdiff_t kLongestList = 16;
constexpr std::string_view kEnds = " ,;:.";  // about a phrase, of the sentence that it stands in
constexpr std::string_view kBullet = "  - "; // before a line of a list

bool isLatinLetter(char c) noexcept
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool isDecimalDigit(char c) noexcept
{
  return c >= '0' && c <= '9';
}

std::string_view middleOf(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(kEnds);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(kEnds) + 1 - first);
}

bool isCapital(char c) noexcept
{
  return c >= 'A' && c <= 'Z';
}

char lowerCase(char c) noexcept
{
  return isCapital(c) ? static_cast<char>(c - 'A' + 'a') : c;
}

// The first letter, of two bytes too: "über" to "Über".
std::string capitalized(std::string text)
{
  const auto byte = [&text](std::size_t at)
  { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U; };
  if (byte(0) >= 'a' && byte(0) <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  else if (byte(0) == 0xc3 && byte(1) >= 0xa0 && byte(1) <= 0xbe && byte(1) != 0xb7)
    text[1] = static_cast<char>(byte(1) - 0x20);
  return text;
}

bool startsWith(std::string_view text, std::string_view with)
{
  return text.substr(0, with.size()) == with;
}

bool endsWith(std::string_view text, std::string_view with)
{
  return text.size() >= with.size() && text.substr(text.size() - with.size()) == with;
}

std::ptrdiff_t countOf(std::string_view mark, std::string_view text) noexcept
{
  std::ptrdiff_t count = 0;
  for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + mark.size()))
    ++count;
  return count;
}

bool hasLetters(std::string_view text) noexcept
{
  return std::any_of(text.begin(), text.end(), isLatinLetter);
}

// "5", "-0.2 N/mm".
bool isNumber(std::string_view value)
{
  if (value == "nan" || value == "inf" || value == "-inf")
    return true;
  const std::size_t first = value.find_first_not_of("+-<");
  return first != std::string_view::npos && isDecimalDigit(value[first]) &&
         std::count(value.begin(), value.end(), ' ') <= 1;
}

// No sentence: three words at most, as in "lateral semicircular canal", or as many as are said.
bool isShort(std::string_view value, std::ptrdiff_t words = 3)
{
  return value.find(", ") == std::string_view::npos && value.find(": ") == std::string_view::npos &&
         std::count(value.begin(), value.end(), ' ') < words;
}

// Whether it may be a name, a path or a number, and not sentences.
bool isPlain(std::string_view value)
{
  return value.find("; ") == std::string_view::npos && value.find(". ") == std::string_view::npos &&
         value.find('\n') == std::string_view::npos;
}

std::string unescapedXml(std::string_view text)
{
  static constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
  std::string result;
  while (!text.empty())
  {
    const auto* entity = std::find_if(kEntities.begin(), kEntities.end(),
                                      [&](const auto& one) { return startsWith(text, one.first); });
    if (entity == kEntities.end())
    {
      result += text.front();
      text.remove_prefix(1);
      continue;
    }
    result += entity->second;
    text.remove_prefix(entity->first.size());
  }
  return result;
}

} // namespace

Phrasebook::Pieces Phrasebook::piecesOf(const std::string& phrase)
{
  Pieces pieces(1);
  for (std::size_t n = 0; n < phrase.size();)
  {
    const char kind = n + 1 < phrase.size() ? phrase[n + 1] : ' ';
    const std::size_t digits = n + (kind == '~' || kind == '#' ? 2 : 1);
    if (phrase[n] != '%' || digits >= phrase.size() || !isDecimalDigit(phrase[digits]))
    {
      pieces.back().words += phrase[n++];
      continue;
    }
    int place = 0;
    for (n = digits; n < phrase.size() && isDecimalDigit(phrase[n]); ++n)
      place = 10 * place + (phrase[n] - '0');
    pieces.back().place = place;
    pieces.back().isPhrase = kind == '~';
    pieces.back().isNumber = kind == '#';
    pieces.emplace_back();
  }
  return pieces;
}

Phrasebook::Phrasebook(const std::vector<Phrase>& phrases)
{
  m_entries.reserve(phrases.size());
  for (const auto& [english, other] : phrases)
  {
    Entry entry{piecesOf(std::string(middleOf(english))), piecesOf(std::string(middleOf(other)))};
    for (const Piece& piece : entry.english)
    {
      entry.letters += static_cast<std::size_t>(
          std::count_if(piece.words.begin(), piece.words.end(), isLatinLetter));
      entry.characters += piece.words.size();
    }
    m_entries.push_back(std::move(entry));
  }
  std::stable_sort(m_entries.begin(), m_entries.end(),
                   [](const Entry& a, const Entry& b) {
                     return std::pair(a.letters, a.characters) > std::pair(b.letters, b.characters);
                   });
  for (const Entry& entry : m_entries)
  {
    const std::string& first = entry.english.front().words;
    const std::string& last = entry.english.back().words;
    m_ends.emplace_back(first.empty() ? '\0' : first.front(), last.empty() ? '\0' : last.back());
  }
}

std::optional<std::string> Phrasebook::find(std::string_view english) const
{
  std::string text;
  bool isFound = false;
  for (std::size_t begin = 0; begin <= english.size();) // no phrase has two lines
  {
    const std::size_t end = std::min(english.find('\n', begin), english.size());
    std::string_view line = english.substr(begin, end - begin);
    text += begin == 0 ? "" : "\n";
    if (startsWith(line, kBullet))
    {
      text += kBullet;
      line.remove_prefix(kBullet.size());
    }
    Memory memory;
    const auto found = line.size() <= kLongestLine ? lookUp(line, memory) : std::nullopt;
    isFound = isFound || found;
    text += found ? found->text : std::string(line);
    begin = end + 1;
  }
  return isFound ? std::optional(text) : std::nullopt;
}

std::string Phrasebook::text(std::string_view english) const
{
  auto found = find(english);
  return found ? *std::move(found) : std::string(english);
}

std::optional<Phrasebook::Found> Phrasebook::lookUp(std::string_view part, Memory& memory) const
{
  const std::string_view middle = middleOf(part);
  if (middle.empty())
    return std::nullopt;
  const auto known = memory.find({part.data(), part.size()});
  if (known != memory.end())
    return known->second;
  auto found = whole(middle, memory);
  // A message begins a sentence with a capital: "Repeated fits agree; ...".
  if ((!found || !found->isWhole) && isCapital(middle.front()))
    if (auto inside = whole(middle, memory, true); inside && (inside->isWhole || !found))
    {
      inside->text = capitalized(std::move(inside->text));
      found = std::move(inside);
    }
  if (!found || !found->isWhole)
    if (auto parts = divided(middle, memory); parts && (parts->isWhole || !found))
      found = std::move(parts);
  if (found)
  {
    const auto begin = static_cast<std::size_t>(middle.data() - part.data());
    found->text = std::string(part.substr(0, begin)) + found->text +
                  std::string(part.substr(begin + middle.size()));
  }
  memory[{part.data(), part.size()}] = found;
  return found;
}

std::optional<Phrasebook::Found> Phrasebook::whole(std::string_view middle, Memory& memory,
                                                   bool isCapitalized) const
{
  std::optional<Found> best;
  const char begin = isCapitalized ? lowerCase(middle.front()) : middle.front();
  for (std::size_t n = 0; n < m_entries.size(); ++n)
  {
    const auto [first, last] = m_ends[n];
    if ((first != begin && (first != '\0' || isCapitalized)) ||
        (last != '\0' && last != middle.back()))
      continue;
    auto found = matched(m_entries[n], middle, memory, isCapitalized);
    if (found && found->isWhole)
      return found;
    if (found && !best)
      best = std::move(found);
  }
  return best;
}

std::optional<Phrasebook::Found> Phrasebook::matched(const Entry& entry, std::string_view middle,
                                                     Memory& memory, bool isCapitalized) const
{
  const Pieces& pieces = entry.english;
  // The caller has compared the first letter.
  const std::size_t same = isCapitalized ? 1 : 0;
  const std::string_view words = pieces.front().words;
  if (!startsWith(middle.substr(same), words.substr(std::min(same, words.size()))))
    return std::nullopt;
  if (pieces.size() == 1)
    return middle.size() == words.size() ? std::optional<Found>(Found{entry.other.front().words})
                                         : std::nullopt;
  if (!endsWith(middle, pieces.back().words))
    return std::nullopt;
  std::map<int, std::string> values;
  bool isWhole = true;
  std::size_t at = pieces.front().words.size();
  const std::size_t end = middle.size() - pieces.back().words.size();
  for (std::size_t n = 0; n + 1 < pieces.size(); ++n)
  {
    const bool isLast = n + 2 == pieces.size();
    const std::string& next = pieces[n + 1].words;
    const std::size_t upTo = isLast ? end : middle.find(next, at);
    if (at > end || upTo == std::string_view::npos || upTo > end)
      return std::nullopt;
    const std::string_view value = middle.substr(at, upTo - at);
    if (pieces[n].isNumber)
    {
      if (!isNumber(value))
        return std::nullopt;
      values[pieces[n].place] = std::string(value);
      at = upTo + next.size();
      continue;
    }
    const bool isSeveral = value.find(' ') != std::string_view::npos && !isNumber(value);
    // What stands in quotes is a name, whatever it reads as.
    const bool isQuoted =
        !pieces[n].isPhrase && endsWith(pieces[n].words, "'") && startsWith(next, "'");
    std::optional<Found> other;
    const bool isLookedUp = pieces[n].isPhrase || value.find(' ') != std::string_view::npos;
    if (!value.empty() && !isQuoted && isLookedUp)
      other = lookUp(value, memory);
    if (other && other->isWhole)
      values[pieces[n].place] = other->text;
    else
    {
      const bool isFew = entry.letters < kFewLetters;
      // "removal of %1", and nothing after it
      const bool isName =
          n == 0 && isLast && end == middle.size() && entry.letters >= kFewLetters / 2;
      if (!isPlain(value) || (isFew && !isShort(value, isName ? kLongestName : 3)) ||
          (pieces[n].isPhrase && isFew && pieces.size() > 2 && !value.empty() &&
           !isNumber(value)) ||
          (entry.letters < kFewestLetters && isSeveral && !isQuoted) ||
          (entry.letters < kFewestLetters - 1 && !isNumber(value) && !isQuoted))
        return std::nullopt;
      isWhole = isWhole && !(pieces[n].isPhrase && isSeveral);
      values[pieces[n].place] = other ? other->text : std::string(value);
    }
    at = upTo + next.size();
  }
  Found found{{}, isWhole};
  for (const Piece& piece : entry.other)
  {
    found.text += piece.words;
    if (piece.place != 0)
      found.text += values[piece.place];
  }
  return found;
}

std::optional<Phrasebook::Found> Phrasebook::divided(std::string_view part, Memory& memory) const
{
  std::optional<Found> best;
  for (const std::string_view mark : {". ", "; ", ": ", " (", ", "})
  {
    if (countOf(mark, part) > kLongestList)
      continue;
    for (std::size_t at = part.find(mark); at != std::string_view::npos;
         at = part.find(mark, at + 1))
    {
      const std::string_view head = part.substr(0, at);
      std::string_view tail = part.substr(at + mark.size());
      const bool isClosed = mark == " (" && endsWith(tail, ")");
      if (mark == " (" && !isClosed)
        continue;
      if (isClosed)
        tail.remove_suffix(1);
      // Before a colon stands a name or a file, if it is one word.
      const auto first = mark == ": " && head.find(' ') == std::string_view::npos
                             ? std::nullopt
                             : lookUp(head, memory);
      const auto second = lookUp(tail, memory);
      if (!first && !second)
        continue;
      // A list is one only if all of it is known.
      const bool isWhole = (first ? first->isWhole : mark == ": " || !hasLetters(head)) &&
                           (second ? second->isWhole : mark == " (" || !hasLetters(tail));
      if (mark == ", " && !isWhole)
        continue;
      Found found{(first ? first->text : std::string(head)) + std::string(mark) +
                      (second ? second->text : std::string(tail)) + (isClosed ? ")" : ""),
                  isWhole};
      if (isWhole)
        return found;
      if (!best)
        best = std::move(found);
    }
  }
  return best;
}

namespace
{

bool isOfWord(char c) noexcept
{
  return isDecimalDigit(c) || isLatinLetter(c) || c == '_' || c == '/' || c == '\\';
}

/// Whether the text's digits and points from `begin` to `end` are a number of their own, not part
/// of a name, a file, a version or a UID: "T2-0.5", "0.5.nii", "1.2.840".
bool isDecimal(std::string_view text, std::size_t begin, std::size_t end) noexcept
{
  const auto at = [text](std::size_t n) { return n < text.size() ? text[n] : ' '; };
  const std::string_view number = text.substr(begin, end - begin);
  const bool hasSign = begin > 0 && (at(begin - 1) == '-' || at(begin - 1) == '+');
  const std::size_t first = hasSign ? begin - 1 : begin;
  return std::count(number.begin(), number.end(), '.') == 1 && isDecimalDigit(number.front()) &&
         !(first > 0 && isOfWord(at(first - 1))) && !isOfWord(at(end)) &&
         !(at(end) == '.' && isOfWord(at(end + 1)));
}

/// Whether the word before `at` says that a version follows: "TLS 1.2".
bool isVersionBehind(std::string_view text, std::size_t at) noexcept
{
  constexpr std::string_view kNames[] = {"TLS", "OpenGL", "GLSL", "Version", "version"};
  if (at == 0 || text[at - 1] != ' ')
    return false;
  const std::size_t end = at - 1;
  std::size_t begin = end;
  while (begin > 0 && isOfWord(text[begin - 1]))
    --begin;
  const std::string_view word = text.substr(begin, end - begin);
  return std::find(std::begin(kNames), std::end(kNames), word) != std::end(kNames);
}

/// The end of the path that begins there, which may hold blanks: before the next ": ", or of the
/// text. `at` itself if none does. A relative path is known at the beginning of the text only.
std::size_t pathEnd(std::string_view text, std::size_t at) noexcept
{
  const std::string_view rest = text.substr(at);
  const bool begins = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
  const bool isAbsolute = begins && rest.size() > 1 && rest[0] == '/' && rest[1] != ' ';
  if (!isAbsolute && at > 0)
    return at;
  const std::size_t end = std::min(rest.find(": "), rest.size());
  const std::string_view path = rest.substr(0, end);
  const bool isRelative = end < rest.size() && path.find('/') != std::string_view::npos &&
                          path.find(" / ") == std::string_view::npos;
  return isAbsolute || isRelative ? at + end : at;
}

} // namespace

std::string withDecimalCommas(std::string text)
{
  constexpr std::string_view kOpening = "\u201e", kClosing = "\u201c";
  bool isQuoted = false;
  for (std::size_t n = 0; n < text.size(); ++n)
  {
    if (!isQuoted)
      n = pathEnd(text, n);
    if (n >= text.size())
      break;
    if (text.compare(n, kOpening.size(), kOpening) == 0)
      isQuoted = true;
    else if (text.compare(n, kClosing.size(), kClosing) == 0)
      isQuoted = false;
    else if (text[n] == '\'')
      isQuoted = !isQuoted && (n == 0 || text[n - 1] == ' ' || text[n - 1] == '(');
    if (isQuoted || !isDecimalDigit(text[n]))
      continue;
    std::size_t end = std::min(text.find_first_not_of("0123456789.", n), text.size());
    while (text[end - 1] == '.')
      --end;
    if (isDecimal(text, n, end) && !isVersionBehind(text, n))
    {
      text[text.find('.', n)] = ',';
      const char next = end + 2 < text.size() ? text[end + 2] : ' ';
      if (text.compare(end, 2, ", ") == 0 && (isDecimalDigit(next) || next == '-'))
        text[end] = ';'; // of a list
    }
    n = end - 1;
  }
  return text;
}

const std::vector<Phrasebook::Phrase>& germanPhraseList()
{
  static const std::vector<Phrasebook::Phrase> kPhrases = []
  {
    std::vector<Phrasebook::Phrase> phrases;
    std::size_t at = 0;
    const auto next = [&at](std::string_view begin, std::string_view end)
    {
      at = kGermanPhrases.find(begin, at);
      if (at == std::string_view::npos)
        return std::string();
      at += begin.size();
      const std::size_t from = at;
      at = kGermanPhrases.find(end, at);
      return unescapedXml(kGermanPhrases.substr(from, at - from));
    };
    while (at != std::string_view::npos)
    {
      std::string english = next("<source>", "</source>");
      if (at == std::string_view::npos)
        break;
      std::string german = next("<translation>", "</translation>");
      phrases.emplace_back(std::move(english), std::move(german));
    }
    return phrases;
  }();
  return kPhrases;
}

const Phrasebook& germanPhrases()
{
  static const Phrasebook kBook(germanPhraseList());
  return kBook;
}

std::string withGroupedDigits(const std::string& text)
{
  constexpr std::string_view kNarrowSpace = "\u202f";
  constexpr std::size_t kLeast = 5; // digits: 10,000
  std::string grouped;
  for (std::size_t n = 0; n < text.size();)
  {
    if (!isDecimalDigit(text[n]))
    {
      grouped += text[n++];
      continue;
    }
    const std::size_t end = std::min(text.find_first_not_of("0123456789", n), text.size());
    const bool isWhole = n == 0 || (text[n - 1] != '.' && text[n - 1] != ',');
    const bool isGrouped = isWhole && end - n >= kLeast;
    for (; n < end; ++n)
    {
      grouped += text[n];
      if (isGrouped && end - n > 1 && (end - n) % 3 == 1)
        grouped += kNarrowSpace;
    }
  }
  return grouped;
}

} // namespace petrous::presenters
