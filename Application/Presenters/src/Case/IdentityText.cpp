#include "petrous/Presenters/IdentityText.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <utility>
#include <vector>

#include "PatientHashes.h"
#include "petrous/Library/Deidentification.h"
#include "petrous/Library/FrameSalt.h"

namespace petrous::presenters
{

namespace
{

// A person's name as DICOM writes it, an address, or a date.
const char* const kForms = "[0-9]{1,4}[./-][0-9]{1,2}[./-][0-9]{2,4}|[\\^@]";

// A date with the month in letters, English or German: 12. April 1961, Apr 12, 1961, 12-APR-61.
std::string namedMonths()
{
  const std::string month = "(jan(uary?)?|feb(ruary?)?|m(a|ae|\xC3\xA4|\xC3\x84)r(ch|z)?|apr(il)?|"
                            "ma[iy]|jun[ei]?|jul[iy]?|"
                            "aug(ust)?|sept?(ember)?|o[ck]t(ober)?|nov(ember)?|de[cz](ember)?)";
  return "[0-9]{1,2}(st|nd|rd|th)?[. /_-]{0,2}" + month +
         "[., /_-]{0,2}('?[0-9]{2}|[0-9]{4})([^0-9]|$)|(^|[^a-z])" + month +
         "[. _-]{0,2}[0-9]{1,2}(st|nd|rd|th)?[., _-]{1,2}[0-9]{4}";
}

// A number as long as a record's, in groups too, or with letters in front; a title before a name.
const char* const kNumbersAndTitles =
    "[0-9]{6}|[0-9]{3} [0-9]{3}|"
    "(^|[^A-Za-z0-9])([A-Za-z]{0,3}[0-9]{2,}[-_/][0-9]{3,}|[A-Za-z]{1,3}[-_]?[0-9]{5,})|"
    "(^|[^A-Za-z])(Mr|Mrs|Ms|Miss|Dr|Prof|Herr|Herrn|Frau|Mme|Mlle|Monsieur|Madame|Sr|Sra|Patient|"
    "Patientin)[.]? +[A-Z]";

constexpr std::size_t kLongestName = 5;       // words
constexpr std::size_t kMostCandidates = 4000; // of a text; each is hashed

// Letters of every script, and what joins the parts of a name.
bool isOfWord(unsigned char c)
{
  return std::isalnum(c) != 0 || c >= 0x80 || c == '-' || c == '\'';
}

std::vector<std::string> wordsOf(const std::string& text, bool (*isOf)(unsigned char))
{
  std::vector<std::string> words(1);
  for (const char c : text)
    if (isOf(static_cast<unsigned char>(c)))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  // Quotation marks and dashes around a word are none of it.
  for (std::string& word : words)
  {
    const std::size_t first = std::min(word.find_first_not_of("'-"), word.size());
    word = word.substr(first, word.find_last_not_of("'-") + 1 - first);
  }
  words.erase(std::remove(words.begin(), words.end(), std::string()), words.end());
  return words;
}

// What the text may say of a name or an ID: words that follow each other, as they are and with the
// last in front, which is how DICOM orders a name.
std::set<std::string> candidatesIn(const std::string& text)
{
  std::set<std::string> all;
  const auto add = [&all](const std::vector<std::string>& words)
  {
    for (std::size_t first = 0; first < words.size(); ++first)
    {
      std::string straight, before;
      for (std::size_t n = first; n < std::min(words.size(), first + kLongestName); ++n)
      {
        before = straight;
        straight += (straight.empty() ? "" : " ") + words[n];
        all.insert(straight);
        if (!before.empty())
          all.insert(words[n] + " " + before);
        if (all.size() > kMostCandidates)
          return;
      }
    }
  };
  add(wordsOf(text, isOfWord));
  add(wordsOf(text, [](unsigned char c) { return c > 0x20 && c != ',' && c != ';' && c != ':'; }));
  return all;
}

// A name in a word that it begins or ends: in the genitive or joined to another word. Short ones
// are in words of the field, too.
std::vector<std::string> namesWithin(const std::string& word)
{
  constexpr std::size_t kGenitive = 3, kJoined = 5; // bytes of the name
  std::vector<std::string> names;
  if (word.size() > kGenitive && (word.back() == 's' || word.back() == 'S'))
    names.push_back(word.substr(0, word.size() - 1));
  for (std::size_t n = 1; n < word.size(); ++n)
  {
    if ((static_cast<unsigned char>(word[n]) & 0xC0) == 0x80)
      continue; // within a letter
    if (n >= kJoined)
      names.push_back(word.substr(0, n));
    if (word.size() - n >= kJoined)
      names.push_back(word.substr(n));
  }
  return names;
}

// "123456b": an ID with letters behind it.
std::string withoutLettersBehind(const std::string& word)
{
  constexpr std::size_t kMost = 2, kLeast = 4; // "3D" and "7T" are words of the field
  const std::size_t end = word.find_last_of("0123456789") + 1;
  return end >= kLeast && end < word.size() && word.size() - end <= kMost ? word.substr(0, end)
                                                                          : std::string();
}

bool isCapital(const std::string& word)
{
  constexpr std::size_t kShortest = 3; // letters
  const auto isLetter = [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; };
  const auto first = static_cast<unsigned char>(word.front());
  return word.size() >= kShortest && (std::isupper(first) != 0 || first >= 0xc3) &&
         std::all_of(word.begin(), word.end(),
                     [&](char c) { return isLetter(static_cast<unsigned char>(c)); });
}

// Of diagnoses and operations, as these words end, and some that stand beside them.
bool isClinical(std::string word)
{
  word = scene::lowerCase(std::move(word));
  static const char* const kEndings[] = {"oma",     "itis",  "ectomy", "ektomie", "tomy",
                                         "tomie",   "osis",  "ose",    "ation",   "plasty",
                                         "plastik", "scopy", "skopie"};
  static const char* const kWords[] = {"approach",  "case",    "exam",      "fall",     "implant",
                                       "operation", "plan",    "rehearsal", "revision", "segment",
                                       "structure", "surgery", "teaching",  "training", "ward"};
  return std::any_of(std::begin(kEndings), std::end(kEndings),
                     [&word](const std::string& ending)
                     {
                       return word.size() > ending.size() &&
                              word.compare(word.size() - ending.size(), ending.size(), ending) == 0;
                     }) ||
         std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

} // namespace

IdentityText::IdentityText(const scene::Case& value, scene::IdentitySalt salt)
  : m_salt(std::move(salt))
{
  const auto add = [this](const scene::ImagePart& image)
  {
    m_isSaltLost = m_isSaltLost || (m_salt && !scene::isComparable(image, m_salt));
    if (!scene::isComparable(image, m_salt))
      return;
    for (const std::string* hash : {&image.patient.name, &image.patient.id})
      if (!hash->empty())
        (image.isFrameSalted ? m_salts : m_unsalted).insert(*hash);
    (image.isFrameSalted ? m_salts : m_unsalted)
        .insert(image.patient.nameParts.begin(), image.patient.nameParts.end());
  };
  add(value.ct);
  std::for_each(value.mr.begin(), value.mr.end(), add);
  m_knowsName = !m_isSaltLost && scene::isComparable(value.ct, m_salt) &&
                !value.ct.patient.name.empty() && !value.ct.patient.nameParts.empty();
}

IdentityText::IdentityText(const scene::Case& value, const library::Library& library)
  : IdentityText(value, library::frameSalter(library))
{
}

bool IdentityText::mayIdentify(const std::string& text) const
{
  static const std::regex kNumbered(kNumbersAndTitles);
  return mayIdentifySentence(text) || std::regex_search(text, kNumbered) || hasName(text) ||
         (m_isSaltLost && !isOfField(text));
}

bool IdentityText::mayIdentifySentence(const std::string& text) const
{
  static const std::regex kFormed(kForms);
  static const std::regex kDated(namedMonths(), std::regex::icase);
  return std::regex_search(text, kFormed) || std::regex_search(text, kDated) || isOfPatient(text);
}

bool IdentityText::mayIdentifyPath(const std::filesystem::path& path) const
{
  return std::any_of(path.begin(), path.end(),
                     [this](const std::filesystem::path& part)
                     { return mayIdentify(part.string()); });
}

bool IdentityText::isOfPatient(const std::string& text) const
{
  if (m_unsalted.empty() && (m_salts.empty() || !m_salt))
    return false;
  const auto isHis = [this](std::size_t key)
  {
    const std::string hash = patientHash({key}).id;
    return !hash.empty() && (m_unsalted.count(hash) > 0 ||
                             (m_salt && !m_salts.empty() && m_salts.count(m_salt(hash)) > 0));
  };
  const auto isHisId = [&isHis](const std::string& id)
  { return !id.empty() && isHis(imaging::patientKey(id, {}, {}, {}).id); };
  for (const std::string& words : candidatesIn(text))
    if (isHisId(words) || isHisId(withoutLettersBehind(words)))
      return true;
  // A surname alone, also with a number behind it, or names joined, with or without accents.
  const auto words =
      wordsOf(text, [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; });
  const auto isName = [&isHis](const std::string& word) { return imaging::isOfName(word, isHis); };
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word)
                     {
                       if (isName(word))
                         return true;
                       const auto within =
                           isKnownWord(word) ? std::vector<std::string>() : namesWithin(word);
                       return std::any_of(within.begin(), within.end(), isName);
                     });
}

bool IdentityText::isOfField(const std::string& text) const
{
  const auto words =
      wordsOf(text, [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; });
  return std::all_of(words.begin(), words.end(),
                     [this](const std::string& word)
                     { return word.size() < 2 || isKnownWord(word); });
}

bool IdentityText::isKnownWord(const std::string& word) const
{
  if (library::isDescriptorWord(word) || isClinical(word))
    return true;
  // Some are surnames, too: "Anna Post".
  return !(isCapital(word) && m_presets.isQualifier(word)) &&
         appearance::letterBytes(m_presets.knownWordsOfPart(word)) == appearance::letterBytes(word);
}

bool IdentityText::hasName(const std::string& text) const
{
  const auto words =
      wordsOf(text, [](unsigned char c) { return std::isalnum(c) != 0 || c >= 0x80; });
  const auto isName = [this](const std::string& word)
  { return isCapital(word) && !isKnownWord(word); };
  return std::adjacent_find(words.begin(), words.end(),
                            [&isName](const std::string& a, const std::string& b)
                            { return isName(a) && isName(b); }) != words.end();
}

} // namespace petrous::presenters
