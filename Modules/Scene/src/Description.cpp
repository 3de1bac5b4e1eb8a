#include "petrous/Scene/Description.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <tuple>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::scene
{

namespace
{

constexpr std::array<const char*, 4> kSides{"unknown", "left", "right", "both"};

void checkText(const std::string& text, const std::string& field, std::size_t longest,
               std::string_view allowed = {})
{
  if (text.size() > longest)
    throw core::InvalidParameter(field + ": must have at most " + std::to_string(longest) +
                                 " bytes, not " + std::to_string(text.size()));
  if (!core::isUtf8(text))
    throw core::InvalidParameter(field + ": is not UTF-8; type it anew");
  if (hasControls(text, allowed))
    throw core::InvalidParameter(field + ": must have no control characters" +
                                 (allowed.empty() ? ", and be one line" : ""));
}

void checkLine(const std::string& text, const std::string& field, std::size_t longest)
{
  checkText(text, field, longest);
  if (hasInvisible(text))
    throw core::InvalidParameter(field + ": must have no characters that are not seen (zero-width "
                                         "spaces, marks of direction); type it anew");
  if (!text.empty() && (text.front() == ' ' || text.back() == ' '))
    throw core::InvalidParameter(field + ": must not begin or end with a space");
}

} // namespace

bool Description::empty() const
{
  return *this == Description{};
}

bool operator==(const Description& a, const Description& b)
{
  const auto all = [](const Description& d)
  { return std::tie(d.note, d.tags, d.diagnosis, d.procedure, d.side, d.date); };
  return all(a) == all(b);
}

void checkDescription(const Description& description)
{
  checkText(description.note, "note", Description::kLongestNote, "\t\n");
  checkLine(description.diagnosis, "diagnosis", Description::kLongestLine);
  checkLine(description.procedure, "procedure", Description::kLongestLine);
  if (description.tags.size() > Description::kMaxTags)
    throw core::InvalidParameter("tags: a case has at most " +
                                 std::to_string(Description::kMaxTags) + ", not " +
                                 std::to_string(description.tags.size()));
  std::set<std::string> seen;
  for (const std::string& tag : description.tags)
  {
    if (tag.empty())
      throw core::InvalidParameter("tag: must not be empty");
    checkLine(tag, "tag", Description::kLongestTag);
    if (!seen.insert(lowerCase(tag)).second)
      throw core::InvalidParameter("tags: one is there twice");
  }
  if (!description.date.empty() && !isDate(description.date))
    throw core::InvalidParameter("date: must be a day as YYYY-MM-DD, e.g. 2026-03-31");
}

const char* nameOf(Side side) noexcept
{
  return kSides[static_cast<std::size_t>(side)];
}

Side sideFromName(const std::string& name)
{
  const auto* const found = std::find(kSides.begin(), kSides.end(), name);
  if (found == kSides.end())
    throw core::InvalidParameter("side: must be left, right, both or unknown");
  return static_cast<Side>(std::distance(kSides.begin(), found));
}

bool isDate(const std::string& text) noexcept
{
  constexpr std::string_view kForm = "dddd-dd-dd";
  if (text.size() != kForm.size())
    return false;
  for (std::size_t n = 0; n < kForm.size(); ++n)
    if (kForm[n] == 'd' ? text[n] < '0' || text[n] > '9' : text[n] != kForm[n])
      return false;
  const auto number = [&text](std::size_t from, std::size_t count)
  {
    int value = 0;
    for (std::size_t n = from; n < from + count; ++n)
      value = 10 * value + (text[n] - '0');
    return value;
  };
  const int year = number(0, 4);
  const int month = number(5, 2);
  const int day = number(8, 2);
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (year < 1900 || year > 2999 || month < 1 || month > 12 || day < 1)
    return false;
  const bool isLeap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return day <= kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && isLeap ? 1 : 0);
}

std::string lowerCase(std::string text)
{
  bool isLatin = false; // the second byte of U+00C0 to U+00FF
  for (char& c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
    else if (isLatin && byte >= 0x80 && byte <= 0x9e && byte != 0x97) // not the sign of times
      c = static_cast<char>(byte + 0x20);
    isLatin = byte == 0xc3;
  }
  return text;
}

} // namespace petrous::scene
