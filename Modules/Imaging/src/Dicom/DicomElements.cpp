#include "DicomElements.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace petrous::imaging
{

namespace
{

constexpr std::uint32_t kMaxKept = 4096; // bytes; all values used here are far shorter
constexpr int kDeepest = 32;             // nested sequences; malicious files may nest endlessly

constexpr Tag kItem = 0xfffee000;
constexpr Tag kItemEnd = 0xfffee00d;
constexpr Tag kSequenceEnd = 0xfffee0dd;
constexpr Tag kTransferSyntax = 0x00020010;
constexpr Tag kModalityLut = 0x00283000;

bool isUpper(unsigned char c)
{
  return c >= 'A' && c <= 'Z';
}

bool hasLongLength(const unsigned char* vr)
{
  static const char* const kLong[] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                      "SV", "UC", "UN", "UR", "UT", "UV"};
  return std::any_of(std::begin(kLong), std::end(kLong),
                     [vr](const char* name) { return std::memcmp(vr, name, 2) == 0; });
}

bool isWanted(Tag tag)
{
  // Identification, equipment, relationship, image pixel: the groups of the values used here. Of
  // the patient group only what distinguishes patients.
  const Tag group = tag >> 16;
  if (group == 0x0010)
    return tag == 0x00100010 || tag == 0x00100020 || tag == 0x00100030;
  return group == 0x0002 || group == 0x0008 || group == 0x0018 || group == 0x0020 ||
         group == 0x0028;
}

} // namespace

DicomElements::DicomElements(ByteSource& source)
  : m_source(source)
{
  std::uint64_t offset = 0;
  if (!findStart(offset))
    return;
  m_state = State::Damaged;
  if (!readMeta(offset))
    return;
  if (m_syntax == "1.2.840.10008.1.2.1.99" && !m_source.inflateFrom(offset))
    return;
  readDataSet(offset);
}

/// After the preamble's DICM prefix; or, for files from before 1993 and careless exports, at the
/// start if it holds a first tag of group 2 or 8 with a plausible length.
bool DicomElements::findStart(std::uint64_t& offset)
{
  std::array<unsigned char, 4> marker{};
  if (m_source.readNear(128, marker.data(), 4) && std::memcmp(marker.data(), "DICM", 4) == 0)
  {
    offset = 132;
    return true;
  }
  std::array<unsigned char, 8> head{};
  if (!m_source.readNear(0, head.data(), head.size()))
    return false;
  m_bigEndian = head[0] == 0 && head[1] == 8;
  const Tag group = number16(head.data());
  const Tag element = number16(head.data() + 2);
  const bool namesVr = isUpper(head[4]) && isUpper(head[5]);
  return (group == 2 || group == 8) && element <= 0x0018 &&
         (namesVr || number32(head.data() + 4) < 256);
}

std::uint16_t DicomElements::number16(const unsigned char* bytes) const
{
  return static_cast<std::uint16_t>(m_bigEndian ? (bytes[0] << 8) | bytes[1]
                                                : bytes[0] | (bytes[1] << 8));
}

std::uint32_t DicomElements::number32(const unsigned char* bytes) const
{
  const std::uint32_t first = number16(bytes);
  const std::uint32_t second = number16(bytes + 2);
  return m_bigEndian ? (first << 16) | second : first | (second << 16);
}

bool DicomElements::readElement(std::uint64_t offset, Element& element, bool explicitVr)
{
  std::array<unsigned char, 12> head{};
  if (!m_source.readNear(offset, head.data(), 8))
    return false;
  element.tag = (static_cast<Tag>(number16(head.data())) << 16) | number16(head.data() + 2);
  element.isUnknown = false;
  element.value = offset + 8;
  if (!explicitVr || (element.tag >> 16) == 0xfffe)
  {
    element.length = number32(head.data() + 4);
    return true;
  }
  if (!isUpper(head[4]) || !isUpper(head[5]))
    return false;
  element.isUnknown = head[4] == 'U' && head[5] == 'N';
  if (!hasLongLength(head.data() + 4))
  {
    element.length = number16(head.data() + 6);
    return true;
  }
  if (!m_source.readNear(offset + 8, head.data() + 8, 4))
    return false;
  element.length = number32(head.data() + 8);
  element.value = offset + 12;
  return true;
}

bool DicomElements::keep(const Element& element)
{
  if (element.length > m_source.size() || element.value > m_source.size() - element.length)
    return false;
  if (!isWanted(element.tag) || element.length > kMaxKept || element.length == 0)
    return true;
  std::string value(element.length, '\0');
  if (!m_source.readNear(element.value, value.data(), value.size()))
    return false;
  m_values[element.tag] = std::move(value);
  return true;
}

/// Group 2, always explicit little endian.
bool DicomElements::readMeta(std::uint64_t& offset)
{
  const bool bigEndian = m_bigEndian;
  m_bigEndian = false;
  Element element;
  while (true)
  {
    std::array<unsigned char, 8> head{};
    if (!m_source.readNear(offset, head.data(), head.size()) || number16(head.data()) != 2)
      break;
    // Some writers omit the VR here too.
    if (!readElement(offset, element, isUpper(head[4]) && isUpper(head[5])) || !keep(element))
      return false;
    offset = element.value + element.length;
  }
  m_syntax = text(kTransferSyntax);
  m_bigEndian = m_syntax.empty() ? bigEndian : m_syntax == "1.2.840.10008.1.2.2";
  return true;
}

void DicomElements::readDataSet(std::uint64_t offset)
{
  // The encoding of the first element takes precedence over the declared transfer syntax.
  std::array<unsigned char, 8> head{};
  if (!m_source.readNear(offset, head.data(), head.size()))
    return;
  m_explicit = isUpper(head[4]) && isUpper(head[5]);
  m_dataStart = offset;
  if (m_syntax.empty())
    m_syntax = m_bigEndian  ? "1.2.840.10008.1.2.2"
               : m_explicit ? "1.2.840.10008.1.2.1"
                            : "1.2.840.10008.1.2";

  Element element;
  while (offset < m_source.size())
  {
    if (!readElement(offset, element, m_explicit))
      return;
    ++m_count;
    if (element.tag == kPixelData || element.tag == kFloatPixelData ||
        element.tag == kDoublePixelData)
    {
      m_pixels = {element.tag, element.value, element.length};
      break;
    }
    if (element.tag > kPixelData)
      break;
    offset = element.value;
    if (element.length == kUndefinedLength)
    {
      if (!skipItems(offset, m_explicit && !element.isUnknown, 0))
        return;
      if (element.tag == kModalityLut)
        m_hasModalityLut = offset > element.value + 8; // more than the delimiter
      continue;
    }
    if (element.tag == kModalityLut)
      m_hasModalityLut = element.length >= 8;
    if (!keep(element))
      return;
    offset += element.length;
  }
  m_state = State::Complete;
}

/// From the first item of a sequence of undefined length to after its delimiter.
bool DicomElements::skipItems(std::uint64_t& offset, bool explicitVr, int depth)
{
  Element item;
  while (depth < kDeepest && readElement(offset, item, explicitVr))
  {
    offset = item.value;
    if (item.tag == kSequenceEnd)
      return true;
    if (item.tag != kItem)
      return false;
    if (item.length == kUndefinedLength)
    {
      if (!skipItemContent(offset, explicitVr, depth))
        return false;
    }
    else
      offset += item.length;
  }
  return false;
}

bool DicomElements::skipItemContent(std::uint64_t& offset, bool explicitVr, int depth)
{
  Element element;
  while (readElement(offset, element, explicitVr))
  {
    offset = element.value;
    if (element.tag == kItemEnd)
      return true;
    if (element.length == kUndefinedLength)
    {
      if (!skipItems(offset, explicitVr && !element.isUnknown, depth + 1))
        return false;
    }
    else
      offset += element.length;
  }
  return false;
}

std::string DicomElements::text(Tag tag) const
{
  const auto found = m_values.find(tag);
  std::string result;
  if (found == m_values.end())
    return result;
  for (const char c : found->second)
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)
      result += c;
  result.erase(result.find_last_not_of(' ') + 1);
  result.erase(0, result.find_first_not_of(' '));
  return result;
}

std::vector<std::string> DicomElements::words(Tag tag) const
{
  std::vector<std::string> result;
  std::string rest = text(tag);
  while (!rest.empty())
  {
    const std::size_t end = std::min(rest.find('\\'), rest.size());
    std::string word = rest.substr(0, end);
    word.erase(word.find_last_not_of(' ') + 1);
    word.erase(0, word.find_first_not_of(' '));
    result.push_back(std::move(word));
    rest.erase(0, end + 1);
  }
  return result;
}

std::vector<double> DicomElements::numbers(Tag tag, std::size_t count) const
{
  const std::vector<std::string> parts = words(tag);
  if (parts.size() != count)
    return {};
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const char* first = parts[i].data();
    const char* last = first + parts[i].size();
    if (first != last && *first == '+')
      ++first;
    const auto end = std::from_chars(first, last, result[i]); // unlike strtod, locale-independent
    if (end.ec != std::errc() || end.ptr != last || !std::isfinite(result[i]))
      return {};
  }
  return result;
}

std::optional<double> DicomElements::number(Tag tag) const
{
  const std::vector<double> one = numbers(tag, 1);
  return one.empty() ? std::nullopt : std::optional<double>(one.front());
}

std::optional<int> DicomElements::integer(Tag tag, bool isSigned) const
{
  const auto found = m_values.find(tag);
  if (found == m_values.end() || found->second.size() != 2)
    return std::nullopt;
  std::array<unsigned char, 2> bytes{};
  std::memcpy(bytes.data(), found->second.data(), bytes.size());
  const std::uint16_t value = number16(bytes.data());
  return isSigned ? static_cast<std::int16_t>(value) : static_cast<int>(value);
}

} // namespace petrous::imaging
