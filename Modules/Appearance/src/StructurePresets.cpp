#include "petrous/Appearance/StructurePresets.h"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "Structures.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Core/Error.h"

namespace petrous::appearance
{

namespace
{

using nlohmann::json;

// An entry of the catalogue is what a manifest has, but for the flags, with the preset's name as
// "name".
StructureAppearance lookFrom(json entry)
{
  entry["preset"] = entry.at("name");
  entry["flags"] = flagsOf({});
  try
  {
    return appearanceFrom(entry, {});
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter("structure preset '" + entry["preset"].get<std::string>() +
                                 "': " + error.what());
  }
}

std::string plainWords(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) {
                   return c == '_' || c == '-' || c == '.' ? ' '
                                                           : static_cast<char>(std::tolower(c));
                 });
  return name;
}

// Whether a word of the name begins as one of these: "mastoid", not "sternocleidomastoid".
bool hasWord(const std::string& structureName, const std::vector<std::string>& words)
{
  const std::string name = " " + plainWords(structureName) + " ";
  return std::any_of(words.begin(), words.end(),
                     [&name](const std::string& word)
                     { return name.find(" " + word) != std::string::npos; });
}

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
      words.back() += c < 0x80 ? static_cast<char>(std::tolower(c)) : each;
    before = c;
  }
  if (words.back().empty())
    words.pop_back();
  return words;
}

} // namespace

StructurePresets StructurePresets::builtIn()
{
  return StructurePresets(kStructures);
}

StructurePresets::StructurePresets(std::string_view text)
{
  try
  {
    const auto catalogue = json::parse(text);
    m_other = lookFrom(catalogue.at("other"));
    for (const auto& entry : catalogue.at("presets"))
    {
      m_words.push_back({entry.at("words").get<std::vector<std::string>>(), m_presets.size()});
      m_presets.push_back(lookFrom(entry));
    }
    std::vector<Words> first;
    for (const auto& entry : catalogue.value("first", json::array()))
    {
      const auto name = entry.at("preset").get<std::string>();
      const StructureAppearance* look = find(name);
      if (!look)
        throw core::InvalidParameter("structure presets: 'first' names no preset '" + name + "'");
      // "other" has the index after the last preset.
      const auto index =
          look == &m_other ? m_presets.size() : static_cast<std::size_t>(look - m_presets.data());
      first.push_back({entry.at("words").get<std::vector<std::string>>(), index});
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
      m_codes.push_back({entry.value("words", std::vector<std::string>()),
                         entry.value("preset", ""), std::move(code)});
    }
    m_neutral = catalogue.value("neutral", std::vector<std::string>());
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

const StructureAppearance* StructurePresets::lookByWord(const std::string& structureName) const
{
  for (const Words& entry : m_words)
    if (hasWord(structureName, entry.words))
      return entry.preset < m_presets.size() ? &m_presets[entry.preset] : &m_other;
  return nullptr;
}

StructureCode StructurePresets::codeFor(const std::string& structureName,
                                        const std::string& preset) const
{
  const auto found = std::find_if(m_codes.begin(), m_codes.end(),
                                  [&](const Code& entry)
                                  {
                                    return hasWord(structureName, entry.words) ||
                                           (!entry.preset.empty() && entry.preset == preset);
                                  });
  return found == m_codes.end() ? StructureCode() : found->code;
}

StructureAppearance StructurePresets::lookFor(const std::string& structureName) const
{
  const StructureAppearance* look = lookByWord(structureName);
  return look ? *look : m_other;
}

std::string StructurePresets::knownWords(const std::string& name) const
{
  // A catalogue word may be a stem ("cerebell" of "cerebellum"), followed by one of these endings
  // only, so that surnames do not match.
  const auto is = [](const std::string& word, const std::string& known)
  {
    static const char* const kEndings[] = {"s",  "es", "i",   "y",   "al",  "ar",  "ae",  "um",
                                           "le", "is", "els", "oma", "ium", "ule", "ine", "ic"};
    constexpr std::size_t kShortestStem = 4;
    if (word == known || known.size() < kShortestStem)
      return word == known;
    return word.compare(0, known.size(), known) == 0 &&
           std::any_of(std::begin(kEndings), std::end(kEndings),
                       [&](const char* end) { return word.substr(known.size()) == end; });
  };
  std::string result;
  bool isStructure = false;
  for (const std::string& word : wordsOf(name))
  {
    const bool isNumber =
        word.size() <= 2 && std::isdigit(static_cast<unsigned char>(word[0])) != 0;
    const bool isNeutral =
        isNumber || std::find(m_neutral.begin(), m_neutral.end(), word) != m_neutral.end();
    bool isOfStructure = false;
    for (const Words& entry : m_words)
      for (const std::string& phrase : entry.words)
        for (const std::string& known : wordsOf(phrase))
          isOfStructure = isOfStructure || is(word, known);
    isStructure = isStructure || (isOfStructure && !isNeutral);
    if (isNeutral || isOfStructure)
      result += (result.empty() ? "" : " ") + word;
  }
  return isStructure ? result : std::string();
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

StructureAppearance boneLook()
{
  return StructurePresets::builtIn().preset("bone");
}

} // namespace petrous::appearance
