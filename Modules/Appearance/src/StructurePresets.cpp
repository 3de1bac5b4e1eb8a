#include "petrous/Appearance/StructurePresets.h"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "PresetEntry.h"
#include "Structures.h"
#include "petrous/Appearance/OwnPresets.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/Error.h"

namespace petrous::appearance
{

namespace
{

using nlohmann::json;

// Runs of letters or digits, in lower case; split also at camelCase boundaries.
std::vector<std::string> wordsOf(const std::string& name)
{
  std::vector<std::string> words(1);
  unsigned char before = 0;
  for (const char each : name)
  {
    const auto c = static_cast<unsigned char>(each);
    const bool isDigit = std::isdigit(c) != 0;
    const bool isLetter = c >= 0x80 || std::isalpha(c) != 0; // UTF-8 beyond ASCII
    const bool begins = (std::isdigit(before) != 0) != isDigit ||
                        (std::isupper(c) != 0 && std::islower(before) != 0);
    if (((!isDigit && !isLetter) || begins) && !words.back().empty())
      words.emplace_back();
    if (isDigit || isLetter)
      words.back() += core::asciiLower(each);
    before = c;
  }
  if (words.back().empty())
    words.pop_back();
  return words;
}

bool isShortNumber(const std::string& word)
{
  return word.size() <= 2 && std::isdigit(static_cast<unsigned char>(word[0])) != 0;
}

// ASCII letters that stand for those of Latin-1: lower-case letters without accents, umlauts as
// German writes them without ("ae"), also where they are composed of a letter and a mark.
std::string folded(const std::string& word)
{
  static const char* const kLetters[] = {
      // from U+00C0
      "a", "a", "a", "a", "ae", "a", "ae", "c", "e", "e", "e", "e", "i",  "i", "i",  "i",
      "d", "n", "o", "o", "o",  "o", "oe", "",  "o", "u", "u", "u", "ue", "y", "th", "ss",
      "a", "a", "a", "a", "ae", "a", "ae", "c", "e", "e", "e", "e", "i",  "i", "i",  "i",
      "d", "n", "o", "o", "o",  "o", "oe", "",  "o", "u", "u", "u", "ue", "y", "th", "y"};
  std::string result;
  for (std::size_t n = 0; n < word.size(); ++n)
  {
    const auto c = static_cast<unsigned char>(word[n]);
    const auto next = static_cast<unsigned char>(n + 1 < word.size() ? word[n + 1] : 0);
    if (c == 0xC3 && next >= 0x80 && next < 0xC0)
    {
      result += kLetters[next - 0x80];
      ++n;
    }
    else if (c == 0xCC && next >= 0x80 && next < 0xC0) // a combining mark
    {
      if (next == 0x88 && !result.empty() && std::string("aou").find(result.back()) != result.npos)
        result += 'e';
      ++n;
    }
    else
      result += core::asciiLower(static_cast<char>(c));
  }
  return result;
}

std::vector<std::string> foldedWords(const std::string& name)
{
  std::vector<std::string> words = wordsOf(name);
  std::transform(words.begin(), words.end(), words.begin(), folded);
  return words;
}

// A given name too: the side where a name states no other.
constexpr const char* kSideOrName = "dexter";

// Letters that are a side in some languages, and may be anything in others.
bool isDoubtfulSide(const std::string& word)
{
  return word == "d" || word == "g" || word == "s";
}

// Whether a word is a stem of the catalogue with an ending of English, Latin or German, if any:
// "dural" of "dura", and not "durable".
bool isFormOf(const std::string& word, const std::string& stem)
{
  static const char* const kEndings[] = {
      "s",    "es",   "i",   "y",    "al",   "ar",    "ae",    "um",   "le",    "is",
      "els",  "oma",  "ium", "ule",  "ine",  "ic",    "us",    "a",    "e",     "en",
      "n",    "er",   "eus", "ea",   "eal",  "alis",  "aris",  "ales", "ares",  "r",
      "l",    "as",   "ma",  "mas",  "ulum", "ula",   "ulae",  "ular", "ulare", "ularis",
      "arum", "orum", "ata", "atic", "idea", "oidea", "oideus"};
  constexpr std::size_t kShortestStem = 4;
  if (word.compare(0, stem.size(), stem) != 0)
    return false;
  const std::string ending = word.substr(stem.size());
  return ending.empty() || ending == "s" ||
         (stem.size() >= kShortestStem &&
          std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings));
}

bool matchesPattern(const std::string& word, std::string_view pattern)
{
  const bool isOpenBefore = !pattern.empty() && pattern.front() == '*';
  if (isOpenBefore)
    pattern.remove_prefix(1);
  const bool isOpenAfter = !pattern.empty() && pattern.back() == '*';
  if (isOpenAfter)
    pattern.remove_suffix(1);
  if (isOpenBefore && isOpenAfter)
    return word.find(pattern) != word.npos;
  if (word.size() < pattern.size())
    return false;
  return isOpenAfter    ? word.compare(0, pattern.size(), pattern) == 0
         : isOpenBefore ? word.compare(word.size() - pattern.size(), word.npos, pattern) == 0
                        : word == pattern;
}

bool matchesOneOf(const std::string& word, const std::vector<std::string>& patterns)
{
  return std::any_of(patterns.begin(), patterns.end(),
                     [&word](const std::string& pattern) { return matchesPattern(word, pattern); });
}

bool hasWordOf(const std::vector<std::string>& name, const std::vector<std::string>& patterns)
{
  return std::any_of(name.begin(), name.end(),
                     [&patterns](const std::string& word) { return matchesOneOf(word, patterns); });
}

} // namespace

StructureAppearance presetFrom(json entry)
{
  entry["preset"] = entry.at("name");
  entry["flags"] = flagsOf({});
  entry.erase("source_image");
  try
  {
    StructureAppearance preset = appearanceFrom(entry, {});
    if (entry.contains("values_of"))
    {
      const json& of = entry["values_of"];
      if (of != OwnPresets::kOfCt && of != OwnPresets::kOfMr)
        throw core::InvalidParameter("values_of is neither \"ct\" nor \"mr\"");
      preset.sourceImage = of.get<std::string>();
    }
    return preset;
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter("structure preset '" + entry["preset"].get<std::string>() +
                                 "': " + error.what());
  }
}

json presetJson(const StructureAppearance& preset)
{
  json entry = appearanceJson(preset);
  entry["name"] = preset.preset;
  for (const char* key : {"preset", "flags", "source_image"})
    entry.erase(key);
  if (!preset.sourceImage.empty())
    entry["values_of"] = preset.sourceImage;
  return entry;
}

StructurePresets StructurePresets::builtIn()
{
  static const StructurePresets kBuiltIn(kStructures); // long, and asked for again and again
  return kBuiltIn;
}

StructurePresets::StructurePresets(std::string_view text)
{
  try
  {
    const auto catalogue = json::parse(text);
    m_neutral = catalogue.value("neutral", std::vector<std::string>());
    m_sides = catalogue.value("sides", std::vector<std::string>());
    m_qualifiers = catalogue.value("qualifiers", std::vector<std::string>());
    const auto phrases = [](const json& entry)
    {
      Phrases result;
      addPhrases(result, entry.value("words", std::vector<std::string>()), false);
      addPhrases(result, entry.value("alone", std::vector<std::string>()), true);
      return result;
    };
    m_other = presetFrom(catalogue.at("other"));
    for (const auto& entry : catalogue.at("presets"))
    {
      m_words.push_back({phrases(entry), m_presets.size(), {}});
      m_presets.push_back(presetFrom(entry));
    }
    const auto indices = [this](const json& entry, const char* where)
    {
      std::vector<std::size_t> result;
      for (const std::string& name : entry.value("unless", std::vector<std::string>()))
        result.push_back(indexOf(name, where));
      return result;
    };
    if (const auto found = catalogue.find("nerve_names"); found != catalogue.end())
    {
      const json& entry = *found;
      const auto patterns = [&entry](const char* key)
      { return entry.value(key, std::vector<std::string>()); };
      NerveNames names;
      names.preset = indexOf(entry.at("preset").get<std::string>(), "nerve_names");
      names.unless = indices(entry, "nerve_names");
      names.nerve = patterns("nerve");
      names.facial = patterns("facial");
      names.notFacial = patterns("not_facial");
      names.number = patterns("number");
      names.course = patterns("course");
      names.place = patterns("place");
      names.isNot = patterns("not");
      names.isFacial = patterns("is_facial");
      names.facialCode = entry.value("facial_code", "");
      names.isChorda = patterns("is_chorda");
      m_nerveNames = std::move(names);
    }
    std::vector<Words> first;
    for (const auto& entry : catalogue.value("first", json::array()))
    {
      const auto index = indexOf(entry.at("preset").get<std::string>(), "first");
      first.push_back({phrases(entry), index, indices(entry, "first")});
    }
    m_words.insert(m_words.begin(), first.begin(), first.end());
    for (const auto& entry : catalogue.value("codes", json::array()))
    {
      StructureCode code;
      const std::string category = entry.value("category", "");
      if (category == "abnormal")
      {
        code.category = "49755003";
        code.categoryMeaning = "Morphologically Abnormal Structure";
      }
      else if (category == "tissue")
      {
        code.category = "85756007";
        code.categoryMeaning = "Tissue";
      }
      else if (!category.empty())
        throw core::InvalidParameter("structure presets: a code has no category '" + category +
                                     "'; there are abnormal and tissue");
      code.type = entry.at("code").get<std::string>();
      code.typeMeaning = entry.at("meaning").get<std::string>();
      m_codes.push_back({phrases(entry), entry.value("preset", ""), std::move(code)});
    }
  }
  catch (const json::exception& error)
  {
    throw core::InvalidParameter(std::string("structure presets: ") + error.what());
  }
}

const StructureAppearance* StructurePresets::find(const std::string& name) const
{
  const auto found = std::find_if(m_presets.begin(), m_presets.end(),
                                  [&name](const auto& look) { return look.preset == name; });
  return found != m_presets.end() ? &*found : name == m_other.preset ? &m_other : nullptr;
}

// "other" has the index after the last preset.
std::size_t StructurePresets::indexOf(const std::string& preset, const char* where) const
{
  const StructureAppearance* look = find(preset);
  if (!look)
    throw core::InvalidParameter(std::string("structure presets: '") + where +
                                 "' names no preset '" + preset + "'");
  return look == &m_other ? m_presets.size() : static_cast<std::size_t>(look - m_presets.data());
}

void StructurePresets::addPhrases(Phrases& phrases, const std::vector<std::string>& texts,
                                  bool isAlone)
{
  for (const std::string& text : texts)
    phrases.push_back({foldedWords(text), !text.empty() && text.back() == ' ', isAlone});
}

bool StructurePresets::isSide(const std::string& word) const
{
  return std::find(m_sides.begin(), m_sides.end(), word) != m_sides.end();
}

bool StructurePresets::isNeutral(const std::string& word) const
{
  return isShortNumber(word) || isSide(word) ||
         std::find(m_neutral.begin(), m_neutral.end(), word) != m_neutral.end();
}

bool StructurePresets::hasPhrase(const std::vector<std::string>& name, const Phrases& phrases) const
{
  const auto matches = [&](const Phrase& phrase, std::size_t at, std::size_t& length)
  {
    const auto isLast = [&phrase](const std::string& word, const std::string& stem)
    { return phrase.isWhole ? word == stem : isFormOf(word, stem); };
    length = phrase.words.size();
    if (length == 0)
      return false;
    if (at + length <= name.size() &&
        std::equal(phrase.words.begin(), phrase.words.end() - 1,
                   name.begin() + static_cast<std::ptrdiff_t>(at)) &&
        isLast(name[at + length - 1], phrase.words.back()))
      return true;
    std::string joined; // "facialnerve"
    for (const std::string& word : phrase.words)
      joined += word;
    const bool isJoined = length > 1 && isLast(name[at], joined);
    length = 1;
    return isJoined;
  };
  for (const Phrase& phrase : phrases)
    for (std::size_t at = 0; at < name.size(); ++at)
      if (std::size_t length = 0; matches(phrase, at, length))
      {
        bool isRight = true;
        for (std::size_t n = 0; phrase.isAlone && n < name.size(); ++n)
          isRight = isRight && ((n >= at && n < at + length) || name[n].size() == 1 || // "n."
                                isNeutral(name[n]));
        if (isRight)
          return true;
      }
  return false;
}

// What counts only alone counts too: "A. facialis mastoid" is no nerve.
bool StructurePresets::hasPhraseOf(const std::vector<std::string>& name,
                                   const std::vector<std::size_t>& presets) const
{
  for (const Words& entry : m_words)
    if (std::find(presets.begin(), presets.end(), entry.preset) != presets.end())
    {
      Phrases phrases = entry.phrases;
      for (Phrase& phrase : phrases)
        phrase.isAlone = false;
      if (hasPhrase(name, phrases))
        return true;
    }
  return false;
}

NerveKind StructurePresets::nerveOf(const std::string& structureName) const
{
  return nerveOfWords(foldedWords(structureName));
}

NerveKind StructurePresets::nerveOfWords(const std::vector<std::string>& name) const
{
  if (!m_nerveNames)
    return NerveKind::None;
  const NerveNames& names = *m_nerveNames;
  const auto hasNervePhrase = [&]
  {
    for (const Words& entry : m_words)
      if (entry.preset == names.preset && hasPhrase(name, entry.phrases))
        return true;
    return false;
  };
  const auto hasNumber = [&] // "VII mastoid", and not "segment VII"
  {
    return hasWordOf(name, names.number) && hasWordOf(name, names.course) &&
           std::all_of(name.begin(), name.end(),
                       [&](const std::string& word)
                       {
                         return isNeutral(word) || matchesOneOf(word, names.number) ||
                                matchesOneOf(word, names.course);
                       });
  };
  const bool isNerve = hasWordOf(name, names.nerve) || hasNumber() || hasNervePhrase() ||
                       (hasWordOf(name, names.facial) && !hasWordOf(name, names.notFacial));
  std::vector<std::string> rest = name; // without the places of what is called a nerve
  if (hasWordOf(name, names.nerve) || hasWordOf(name, names.isChorda))
    rest.erase(std::remove_if(rest.begin(), rest.end(),
                              [&](const std::string& word)
                              { return matchesOneOf(word, names.place); }),
               rest.end());
  if (!isNerve || hasWordOf(rest, names.place) || hasWordOf(rest, names.isNot) ||
      hasPhraseOf(rest, names.unless))
    return NerveKind::None;
  const auto isFacial = [&]
  {
    return hasWordOf(name, names.isFacial) ||
           std::any_of(m_codes.begin(), m_codes.end(),
                       [&](const Code& entry) {
                         return entry.code.type == names.facialCode &&
                                hasPhrase(name, entry.phrases);
                       });
  };
  return hasWordOf(name, names.isChorda) ? NerveKind::ChordaTympani
         : isFacial()                    ? NerveKind::Facial
                                         : NerveKind::Other;
}

const StructureAppearance* StructurePresets::lookByWord(const std::string& structureName) const
{
  const std::vector<std::string> name = foldedWords(structureName);
  if (nerveOfWords(name) != NerveKind::None)
    return &m_presets[m_nerveNames->preset];
  for (const Words& entry : m_words)
    if (hasPhrase(name, entry.phrases) && !hasPhraseOf(name, entry.unless))
      return entry.preset < m_presets.size() ? &m_presets[entry.preset] : &m_other;
  return nullptr;
}

StructureCode StructurePresets::codeFor(const std::string& structureName,
                                        const std::string& preset) const
{
  const std::vector<std::string> name = foldedWords(structureName);
  const auto found = std::find_if(m_codes.begin(), m_codes.end(),
                                  [&](const Code& entry) {
                                    return hasPhrase(name, entry.phrases) ||
                                           (!entry.preset.empty() && entry.preset == preset);
                                  });
  return found == m_codes.end() ? StructureCode() : found->code;
}

StructureAppearance StructurePresets::lookFor(const std::string& structureName) const
{
  const StructureAppearance* look = lookByWord(structureName);
  return look ? *look : m_other;
}

std::optional<StructureAppearance>
StructurePresets::lookForCodes(const volume::SegmentCodes& codes) const
{
  const auto ofConcept = [this](const volume::CodedConcept& concept) -> const StructureAppearance*
  {
    const auto known =
        std::find_if(m_codes.begin(), m_codes.end(),
                     [&concept](const Code& entry)
                     { return concept.scheme == "SCT" && entry.code.type == concept.value; });
    const StructureAppearance* look =
        known == m_codes.end() ? nullptr : lookByWord(known->code.typeMeaning);
    return look ? look : lookByWord(concept.meaning);
  };
  const bool isAbnormal = codes.category.value == "49755003" || codes.category.value == "M-01000";
  const StructureAppearance* look = ofConcept(codes.type);
  if (!look && !isAbnormal)
    look = lookByWord(codes.region.meaning + " " + codes.type.meaning);
  if (!look && !isAbnormal)
    look = ofConcept(codes.region);
  return look && look != &m_other ? std::optional(*look) : std::nullopt;
}

std::string StructurePresets::knownWords(const std::string& name) const
{
  const KnownWords known = knownIn(name);
  return known.hasStructure ? known.text : std::string();
}

std::string StructurePresets::knownWordsOfPart(const std::string& part) const
{
  return knownIn(part).text;
}

bool StructurePresets::isQualifier(const std::string& word) const
{
  return std::find(m_qualifiers.begin(), m_qualifiers.end(), folded(word)) != m_qualifiers.end();
}

StructurePresets::KnownWords StructurePresets::knownIn(const std::string& name) const
{
  // A catalogue word may be a stem ("cerebell" of "cerebellum"), followed by one of these endings
  // only, so that surnames do not match.
  const auto is = [](const std::string& word, const std::string& known)
  {
    static const char* const kEndings[] = {"s",   "es", "i",   "y",    "al",   "ar",     "ae",
                                           "um",  "le", "is",  "els",  "oma",  "ium",    "ule",
                                           "ine", "ic", "eus", "alis", "aris", "ularis", "ulare"};
    constexpr std::size_t kShortestStem = 4;
    if (word == known || known.size() < kShortestStem)
      return word == known;
    return word.compare(0, known.size(), known) == 0 &&
           std::any_of(std::begin(kEndings), std::end(kEndings),
                       [&](const char* end) { return word.substr(known.size()) == end; });
  };
  const std::vector<std::string> words = wordsOf(name);
  const auto isOtherSide = [this](const std::string& word)
  {
    const std::string plain = folded(word);
    return plain != kSideOrName && isSide(plain) && !isDoubtfulSide(plain);
  };
  const bool hasSide = std::any_of(words.begin(), words.end(), isOtherSide);
  KnownWords result;
  for (const std::string& word : words)
  {
    const std::string plain = folded(word);
    const bool isBeside =
        (isNeutral(plain) && !(plain == kSideOrName && hasSide)) || isQualifier(word);
    bool isOfStructure = false;
    for (const Words& entry : m_words)
      for (const Phrase& phrase : entry.phrases)
        for (const std::string& known : phrase.words)
          isOfStructure = isOfStructure || (known.size() > 1 && is(plain, known)); // no initial
    result.hasStructure = result.hasStructure || (isOfStructure && !isBeside);
    if (isBeside || isOfStructure)
      result.text += (result.text.empty() ? "" : " ") + word;
  }
  return result;
}

StructureAppearance StructurePresets::preset(const std::string& name) const
{
  const StructureAppearance* look = find(name);
  if (!look)
    look = lookByWord(name);
  if (look)
    return *look;
  std::string there;
  for (const StructureAppearance& preset : all())
    there += (there.empty() ? "" : ", ") + preset.preset;
  throw core::InvalidParameter("there is no preset '" + name + "'; there are " + there);
}

std::vector<StructureAppearance> StructurePresets::all() const
{
  std::vector<StructureAppearance> presets = m_presets;
  presets.push_back(m_other);
  return presets;
}

std::size_t letterBytes(const std::string& text)
{
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](unsigned char c) { return c >= 0x80 || std::isalnum(c) != 0; }));
}

StructureAppearance boneLook()
{
  return StructurePresets::builtIn().preset("bone");
}

StructureAppearance softTissueLook()
{
  // Each case has one, and the catalogue is long.
  static const StructureAppearance kLook = []
  {
    StructureAppearance look = StructurePresets::builtIn().preset("soft-tissue");
    look.shown = false;
    makeUntouchable(look);
    return look;
  }();
  return kLook;
}

void readPrimaryImage(StructureAppearance& softTissue)
{
  if (softTissue.sourceImage.empty())
    return;
  const StructureAppearance usual = softTissueLook();
  softTissue.sourceImage.clear();
  softTissue.preset = usual.preset;
  softTissue.color = usual.color;
  softTissue.transfer = usual.transfer;
  softTissue.relative = usual.relative;
}

} // namespace petrous::appearance
