#include "petrous/Imaging/PatientKey.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "petrous/Core/Fingerprint.h"
#include "petrous/Imaging/CasePatient.h"

namespace petrous::imaging
{

namespace
{

constexpr const char* kCasePrefix = "PETROUS-";
constexpr std::size_t kCaseDigits = 16;
constexpr const char* kHexadecimal = "0123456789ABCDEF";

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

/// 0 for what names nobody, as this program and others write where an identity was removed.
std::size_t hashOf(const std::string& text)
{
  static const char* const kNobody[] = {
      "",        "ANONYMOUS", "ANONYMIZED",       "ANONYMISED", "ANON",    "ANONYM",
      "UNKNOWN", "NONE",      "IDENTITY REMOVED", "REMOVED",    "NO NAME", "NONAME"};
  const std::string what = plain(text);
  if (std::find(std::begin(kNobody), std::end(kNobody), what) != std::end(kNobody))
    return 0;
  core::Fingerprint hash;
  hash.add(what.data(), what.size());
  return std::max<std::size_t>(hash.value(), 1);
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

/// Of family, given and middle name: what follows is a title.
std::array<std::size_t, 6> namePartsOf(const std::string& name)
{
  constexpr int kTitles = 3; // delimiters before them
  std::array<std::size_t, 6> parts{};
  std::size_t count = 0;
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
    const std::size_t key = namePartKey(word);
    if (key != 0 && count < parts.size() &&
        std::find(parts.begin(), parts.end(), key) == parts.end())
      parts[count++] = key;
    word.clear();
    delimiters += c == '^' ? 1 : 0;
    if (delimiters == kTitles)
      break;
  }
  return parts;
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
  static const char* const kNoName[] = {"VON",  "VAN",     "DER",     "DEN",  "DES",  "DEL",
                                        "DOS",  "ZUR",     "ZUM",     "UND",  "THE",  "AND",
                                        "TEST", "PHANTOM", "PETROUS", "DEMO", "MRS",  "HERR",
                                        "FRAU", "PATIENT", "SAMPLE",  "CASE", "PROF", "NAME"};
  constexpr std::size_t kShortest = 3;
  const std::string what = transcribed(plain(word));
  const bool isText =
      std::any_of(what.begin(), what.end(), [](unsigned char c) { return c < '0' || c > '9'; });
  if (what.size() < kShortest || !isText ||
      std::find(std::begin(kNoName), std::end(kNoName), what) != std::end(kNoName))
    return 0;
  return hashOf(what);
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
    key.nameParts = namePartsOf(first);
  return key;
}

} // namespace petrous::imaging
