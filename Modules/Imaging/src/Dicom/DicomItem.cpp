#include "DicomItem.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

constexpr Tag kItem = 0xfffee000;
constexpr Tag kItemEnd = 0xfffee00d;
constexpr Tag kSequenceEnd = 0xfffee0dd;
constexpr int kDeepest = 32; // nested sequences; malicious files may nest endlessly

std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count, bool isBigEndian)
{
  std::uint32_t value = 0;
  for (std::size_t b = 0; b < count; ++b)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + b]))
             << 8 * (isBigEndian ? count - 1 - b : b);
  return value;
}

/// That of the items of a sequence without a known VR is implicit VR little endian (PS3.5 6.2.2).
DicomItem::Encoding within(DicomItem::Encoding encoding, bool isUnknown)
{
  return isUnknown ? DicomItem::Encoding{false, false} : encoding;
}

struct Head
{
  Tag tag = 0;
  std::uint32_t length = 0;
  std::size_t value = 0; ///< position
  bool isUnknown = false;
};

bool readHead(std::string_view bytes, std::size_t at, DicomItem::Encoding encoding, Head& head)
{
  if (at > bytes.size() || bytes.size() - at < 8)
    return false;
  const bool big = encoding.isBigEndian;
  head.tag = (number(bytes, at, 2, big) << 16) | number(bytes, at + 2, 2, big);
  head.isUnknown = false;
  head.value = at + 8;
  if (!encoding.isExplicit || (head.tag >> 16) == 0xfffe)
  {
    head.length = number(bytes, at + 4, 4, big);
    return true;
  }
  const std::string_view vr = bytes.substr(at + 4, 2);
  if (vr[0] < 'A' || vr[0] > 'Z' || vr[1] < 'A' || vr[1] > 'Z')
    return false;
  head.isUnknown = vr == "UN";
  static constexpr std::string_view kLong[] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                               "SV", "UC", "UN", "UR", "UT", "UV"};
  if (std::find(std::begin(kLong), std::end(kLong), vr) == std::end(kLong))
  {
    head.length = number(bytes, at + 6, 2, big);
    return true;
  }
  if (bytes.size() - at < 12)
    return false;
  head.length = number(bytes, at + 8, 4, big);
  head.value = at + 12;
  return true;
}

/// Moves `at` from the first content of a sequence or item of undefined length to after its
/// delimiter; `end` becomes the position of the delimiter.
bool skipUndefined(std::string_view bytes, std::size_t& at, std::size_t& end,
                   DicomItem::Encoding encoding, Tag delimiter, int depth)
{
  Head head;
  while (depth < kDeepest && readHead(bytes, at, encoding, head))
  {
    end = at;
    at = head.value;
    if (head.tag == delimiter)
      return true;
    if (head.length != DicomElements::kUndefinedLength)
    {
      if (head.length > bytes.size() - at)
        return false;
      at += head.length;
      continue;
    }
    std::size_t inner = 0;
    if (!skipUndefined(bytes, at, inner, within(encoding, head.isUnknown),
                       head.tag == kItem ? kItemEnd : kSequenceEnd, depth + 1))
      return false;
  }
  return false;
}

/// The value of an element; `at` moves after it.
bool takeValue(std::string_view bytes, std::size_t& at, const Head& head,
               DicomItem::Encoding encoding, std::string_view& value)
{
  at = head.value;
  if (head.length != DicomElements::kUndefinedLength)
  {
    if (head.length > bytes.size() - at)
      return false;
    value = bytes.substr(at, head.length);
    at += head.length;
    return true;
  }
  std::size_t end = at;
  if (!skipUndefined(bytes, at, end, within(encoding, head.isUnknown),
                     head.tag == kItem ? kItemEnd : kSequenceEnd, 0))
    return false;
  value = bytes.substr(head.value, end - head.value);
  return true;
}

/// Lead bytes with as many continuation bytes as they announce (RFC 3629, without surrogates).
bool isUtf8(const std::string& text)
{
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const auto lead = static_cast<unsigned char>(text[at]);
    const std::size_t more = lead < 0x80                   ? 0
                             : lead >= 0xC2 && lead < 0xE0 ? 1
                             : lead >= 0xE0 && lead < 0xF0 ? 2
                             : lead >= 0xF0 && lead < 0xF5 ? 3
                                                           : text.size();
    if (more >= text.size() - at)
      return false;
    std::uint32_t code = more == 0 ? lead : lead & (0x3FU >> more);
    for (std::size_t n = 1; n <= more; ++n)
    {
      const auto next = static_cast<unsigned char>(text[at + n]);
      if ((next & 0xC0) != 0x80)
        return false;
      code = (code << 6) | (next & 0x3FU);
    }
    if ((more == 2 && (code < 0x800 || (code >= 0xD800 && code < 0xE000))) ||
        (more == 3 && (code < 0x10000 || code > 0x10FFFF)))
      return false;
    at += more;
  }
  return true;
}

} // namespace

DicomItem::DicomItem(std::string_view bytes, Encoding encoding)
  : m_bytes(bytes)
{
  std::size_t at = 0;
  Head head;
  while (at < bytes.size())
  {
    Element element;
    if (!readHead(bytes, at, encoding, head) || head.tag == kItemEnd ||
        !takeValue(bytes, at, head, encoding, element.value))
    {
      m_isDamaged = true;
      break;
    }
    element.tag = head.tag;
    element.items = within(encoding, head.isUnknown);
    element.isBigEndian = encoding.isBigEndian;
    m_elements.push_back(element);
  }
  std::stable_sort(m_elements.begin(), m_elements.end(),
                   [](const Element& a, const Element& b) { return a.tag < b.tag; });
}

const DicomItem::Element* DicomItem::find(Tag tag) const noexcept
{
  const auto at =
      std::lower_bound(m_elements.begin(), m_elements.end(), tag,
                       [](const Element& element, Tag wanted) { return element.tag < wanted; });
  return at == m_elements.end() || at->tag != tag ? nullptr : &*at;
}

std::string DicomItem::text(Tag tag) const
{
  const Element* element = find(tag);
  std::string result;
  if (!element)
    return result;
  for (const char c : element->value)
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)
      result += c;
  return std::string(trimmed(result));
}

std::vector<double> DicomItem::numbers(Tag tag) const
{
  const Element* element = find(tag);
  std::vector<double> result;
  if (!element)
    return result;
  std::string_view rest = element->value;
  while (!rest.empty() && (rest.back() == '\0' || rest.back() == ' '))
    rest.remove_suffix(1);
  while (!rest.empty())
  {
    const std::size_t end = std::min(rest.find('\\'), rest.size());
    std::string_view word = trimmed(rest.substr(0, end));
    if (!word.empty() && word.front() == '+')
      word.remove_prefix(1);
    const auto value = parseDouble(word);
    if (!value)
      return {};
    result.push_back(*value);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return result;
}

std::optional<double> DicomItem::number(Tag tag) const
{
  const auto all = numbers(tag);
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

std::vector<int> DicomItem::shorts(Tag tag) const
{
  std::vector<int> result;
  if (const Element* element = find(tag))
    for (std::size_t at = 0; at + 2 <= element->value.size(); at += 2)
      result.push_back(
          static_cast<int>(imaging::number(element->value, at, 2, element->isBigEndian)));
  return result;
}

std::optional<int> DicomItem::integer(Tag tag) const
{
  const auto all = shorts(tag);
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

std::optional<std::uint32_t> DicomItem::whole(Tag tag) const
{
  const Element* element = find(tag);
  return element && element->value.size() == 4
             ? std::optional(imaging::number(element->value, 0, 4, element->isBigEndian))
             : std::nullopt;
}

std::vector<DicomItem> DicomItem::items(Tag tag) const
{
  std::vector<DicomItem> result;
  const Element* element = find(tag);
  std::size_t at = 0;
  Head head;
  std::string_view value;
  while (element && readHead(element->value, at, element->items, head) && head.tag == kItem &&
         takeValue(element->value, at, head, element->items, value))
    result.emplace_back(value, element->items);
  if (element && at < element->value.size())
    result.emplace_back().m_isDamaged = true;
  return result;
}

DicomItem DicomItem::item(Tag tag) const
{
  auto all = items(tag);
  return all.empty() ? DicomItem() : std::move(all.front());
}

std::string toUtf8(const std::string& text, const std::string& characterSet)
{
  if (characterSet == "ISO_IR 192" && isUtf8(text))
    return text;
  const bool latin1 = characterSet.find("100") != std::string::npos;
  std::string result;
  for (const char c : text)
  {
    const auto letter = static_cast<unsigned char>(c);
    if (letter < 0x80)
      result += c;
    else if (latin1)
    {
      result += static_cast<char>(0xC0 | (letter >> 6));
      result += static_cast<char>(0x80 | (letter & 0x3F));
    }
    else
      result += '?';
  }
  return result;
}

} // namespace petrous::imaging
