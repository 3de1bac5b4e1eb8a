#include "petrous/Imaging/PatientKey.h"

#include <algorithm>
#include <iterator>

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

PatientKey patientKey(const std::string& id, const std::string& issuer, const std::string& name,
                      const std::string& birthDate)
{
  if (isCasePatientId(plain(id)))
    return {};
  const std::size_t alphabetic = name.find('=');
  return {hashOf(id), hashOf(issuer),
          hashOf(alphabetic == 0 ? name.substr(1) : name.substr(0, alphabetic)), hashOf(birthDate)};
}

} // namespace petrous::imaging
