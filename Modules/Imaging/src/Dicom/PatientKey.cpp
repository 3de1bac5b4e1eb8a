#include "petrous/Imaging/PatientKey.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "petrous/Core/Fingerprint.h"
#include "petrous/Imaging/CasePatient.h"

namespace petrous::imaging
{

namespace
{

constexpr const char* kCasePrefix = "PETROUS-";
constexpr std::size_t kCaseDigits = 16;
constexpr const char* kHexadecimal = "0123456789ABCDEF";
constexpr std::size_t kShortest = 3; // letters of a word that is a name by itself

/// Base letters (Unicode NFKD, and of letters with a stroke) of U+00C0 to U+024F and of U+1E00 to
/// U+1EFF; '.': none, or two.
constexpr char kLatin[] =
    "AAAAAA.CEEEEIIIIDNOOOOO.OUUUUY..AAAAAA.CEEEEIIIIDNOOOOO.OUUUUY.YAAAAAACCCCCCCCDD"
    "DDEEEEEEEEEEGGGGGGGGHHHHIIIIIIIIII..JJKK.LLLLLL..LLNNNNNN.NNOOOOOO..RRRRRRSSSSSS"
    "SSTTTTTTUUUUUUUUUUUUWWYYYZZZZZZSBB....O..DD.....E.F....IKKL..N..OO.............U"
    "U..YYZZ......................AAIIOOUUUUUUUUUU.AAAA..GGGGKKOOOO..J...GG..NNAA...."
    "AAAAEEEEIIIIOOOORRRRUUUUSSTT..HH......AAEEOOOOOOOOYY......ACCLT.................";
constexpr char kLatinAdditional[] =
    "AABBBBBBCCDDDDDDDDDDEEEEEEEEEEFFGGHHHHHHHHHHIIIIKKKKKKLLLLLLLLMMMMMMNNNNNNNNOOOO"
    "OOOOPPPPRRRRRRRRSSSSSSSSSSTTTTTTTTUUUUUUUUUUVVVVWWWWWWWWWWXXXXYYZZZZZZHTWY.S...."
    "AAAAAAAAAAAAAAAAAAAAAAAAEEEEEEEEEEEEEEEEIIIIOOOOOOOOOOOOOOOOOOOOOOOOUUUUUUUUUUUU"
    "UUYYYYYYYY......";
constexpr unsigned kFirstLatin = 0xC0;
constexpr unsigned kFirstAdditional = 0x1E00;
static_assert(sizeof kLatin == 0x24F - kFirstLatin + 2);
static_assert(sizeof kLatinAdditional == 0x1EFF - kFirstAdditional + 2);

/// Capital letters (ASCII and Latin-1), with one space for each run of spaces and delimiters.
std::string plain(const std::string& text)
{
  std::string result;
  unsigned char before = 0;
  for (const char each : text)
  {
    const auto c = static_cast<unsigned char>(each);
    const bool isDelimiter = c <= 0x20 || c == '^' || c == ',';
    if (!isDelimiter)
    {
      const bool isLatin = before == 0xC3 && c >= 0xA0 && c <= 0xBE && c != 0xB7; // UTF-8
      result += static_cast<char>((c >= 'a' && c <= 'z') || isLatin ? c - 0x20 : c);
    }
    else if (!result.empty() && result.back() != ' ')
      result += ' ';
    before = c;
  }
  if (!result.empty() && result.back() == ' ')
    result.pop_back();
  return result;
}

std::size_t fingerprintOf(const std::string& text)
{
  core::Fingerprint hash;
  hash.add(text.data(), text.size());
  return std::max<std::size_t>(hash.value(), 1);
}

/// 0 for what names nobody, as this program and others write where an identity was removed.
std::size_t hashOf(const std::string& text)
{
  static constexpr std::string_view kNobody[] = {
      "",        "ANONYMOUS", "ANONYMIZED",       "ANONYMISED", "ANON",    "ANONYM",
      "UNKNOWN", "NONE",      "IDENTITY REMOVED", "REMOVED",    "NO NAME", "NONAME"};
  const std::string what = plain(text);
  if (std::find(std::begin(kNobody), std::end(kNobody), what) != std::end(kNobody))
    return 0;
  return fingerprintOf(what);
}

std::string transcribed(const std::string& capitals)
{
  std::string text = capitals;
  for (const auto& [letter, ascii] : {std::pair("\xC3\x84", "AE"), std::pair("\xC3\x96", "OE"),
                                      std::pair("\xC3\x9C", "UE"), std::pair("\xC3\x9F", "SS")})
    for (std::size_t at = 0; (at = text.find(letter, at)) != std::string::npos;)
      text.replace(at, 2, ascii);
  return text;
}

/// Base letters of Latin letters with accents, composed or not; all else as it is.
std::string unaccented(const std::string& capitals)
{
  const auto base = [](unsigned code) -> std::string
  {
    switch (code)
    {
    case 0x00C6: // with accents too
    case 0x00E6:
    case 0x01E2:
    case 0x01E3:
    case 0x01FC:
    case 0x01FD:
      return "AE";
    case 0x0152:
    case 0x0153:
      return "OE";
    case 0x0132:
    case 0x0133:
      return "IJ";
    case 0x00DE:
    case 0x00FE:
      return "TH";
    case 0x00DF:
    case 0x1E9E:
      return "SS";
    default:
      break;
    }
    char letter = '.';
    if (code >= kFirstLatin && code - kFirstLatin < sizeof kLatin - 1)
      letter = kLatin[code - kFirstLatin];
    else if (code >= kFirstAdditional && code - kFirstAdditional < sizeof kLatinAdditional - 1)
      letter = kLatinAdditional[code - kFirstAdditional];
    return letter == '.' ? std::string() : std::string(1, letter);
  };
  std::string result;
  for (std::size_t at = 0; at < capitals.size();)
  {
    const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(capitals[at + n]); };
    if (byte(0) < 0x80)
    {
      result += capitals[at++];
      continue;
    }
    const std::size_t wanted = (byte(0) & 0xE0) == 0xC0 ? 2 : (byte(0) & 0xF0) == 0xE0 ? 3 : 1;
    const std::size_t bytes = at + wanted <= capitals.size() ? wanted : 1;
    unsigned code = 0;
    if (bytes == 2)
      code = (byte(0) & 0x1FU) << 6 | (byte(1) & 0x3FU);
    else if (bytes == 3)
      code = (byte(0) & 0x0FU) << 12 | (byte(1) & 0x3FU) << 6 | (byte(2) & 0x3FU);
    const bool isMark = code >= 0x300 && code <= 0x36F; // combining
    const std::string letters = base(code);
    if (!isMark)
      result += letters.empty() ? capitals.substr(at, bytes) : letters;
    at += bytes;
  }
  return result;
}

/// Without accents, and with ae, oe and ue as one letter.
std::string folded(const std::string& capitals)
{
  const std::string text = unaccented(capitals);
  std::string result;
  for (const char c : text)
  {
    const char before = result.empty() ? ' ' : result.back();
    if (c != 'E' || (before != 'A' && before != 'O' && before != 'U'))
      result += c;
  }
  return result;
}

/// Particles, titles and what stands in the names of phantoms.
bool isNoName(const std::string& capitals)
{
  static constexpr std::string_view kNoName[] = {
      "VON", "VAN",  "DER",  "DEN",     "DES",    "DEL",     "DOS",     "ZUR",
      "ZUM", "UND",  "THE",  "AND",     "TEST",   "PHANTOM", "PETROUS", "DEMO",
      "MRS", "HERR", "FRAU", "PATIENT", "SAMPLE", "CASE",    "PROF",    "NAME"};
  return std::find(std::begin(kNoName), std::end(kNoName), capitals) != std::end(kNoName);
}

bool isNumber(const std::string& text)
{
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c >= '0' && c <= '9'; });
}

/// Of family, given and middle name: what follows is a title.
std::vector<std::string> wordsOfName(const std::string& name)
{
  constexpr int kTitles = 3; // delimiters before them
  std::vector<std::string> words;
  int delimiters = 0;
  std::string word;
  for (const char c : name + " ")
  {
    const bool isDelimiter = static_cast<unsigned char>(c) <= 0x20 || c == '^' || c == ',' ||
                             c == '-' || c == '.' || c == '\'';
    if (!isDelimiter)
    {
      word += c;
      continue;
    }
    if (!word.empty())
      words.push_back(word);
    word.clear();
    delimiters += c == '^' ? 1 : 0;
    if (delimiters == kTitles)
      break;
  }
  return words;
}

/// The first different keys of words that have one.
template <std::size_t Most>
std::array<std::size_t, Most> keysOf(const std::vector<std::string>& words,
                                     std::size_t (*keyOf)(const std::string&))
{
  std::array<std::size_t, Most> keys{};
  std::size_t count = 0;
  for (const std::string& word : words)
  {
    const std::size_t key = keyOf(word);
    if (key != 0 && count < keys.size() && std::find(keys.begin(), keys.end(), key) == keys.end())
      keys[count++] = key;
  }
  return keys;
}

bool startsCharacter(char c)
{
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

/// Whether parts of a name, and particles, make up all of a text of capital letters.
bool isMadeOfParts(const std::string& text, const std::function<bool(std::size_t)>& isPart)
{
  constexpr std::size_t kLongest = 60; // bytes; of a longer one it is not tried
  const auto isKey = [&isPart](std::size_t key) { return key != 0 && isPart(key); };
  const auto is = [&isKey](const std::string& part)
  { return isKey(namePartKey(part)) || isKey(foldedPartKey(part)); };
  if (text.size() > kLongest)
    return is(text);
  // By the end of what is made up: of how many letters the name is known by. A single one, as of
  // O'Brien, is taken in front alone and says nothing.
  std::vector<std::optional<std::size_t>> known(text.size() + 1);
  known[0] = 0;
  for (std::size_t from = 0; from < text.size(); ++from)
  {
    std::size_t letters = 0;
    for (std::size_t to = from + 1; known[from] && to <= text.size(); ++to)
    {
      letters += startsCharacter(text[to - 1]) ? 1 : 0;
      if (to < text.size() && !startsCharacter(text[to]))
        continue;
      const std::string part = text.substr(from, to - from);
      const bool isParticle = isNoName(part);
      if (isParticle || ((letters > 1 || from == 0) && is(part)))
        known[to] = std::max(known[to].value_or(0),
                             *known[from] + (isParticle || letters < 2 ? 0 : letters));
    }
  }
  return known.back().value_or(0) >= kShortest;
}

} // namespace

std::string casePatientId(std::uint64_t hash)
{
  std::string digits(kCaseDigits, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4)
    *digit = kHexadecimal[hash & 0xF];
  return kCasePrefix + digits;
}

bool isCasePatientId(const std::string& id)
{
  const std::string prefix = kCasePrefix;
  return id.size() == prefix.size() + kCaseDigits && id.compare(0, prefix.size(), prefix) == 0 &&
         id.find_first_not_of(kHexadecimal, prefix.size()) == std::string::npos;
}

std::size_t namePartKey(const std::string& word)
{
  const std::string what = transcribed(plain(word));
  return what.size() < kShortest || isNumber(what) || isNoName(what) ? 0 : hashOf(what);
}

std::size_t foldedPartKey(const std::string& word)
{
  const std::string what = folded(plain(word));
  const std::size_t key = isNoName(what) ? 0 : hashOf(what);
  const bool isNone = key != 0 && (what.size() < kShortest || isNumber(what));
  return isNone ? fingerprintOf("^" + what) : key; // which plain() leaves in no text
}

bool isOfName(const std::string& word, const std::function<bool(std::size_t)>& isPart)
{
  const std::string capitals = plain(word);
  const std::string letters = unaccented(capitals);
  return isMadeOfParts(transcribed(capitals), isPart) ||
         (letters != capitals && isMadeOfParts(letters, isPart));
}

PatientKey patientKey(const std::string& id, const std::string& issuer, const std::string& name,
                      const std::string& birthDate)
{
  const std::size_t alphabetic = name.find('=');
  const std::string first = alphabetic == 0 ? name.substr(1) : name.substr(0, alphabetic);
  PatientKey key{hashOf(id), hashOf(issuer), hashOf(first), hashOf(birthDate)};
  if (isCasePatientId(plain(id)))
  {
    const std::string family = plain(kCaseFamilyName) + " ";
    key.id = key.issuer = 0;
    if (plain(first).compare(0, family.size(), family) == 0)
      key.name = 0;
    if (key.name == 0)
      key.nameParts[0] = hashOf(id);
  }
  if (key.name != 0)
  {
    const std::vector<std::string> words = wordsOfName(first);
    key.nameParts = keysOf<6>(words, namePartKey);
    std::string all = "^"; // so that it is of no text
    bool isNamed = false;  // not by a number, as phantoms are
    for (const std::string& word : words)
    {
      all += folded(plain(word));
      isNamed = isNamed || (foldedPartKey(word) != 0 && !isNumber(word));
    }
    if (isNamed)
    {
      key.foldedParts = keysOf<8>(words, foldedPartKey);
      key.joinedName = fingerprintOf(all);
    }
  }
  return key;
}

} // namespace petrous::imaging
