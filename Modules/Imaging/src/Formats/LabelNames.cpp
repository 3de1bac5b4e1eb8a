#include "LabelNames.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <system_error>

#include "FileHelpers.h"
#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/FileFormats.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kMaxSegments = 65535;

std::array<float, 3> colorOf(const std::string* text)
{
  std::array<float, 3> color{};
  std::string_view rest = text ? std::string_view(*text) : std::string_view();
  for (float& channel : color)
    channel = std::clamp(parseFloat(takeWord(rest)).value_or(0.0F), 0.0F, 1.0F);
  return color;
}

/// Bounding boxes of all segments, (first, last) per axis; last < first for an empty segment.
std::vector<std::array<int, 6>> extents(const volume::LabelMap& labels)
{
  std::vector<std::size_t> place(65536, labels.segments.size());
  for (std::size_t s = 0; s < labels.segments.size(); ++s)
    place[labels.segments[s].index] = s;
  std::vector<std::array<int, 6>> boxes(labels.segments.size() + 1, {0, -1, 0, -1, 0, -1});
  const auto& n = labels.voxels->geometry().dims();
  const std::uint16_t* voxel = labels.voxels->data();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i, ++voxel)
      {
        if (*voxel == 0)
          continue;
        auto& box = boxes[place[*voxel]];
        const bool first = box[1] < box[0];
        const std::array<int, 3> at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a)
        {
          box[2 * a] = first ? at[a] : std::min(box[2 * a], at[a]);
          box[2 * a + 1] = first ? at[a] : std::max(box[2 * a + 1], at[a]);
        }
      }
  return boxes;
}

/// Lower-case words of a file name: split at punctuation, digits and capitals ("HeadAndNeck").
std::vector<std::string> wordsOf(const std::string& name)
{
  std::vector<std::string> words(1);
  bool lowerBefore = false;
  for (const char c : name)
  {
    const auto letter = static_cast<unsigned char>(c);
    const bool capital = std::isupper(letter) != 0;
    if ((std::isalpha(letter) == 0 || (capital && lowerBefore)) && !words.back().empty())
      words.emplace_back();
    if (std::isalpha(letter) != 0)
      words.back() += core::asciiLower(c);
    lowerBefore = std::islower(letter) != 0;
  }
  return words;
}

bool shareAWord(const std::string& a, const std::string& b)
{
  // Words common to label files and colour tables carry no information.
  const std::array<std::string, 8> empty{"label", "labels", "color",        "colors",
                                         "table", "colour", "segmentation", "file"};
  const auto others = wordsOf(b);
  for (const std::string& word : wordsOf(a))
    if (word.size() >= 4 && std::find(empty.begin(), empty.end(), word) == empty.end() &&
        std::find(others.begin(), others.end(), word) != others.end())
      return true;
  return false;
}

/// What a file near the labels holds, in so far as it is a table.
LabelTable tableIn(const std::filesystem::path& path)
{
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size == 0 || size > kLargestTable)
    return {};
  LabelTable table = parseTable(readBytes(path, kLargestTable));
  return table.segments.empty() ? LabelTable{} : table;
}

std::string prefixOf(std::size_t segment)
{
  return "Segment" + std::to_string(segment) + "_";
}

/// -1 if the value is not a number. Older files have one layer and do not state it.
std::int64_t layerOf(const NrrdHeader& header, std::size_t segment)
{
  const std::string* stated = header.key(prefixOf(segment) + "Layer");
  return stated ? parseInteger(trimmed(*stated)).value_or(-1) : 0;
}

/// The parts of a text between separators.
std::vector<std::string_view> partsOf(std::string_view text, char separator)
{
  std::vector<std::string_view> parts;
  for (;;)
  {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos)
      return parts;
    text.remove_prefix(end + 1);
  }
}

/// "scheme^value^meaning"
volume::CodedConcept conceptFrom(std::string_view text)
{
  const auto parts = partsOf(text, '^');
  if (parts.size() != 3 || parts[1].empty() || !core::isUtf8(text))
    return {};
  return {std::string(parts[1]), std::string(parts[0]), std::string(parts[2])};
}

/// A TerminologyEntry; "|" without a type.
std::string tagsOf(const volume::SegmentCodes& codes)
{
  if (codes.type.empty())
    return "|";
  const auto text = [](const volume::CodedConcept& code)
  {
    std::string all = code.scheme + "^" + code.value + "^";
    for (const char c : code.meaning)
      all += c == '^' || c == '~' || c == '|' ? ' ' : c;
    return all;
  };
  return "TerminologyEntry:Segmentation category and type - DICOM master list~" +
         text(codes.category) + "~" + text(codes.type) + "~" + text(codes.typeModifier) +
         "~Anatomic codes - DICOM master list~" + text(codes.region) + "~" +
         text(codes.regionModifier) + "|";
}

/// The numbers of the segments that a header describes, in order; some may be left out.
std::set<std::size_t> segmentNumbers(const NrrdHeader& header)
{
  constexpr std::string_view kStart = "Segment";
  std::set<std::size_t> numbers;
  for (const auto& [key, value] : header.keys)
  {
    const std::size_t end = key.find('_');
    if (end == key.npos || end < kStart.size() || key.compare(0, kStart.size(), kStart) != 0)
      continue;
    const std::string what = key.substr(end + 1);
    const auto number = parseInteger(key.substr(kStart.size(), end - kStart.size()));
    if (number && *number >= 0 && *number < static_cast<std::int64_t>(kMaxSegments) &&
        (what == "Name" || what == "LabelValue" || what == "ID"))
      numbers.insert(static_cast<std::size_t>(*number));
  }
  return numbers;
}

/// The label value of a segment. Before Slicer supported layers it wrote none: structures are
/// numbered from 1.
std::int64_t labelValueOf(const NrrdHeader& header, std::size_t segment)
{
  const std::string* value = header.key(prefixOf(segment) + "LabelValue");
  return value ? parseInteger(trimmed(*value)).value_or(0) : static_cast<std::int64_t>(segment) + 1;
}

} // namespace

std::map<std::uint16_t, volume::SegmentCodes> codesOfLayer(const NrrdHeader& header,
                                                           std::size_t layer)
{
  constexpr std::string_view kEntry = "TerminologyEntry:";
  std::map<std::uint16_t, volume::SegmentCodes> all;
  for (const std::size_t s : segmentNumbers(header))
  {
    const std::string* tags = header.key(prefixOf(s) + "Tags");
    const std::int64_t index = labelValueOf(header, s);
    if (!tags || layerOf(header, s) != static_cast<std::int64_t>(layer) || index < 1 ||
        index > 65535)
      continue;
    volume::SegmentCodes codes;
    for (const std::string_view tag : partsOf(*tags, '|'))
    {
      if (tag.substr(0, kEntry.size()) != kEntry)
        continue;
      // context ~ category ~ type ~ modifier ~ anatomic context ~ region ~ modifier
      const auto parts = partsOf(tag, '~');
      const auto part = [&parts](std::size_t n)
      { return n < parts.size() ? conceptFrom(parts[n]) : volume::CodedConcept(); };
      codes.category = part(1);
      codes.type = part(2);
      codes.typeModifier = part(3);
      codes.region = part(5);
      codes.regionModifier = part(6);
    }
    if (!codes.empty())
      all.emplace(static_cast<std::uint16_t>(index), std::move(codes));
  }
  return all;
}

bool hasSegments(const NrrdHeader& header)
{
  return !segmentNumbers(header).empty();
}

std::string UniqueNames::take(const std::string& wanted, std::vector<std::string>& notes)
{
  std::string name = wanted;
  const auto isStated = [&] { return name != wanted && m_stated.count(name) > 0; };
  for (int& n = m_next[wanted]; isStated() || !m_taken.insert(name).second;)
    name = wanted + " " + std::to_string(n = std::max(n + 1, 2));
  if (name != wanted)
    notes.push_back("several structures are called '" + wanted + "'; one of them was named '" +
                    name + "'");
  return name;
}

std::vector<std::string> segmentsWithoutLayer(const NrrdHeader& header, std::size_t layers)
{
  std::vector<std::string> names;
  for (const std::size_t s : segmentNumbers(header))
  {
    const std::int64_t layer = layerOf(header, s);
    if (layer >= 0 && layer < static_cast<std::int64_t>(layers))
      continue;
    const std::string* name = header.key(prefixOf(s) + "Name");
    names.push_back(name && !name->empty() ? *name : "structure " + std::to_string(s));
  }
  return names;
}

std::vector<volume::Segment> segmentsOfLayer(const std::filesystem::path& path,
                                             const NrrdHeader& header, std::size_t layer)
{
  std::vector<volume::Segment> segments;
  for (const std::size_t s : segmentNumbers(header))
  {
    const std::string prefix = prefixOf(s);
    const std::string* name = header.key(prefix + "Name");
    if (layerOf(header, s) != static_cast<std::int64_t>(layer))
      continue;
    const std::int64_t index = labelValueOf(header, s);
    if (index < 1 || index > 65535)
      fail(FileError::Reason::Unreadable, path,
           "its structure number " + std::to_string(s) +
               " has no label value from 1 to 65535; save it again in 3D Slicer");
    volume::Segment segment;
    segment.index = static_cast<std::uint16_t>(index);
    segment.name = name && !name->empty() ? *name : "label " + std::to_string(index);
    segment.color = colorOf(header.key(prefix + "Color"));
    for (const auto& other : segments)
      if (other.index == segment.index)
        fail(FileError::Reason::Unreadable, path,
             "gives two structures the label value " + std::to_string(index) +
                 "; each needs its own, save it again in 3D Slicer");
    segments.push_back(std::move(segment));
  }
  return segments;
}

std::string segmentKeys(const std::vector<volume::LabelMap>& layers,
                        const std::map<std::uint16_t, volume::SegmentCodes>& codes)
{
  std::string keys;
  std::size_t number = 0;
  for (std::size_t layer = 0; layer < layers.size(); ++layer)
  {
    const volume::LabelMap& labels = layers[layer];
    const auto boxes = extents(labels);
    for (std::size_t s = 0; s < labels.segments.size(); ++s)
    {
      const volume::Segment& segment = labels.segments[s];
      const std::string prefix = prefixOf(number++);
      std::string color;
      for (const float channel : segment.color)
        color += (color.empty() ? "" : " ") + exactText(channel);
      std::string box;
      for (const int edge : boxes[s])
        box += (box.empty() ? "" : " ") + std::to_string(edge);
      const std::string id = (layer == 0 ? "" : std::to_string(layer) + "_");
      keys += nrrdKeyText(prefix + "Color", color) +
              nrrdKeyText(prefix + "ColorAutoGenerated", "0") +
              nrrdKeyText(prefix + "Extent", box) +
              nrrdKeyText(prefix + "ID", "Segment_" + id + std::to_string(segment.index)) +
              nrrdKeyText(prefix + "LabelValue", std::to_string(segment.index)) +
              nrrdKeyText(prefix + "Layer", std::to_string(layer)) +
              nrrdKeyText(prefix + "Name", segment.name) +
              nrrdKeyText(prefix + "NameAutoGenerated", "0") +
              nrrdKeyText(prefix + "Tags",
                          codes.count(segment.index) > 0 ? tagsOf(codes.at(segment.index)) : "|");
    }
  }
  return keys + nrrdKeyText("Segmentation_ContainedRepresentationNames", "Binary labelmap|") +
         nrrdKeyText("Segmentation_MasterRepresentation", "Binary labelmap") +
         nrrdKeyText("Segmentation_ReferenceImageExtentOffset", "0 0 0");
}

LabelTable findLabelTable(const std::filesystem::path& labelFile)
{
  const std::filesystem::path folder =
      labelFile.has_parent_path() ? labelFile.parent_path() : std::filesystem::path(".");
  const std::string base = baseName(labelFile);
  for (const char* end : {".ctbl", ".txt", ".label", ".csv", ".tsv", ".json"})
    if (LabelTable table = tableIn(folder / (base + end)); !table.segments.empty())
    {
      table.sameName = true;
      return table;
    }

  std::vector<std::filesystem::path> tables;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (endsWith(lowerName(entry->path()), ".ctbl"))
      tables.push_back(entry->path());
  if (tables.size() == 1 && shareAWord(base, baseName(tables.front())))
    return tableIn(tables.front());
  return {};
}

} // namespace petrous::imaging
