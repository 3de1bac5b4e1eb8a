#include "DicomElements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "FileHelpers.h"
#include "petrous/Imaging/DicomReader.h"

namespace petrous::imaging
{

namespace
{

constexpr std::string_view kDeflated = "1.2.840.10008.1.2.1.99"; // transfer syntax

constexpr std::uint32_t kMaxKept = 4096; // bytes; all values used here are far shorter
constexpr int kDeepest = 32;             // nested sequences; malicious files may nest endlessly

constexpr Tag kItem = 0xfffee000;
constexpr Tag kItemEnd = 0xfffee00d;
constexpr Tag kSequenceEnd = 0xfffee0dd;
constexpr Tag kTransferSyntax = 0x00020010;
constexpr Tag kModalityLut = 0x00283000;
constexpr Tag kSharedGroups = 0x52009229;
constexpr Tag kFrameGroups = 0x52009230;
constexpr std::size_t kMostFrames = 100000;

bool isUpper(unsigned char c)
{
  return c >= 'A' && c <= 'Z';
}

bool hasLongLength(const unsigned char* vr)
{
  const auto isOneOf = [second = static_cast<char>(vr[1])](std::string_view letters)
  { return letters.find(second) != std::string_view::npos; };
  return (vr[0] == 'O' && isOneOf("BDFLVW")) || (vr[0] == 'S' && isOneOf("QV")) ||
         (vr[0] == 'U' && isOneOf("CNRTV"));
}

bool isWanted(Tag tag)
{
  // Identification, equipment, relationship, image pixel: the groups of the values used here. Of
  // the patient group only what distinguishes patients.
  const Tag group = tag >> 16;
  if (group == 0x0010)
    return tag == 0x00100010 || tag == 0x00100020 || tag == 0x00100021 || tag == 0x00100030;
  constexpr Tag kSiemensB = 0x0019100c;
  constexpr Tag kGeB = 0x00431039;
  constexpr Tag kRealIntercept = 0x00409224;
  constexpr Tag kRealSlope = 0x00409225;
  constexpr Tag kOverlayBits = 0x60000100;     // allocated, of the first of 16 groups
  constexpr Tag kOverlayPosition = 0x60000102; // of its bit
  constexpr Tag kOverlay = 0xffe1ffff;         // all but the number of the group
  return tag == kSiemensB || tag == kGeB || tag == kRealIntercept || tag == kRealSlope ||
         (tag & kOverlay) == kOverlayBits || (tag & kOverlay) == kOverlayPosition ||
         group == 0x0002 || group == 0x0008 || group == 0x0018 || group == 0x0020 ||
         group == 0x0028;
}

/// The functional groups whose values are used here; a private group may hold a whole other header.
bool isGroup(Tag tag)
{
  static constexpr Tag kGroups[] = {
      0x00209113,        0x00209116, 0x00289110,
      0x00289145,        0x00209111, // place, values, frame content
      0x00189117,        0x00189076, 0x00189114,
      0x00189112,        0x00189118, // diffusion, echo, timing, heart
      0x00189226,        0x00189329, 0x00189314,
      0x00189325,        0x00209310, 0x00189301, // type, kernel, tube, time, helix
      kRealWorldMapping, 0x004008ea};            // real world values, their unit
  return std::find(std::begin(kGroups), std::end(kGroups), tag) != std::end(kGroups);
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
  if (m_syntax == kDeflated && !m_source.inflateFrom(offset))
    return;
  readDataSet(offset);
}

bool canBeInflated(const std::filesystem::path& file)
{
  ByteSource source(file);
  std::array<char, 4096> head{}; // beyond any group 2
  if (!source.isOpen() ||
      !source.read(0, head.data(),
                   static_cast<std::size_t>(std::min<std::uint64_t>(head.size(), source.size()))))
    return true; // whoever reads it will say so
  if (std::string_view(head.data(), head.size()).find(kDeflated) == std::string_view::npos)
    return true;
  return DicomElements(source).state() != DicomElements::State::Damaged;
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
  element.isWords = false;
  element.value = offset + 8;
  if (!explicitVr || (element.tag >> 16) == 0xfffe)
  {
    element.length = number32(head.data() + 4);
    return true;
  }
  if (!isUpper(head[4]) || !isUpper(head[5]))
    return false;
  element.isUnknown = head[4] == 'U' && head[5] == 'N';
  element.isWords = head[4] == 'O' && head[5] == 'W';
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

void DicomElements::set(Values& values, Tag tag, std::string value)
{
  if (values.empty() || values.back().first < tag) // files state them in this order
  {
    values.emplace_back(tag, std::move(value));
    return;
  }
  const auto at = std::lower_bound(values.begin(), values.end(), tag,
                                   [](const auto& one, Tag wanted) { return one.first < wanted; });
  if (at->first == tag)
    at->second = std::move(value);
  else
    values.emplace(at, tag, std::move(value));
}

const std::string* DicomElements::find(const Values& values, Tag tag)
{
  const auto at = std::lower_bound(values.begin(), values.end(), tag,
                                   [](const auto& one, Tag wanted) { return one.first < wanted; });
  return at == values.end() || at->first != tag ? nullptr : &at->second;
}

bool DicomElements::keep(const Element& element, Values& values)
{
  if (element.length > m_source.size() || element.value > m_source.size() - element.length)
    return false;
  if (!isWanted(element.tag) || element.length > kMaxKept || element.length == 0)
    return true;
  std::string value(element.length, '\0');
  if (!m_source.readNear(element.value, value.data(), value.size()))
    return false;
  set(values, element.tag, std::move(value));
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
    if (!readElement(offset, element, isUpper(head[4]) && isUpper(head[5])) ||
        !keep(element, m_values))
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
  constexpr std::size_t kUsual = 96; // elements of a slice that are kept
  m_values.reserve(kUsual);
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
      m_pixels.tag = element.tag;
      m_pixels.offset = element.value;
      m_pixels.length = element.length;
      m_pixels.isWords = element.isWords;
      break;
    }
    if (element.tag > kPixelData)
      break;
    if (element.tag == kExtendedOffsets && element.length != kUndefinedLength)
    {
      m_pixels.offsetTable = element.value;
      m_pixels.offsetCount = element.length / 8;
    }
    offset = element.value;
    const bool isGroups = element.tag == kSharedGroups || element.tag == kFrameGroups;
    if (element.length == kUndefinedLength && !isGroups)
    {
      if (!skipItems(offset, m_explicit && !element.isUnknown, 0))
        return;
      if (element.tag == kModalityLut)
        m_hasModalityLut = offset > element.value + 8; // more than the delimiter
      continue;
    }
    if (element.tag == kModalityLut)
      m_hasModalityLut = element.length >= 8;
    if (isGroups)
    {
      if (!readGroups(element, offset, m_explicit && !element.isUnknown, 0,
                      element.tag == kSharedGroups ? m_shared : m_frames))
        return;
      continue;
    }
    if (!keep(element, m_values))
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

/// The items of a functional group, each flattened. Where a value occurs in several (real world
/// value mappings), it is that of the first.
bool DicomElements::readGroups(const Element& sequence, std::uint64_t& offset, bool explicitVr,
                               int depth, std::vector<Values>& items)
{
  const bool isOpen = sequence.length == kUndefinedLength;
  const std::uint64_t end = isOpen ? m_source.size() : offset + sequence.length;
  if (end > m_source.size() || depth >= kDeepest)
    return false;
  Element item;
  while (offset < end)
  {
    if (!readElement(offset, item, explicitVr))
      return false;
    offset = item.value;
    if (item.tag == kSequenceEnd && isOpen)
      return true;
    const std::uint64_t itemEnd =
        item.length == kUndefinedLength ? end : std::min(end, offset + item.length);
    if (item.tag != kItem || items.size() >= kMostFrames)
      return false;
    items.emplace_back();
    if (!readGroupItem(offset, itemEnd, explicitVr, depth, items.back()))
      return false;
  }
  return !isOpen;
}

bool DicomElements::readGroupItem(std::uint64_t& offset, std::uint64_t end, bool explicitVr,
                                  int depth, Values& values)
{
  Element element;
  while (offset < end)
  {
    if (!readElement(offset, element, explicitVr))
      return false;
    offset = element.value;
    if (element.tag == kItemEnd)
      return true;
    if (isGroup(element.tag))
    {
      std::vector<Values> items;
      if (!readGroups(element, offset, explicitVr && !element.isUnknown, depth + 1, items))
        return false;
      for (Values& item : items)
        for (auto& [tag, value] : item)
          if (!find(values, tag))
            set(values, tag, std::move(value));
      if (element.tag == kRealWorldMapping)
        set(values, element.tag, std::to_string(items.size()));
    }
    else if (element.length == kUndefinedLength)
    {
      if (!skipItems(offset, explicitVr && !element.isUnknown, depth))
        return false;
    }
    else
    {
      if (!keep(element, values))
        return false;
      offset += element.length;
    }
  }
  return offset == end;
}

const std::string* DicomElements::find(Tag tag) const
{
  if (m_frame < m_frames.size())
  {
    if (const std::string* value = find(m_frames[m_frame], tag))
      return value;
    if (const std::string* value = m_shared.empty() ? nullptr : find(m_shared.front(), tag))
      return value;
  }
  return find(m_values, tag);
}

namespace
{

std::string_view withoutSpaces(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// Without padding and control characters.
std::string textOf(const std::string& value)
{
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  std::string result = value;
  result.erase(std::remove_if(result.begin(), result.end(), isControl), result.end());
  const std::string_view text = withoutSpaces(result);
  return text.size() == result.size() ? result : std::string(text);
}

/// The values of a text, which backslashes divide: views of it.
std::vector<std::string_view> wordsOf(std::string_view rest)
{
  std::vector<std::string_view> result;
  while (!rest.empty())
  {
    const std::size_t end = std::min(rest.find('\\'), rest.size());
    result.push_back(withoutSpaces(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return result;
}

/// Decimal strings; empty if one is malformed.
std::vector<double> numbersOf(const std::vector<std::string_view>& parts)
{
  std::vector<double> result;
  result.reserve(parts.size());
  for (const std::string_view part : parts)
    if (const auto value = parseDouble(part))
      result.push_back(*value);
    else
      return {};
  return result;
}

} // namespace

bool contradict(const std::string& ofFrame, const std::string& ofAll)
{
  if (ofFrame.empty() || ofAll.empty() || ofFrame == ofAll)
    return false;
  const std::vector<double> numbers = numbersOf(wordsOf(ofFrame));
  return numbers.empty() || numbers != numbersOf(wordsOf(ofAll));
}

bool DicomElements::contradictsShared(Tag tag) const
{
  if (m_frame >= m_frames.size() || m_shared.empty())
    return false;
  const std::string* shared = find(m_shared.front(), tag);
  const std::string* own = find(m_frames[m_frame], tag);
  return shared && own && contradict(textOf(*own), textOf(*shared));
}

std::string DicomElements::bytes(Tag tag) const
{
  const std::string* value = find(tag);
  return value ? *value : std::string();
}

std::string DicomElements::text(Tag tag) const
{
  const std::string* found = find(tag);
  return found ? textOf(*found) : std::string();
}

std::vector<std::string> DicomElements::words(Tag tag) const
{
  const std::string all = text(tag);
  const std::vector<std::string_view> parts = wordsOf(all);
  return {parts.begin(), parts.end()};
}

std::vector<double> DicomElements::numbers(Tag tag, std::size_t count) const
{
  const std::string all = text(tag);
  const std::vector<std::string_view> parts = wordsOf(all);
  return parts.size() == count ? numbersOf(parts) : std::vector<double>();
}

std::optional<double> DicomElements::number(Tag tag) const
{
  const std::vector<double> values = numbers(tag, 1); // several are none
  return values.empty() ? std::nullopt : std::optional<double>(values.front());
}

std::optional<double> DicomElements::real(Tag tag) const
{
  std::string raw = bytes(tag);
  if (m_bigEndian)
    std::reverse(raw.begin(), raw.end());
  double value = 0.0;
  float single = 0.0F;
  if (raw.size() == sizeof value)
    std::memcpy(&value, raw.data(), sizeof value);
  else if (raw.size() == sizeof single)
  {
    std::memcpy(&single, raw.data(), sizeof single);
    value = static_cast<double>(single);
  }
  else
    return std::nullopt;
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<int> DicomElements::integer(Tag tag, bool isSigned) const
{
  const std::string* found = find(tag);
  std::array<unsigned char, 4> raw{};
  if (!found || (found->size() != 2 && found->size() != 4))
    return std::nullopt;
  std::memcpy(raw.data(), found->data(), found->size());
  if (found->size() == 4)
    return static_cast<int>(number32(raw.data()));
  const std::uint16_t value = number16(raw.data());
  return isSigned ? static_cast<std::int16_t>(value) : static_cast<int>(value);
}

} // namespace petrous::imaging
