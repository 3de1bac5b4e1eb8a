#include "NrrdLayout.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "FileHelpers.h"
#include "GridFromAffine.h"

namespace petrous::imaging
{

namespace
{

using Path = std::filesystem::path;

constexpr std::size_t kMaxDims = 16; // NRRD_DIM_MAX

std::string inLowerCase(std::string_view text)
{
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string valueOf(const NrrdHeader& header, const std::string& name)
{
  const std::string* text = header.field(name);
  return text ? inLowerCase(trimmed(*text)) : std::string();
}

/// The names of the types, in all spellings.
std::optional<Component> componentNamed(const std::string& name)
{
  constexpr std::pair<const char*, Component> kTypes[] = {
      {"signed char", Component::Int8},
      {"int8", Component::Int8},
      {"int8_t", Component::Int8},
      {"uchar", Component::UInt8},
      {"unsigned char", Component::UInt8},
      {"uint8", Component::UInt8},
      {"uint8_t", Component::UInt8},
      {"short", Component::Int16},
      {"short int", Component::Int16},
      {"signed short", Component::Int16},
      {"signed short int", Component::Int16},
      {"int16", Component::Int16},
      {"int16_t", Component::Int16},
      {"ushort", Component::UInt16},
      {"unsigned short", Component::UInt16},
      {"unsigned short int", Component::UInt16},
      {"uint16", Component::UInt16},
      {"uint16_t", Component::UInt16},
      {"int", Component::Int32},
      {"signed int", Component::Int32},
      {"int32", Component::Int32},
      {"int32_t", Component::Int32},
      {"uint", Component::UInt32},
      {"unsigned int", Component::UInt32},
      {"uint32", Component::UInt32},
      {"uint32_t", Component::UInt32},
      {"longlong", Component::Int64},
      {"long long", Component::Int64},
      {"long long int", Component::Int64},
      {"signed long long", Component::Int64},
      {"signed long long int", Component::Int64},
      {"int64", Component::Int64},
      {"int64_t", Component::Int64},
      {"ulonglong", Component::UInt64},
      {"unsigned long long", Component::UInt64},
      {"unsigned long long int", Component::UInt64},
      {"uint64", Component::UInt64},
      {"uint64_t", Component::UInt64},
      {"float", Component::Float},
      {"double", Component::Double}};
  for (const auto& [known, component] : kTypes)
    if (name == known)
      return component;
  return std::nullopt;
}

/// The words of a field with one per axis: vectors in parentheses, texts in quotes.
std::vector<std::string> axisWords(const std::string* text)
{
  std::vector<std::string> words;
  std::string_view rest = text ? trimmed(*text) : std::string_view();
  while (!rest.empty())
  {
    const char end = rest.front() == '(' ? ')' : rest.front() == '"' ? '"' : '\0';
    if (end == '\0')
      words.emplace_back(takeWord(rest));
    else
    {
      const std::size_t length = std::min(rest.find(end, 1), rest.size() - 1) + 1;
      words.emplace_back(rest.substr(0, length));
      rest.remove_prefix(length);
    }
    rest = trimmed(rest);
  }
  return words;
}

/// Parses "(a,b,c)"; `time` receives a fourth number if present.
std::optional<Eigen::Vector3d> vectorOf(const std::string& word, double& time)
{
  if (word.size() < 2 || word.front() != '(' || word.back() != ')')
    return std::nullopt;
  std::string plain = word.substr(1, word.size() - 2);
  std::replace(plain.begin(), plain.end(), ',', ' ');
  std::array<double, 4> values{};
  std::size_t count = 0;
  std::string_view rest = plain;
  for (auto one = takeWord(rest); !one.empty(); one = takeWord(rest))
  {
    const auto value = parseDouble(one);
    if (!value || count == values.size())
      return std::nullopt;
    values[count++] = *value;
  }
  if (count < 3)
    return std::nullopt;
  time = values[3];
  return Eigen::Vector3d(values[0], values[1], values[2]);
}

/// Signs that convert the file's frame to left, posterior, superior.
Eigen::Vector3d lpsFromSpace(const Path& path, const NrrdHeader& header, NrrdLayout& layout)
{
  std::vector<std::string>& notes = layout.notes;
  std::string space = valueOf(header, "space");
  for (const std::string_view time : {"-time", "t"}) // "LPST": the first three are spatial
    if (space.size() > time.size() + 2 && endsWith(space, time) && space != "right" &&
        space != "left")
    {
      space.erase(space.size() - time.size());
      break;
    }
  if (space == "left-posterior-superior" || space == "lps")
    return {1.0, 1.0, 1.0};
  if (space == "right-anterior-superior" || space == "ras")
    return {-1.0, -1.0, 1.0};
  if (space == "left-anterior-superior" || space == "las")
    return {1.0, -1.0, 1.0};
  if (space.empty())
    notes.emplace_back("states no patient frame: its axes are taken as the patient's");
  else if (space == "scanner-xyz" || space == "3d-right-handed")
    notes.emplace_back("its frame is not a patient's, and its axes are taken as the patient's");
  else
    fail(FileError::Reason::NoGeometry, path,
         space == "3d-left-handed"
             ? "its frame is left-handed and not a patient's, so left and right cannot be told "
               "apart; export it in left-posterior-superior"
             : "its header names a frame ('space') that NRRD does not know; export it in "
               "left-posterior-superior");
  layout.isSideAssumed = true;
  return {1.0, 1.0, 1.0};
}

/// The unit of all axes of the file's frame. `firstAxis`: the first of the file's own that is one
/// of space.
LengthUnit unitOf(const Path& path, const NrrdHeader& header, std::size_t firstAxis)
{
  const std::string* text = header.field("space units"); // of the frame; "units" are of all axes
  const std::size_t first = text ? 0 : firstAxis;
  const auto words = axisWords(text ? text : header.field("units"));
  LengthUnit unit;
  for (std::size_t a = 0; a < 3; ++a)
  {
    LengthUnit one = namedUnit(first + a < words.size() ? words[first + a] : std::string());
    if (a > 0 && one.mm != unit.mm)
      fail(FileError::Reason::NoGeometry, path,
           "its header gives the axes different units of length ('space units'), which cannot be "
           "meant; export it again with its geometry");
    if (a == 0)
      unit = std::move(one);
    else
    {
      unit.isStated = unit.isStated && one.isStated;
      unit.isUnknown = unit.isUnknown || one.isUnknown;
    }
  }
  return unit;
}

std::vector<std::uint64_t> sizesOf(const Path& path, const NrrdHeader& header)
{
  std::vector<std::uint64_t> sizes;
  for (const std::string& word : axisWords(header.field("sizes")))
    sizes.push_back(
        static_cast<std::uint64_t>(std::max<std::int64_t>(parseInteger(word).value_or(0), 0)));
  const auto dimension = parseInteger(valueOf(header, "dimension"));
  if (sizes.empty() || sizes.size() > kMaxDims ||
      dimension != static_cast<std::int64_t>(sizes.size()) ||
      std::count(sizes.begin(), sizes.end(), 0U) > 0)
    fail(FileError::Reason::Unreadable, path,
         "its header gives no valid dimensions (dimension, sizes); export it again");
  return sizes;
}

/// Which axes index voxel components instead of space.
std::vector<bool> rangeAxes(const NrrdHeader& header, std::size_t count)
{
  std::vector<bool> range(count, false);
  const auto directions = axisWords(header.field("space directions"));
  const auto kinds = axisWords(header.field("kinds"));
  for (std::size_t a = 0; a < count; ++a)
    if (!directions.empty())
      range[a] = a < directions.size() && inLowerCase(directions[a]) == "none";
    else if (a < kinds.size())
    {
      const std::string kind = inLowerCase(kinds[a]);
      range[a] =
          kind != "domain" && kind != "space" && kind != "time" && kind != "none" && kind != "???";
    }
  return range;
}

[[noreturn]] void failGeometry(const Path& path, const char* field)
{
  fail(FileError::Reason::NoGeometry, path,
       std::string("its header gives no valid '") + field +
           "' in three dimensions; export it again with its geometry");
}

void readPlacement(const Path& path, const NrrdHeader& header, std::size_t firstAxis,
                   NrrdLayout& layout)
{
  layout.unit = unitOf(path, header, firstAxis);
  const double scale = layout.unit.mm;
  const auto directions = axisWords(header.field("space directions"));
  const auto spacings = axisWords(header.field("spacings"));
  if (directions.empty() && spacings.empty())
    fail(FileError::Reason::NoGeometry, path,
         "its header gives no voxel size ('space directions'); export it again with its geometry");
  Eigen::Vector3d toLps(1.0, 1.0, 1.0);
  layout.linear.setZero();
  layout.origin.setZero();
  if (directions.empty())
  {
    layout.isSideAssumed = true;
    layout.notes.emplace_back("states no place in the patient: its axes are taken as the "
                              "patient's, from 0, 0, 0"); // which way, is settled later
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto size =
          firstAxis + a < spacings.size() ? parseDouble(spacings[firstAxis + a]) : std::nullopt;
      if (!size)
        failGeometry(path, "spacings");
      const auto axis = static_cast<Eigen::Index>(a);
      layout.linear(axis, axis) = *size * scale;
    }
    return;
  }
  toLps = scale * lpsFromSpace(path, header, layout);
  for (std::size_t a = 0; a < 3; ++a)
  {
    double time = 0.0;
    const auto step = firstAxis + a < directions.size() ? vectorOf(directions[firstAxis + a], time)
                                                        : std::nullopt;
    if (!step || time != 0.0)
      failGeometry(path, "space directions");
    layout.linear.col(static_cast<Eigen::Index>(a)) = toLps.cwiseProduct(*step);
  }
  const std::string* origin = header.field("space origin");
  if (!origin)
  {
    layout.notes.emplace_back("states no place of its first voxel ('space origin'); taken as 0, 0, "
                              "0");
    return;
  }
  double time = 0.0;
  const auto first = vectorOf(std::string(trimmed(*origin)), time);
  if (!first)
    failGeometry(path, "space origin");
  layout.origin = toLps.cwiseProduct(*first);
}

/// The first byte after `lines` line ends.
std::uint64_t skippedLines(const Path& path, std::uint64_t offset, std::int64_t lines)
{
  constexpr std::uintmax_t kMaxSkipped = std::uintmax_t{16} << 20;
  if (lines == 0)
    return offset;
  const std::string bytes = readBytes(path, offset + kMaxSkipped);
  std::size_t at = static_cast<std::size_t>(offset);
  for (; lines > 0 && at != std::string::npos && at < bytes.size(); --lines)
    at = bytes.find('\n', at) == std::string::npos ? bytes.size() : bytes.find('\n', at) + 1;
  return at;
}

/// "slice%03d.raw" with the number; nullopt if it is no such pattern.
std::optional<std::string> numberedName(std::string_view pattern, std::int64_t number)
{
  const std::size_t start = pattern.find('%');
  std::size_t at = start + 1;
  const bool zeros = at < pattern.size() && pattern[at] == '0';
  std::size_t width = 0;
  for (; at < pattern.size() && pattern[at] >= '0' && pattern[at] <= '9' && width < 100; ++at)
    width = width * 10 + static_cast<std::size_t>(pattern[at] - '0');
  if (at >= pattern.size() || (pattern[at] != 'd' && pattern[at] != 'u' && pattern[at] != 'i') ||
      pattern.find('%', at) != pattern.npos || number < 0)
    return std::nullopt;
  std::string digits = std::to_string(number);
  if (digits.size() < width)
    digits.insert(0, width - digits.size(), zeros ? '0' : ' ');
  return std::string(pattern.substr(0, start)) + digits + std::string(pattern.substr(at + 1));
}

/// The files named by "data file": one, "LIST" and one a line, or a pattern, first and last number
/// and step. Empty if it is none of these.
std::vector<std::string> dataFileNames(const NrrdHeader& header, const std::string& text)
{
  constexpr std::size_t kMaxFiles = 65536;
  if (text.rfind("LIST", 0) == 0)
    return header.dataFiles;
  if (text.find('%') == text.npos)
    return {text};
  std::vector<std::string> names;
  std::string_view rest = text;
  const std::string_view pattern = takeWord(rest);
  const auto first = parseInteger(takeWord(rest));
  const auto last = parseInteger(takeWord(rest));
  const auto step = parseInteger(takeWord(rest));
  constexpr std::int64_t kLargest = 1000000000;
  if (!first || !last || !step || *step == 0 || std::abs(*first) > kLargest ||
      std::abs(*last) > kLargest || std::abs(*step) > kLargest)
    return {};
  for (std::int64_t n = *first; *step > 0 ? n <= *last : n >= *last; n += *step)
  {
    const auto name = numberedName(pattern, n);
    if (!name || names.size() == kMaxFiles)
      return {};
    names.push_back(*name);
  }
  return names;
}

void findVoxels(const Path& path, const NrrdHeader& header, NrrdLayout& layout)
{
  const std::string encoding = valueOf(header, "encoding");
  VoxelPlace& place = layout.place;
  if (encoding == "gz" || encoding == "gzip")
    place.packing = Packing::Zlib;
  else if (encoding == "bz2" || encoding == "bzip2")
    place.packing = Packing::Bzip2;
  else if (encoding == "hex")
    place.packing = Packing::Hex;
  else if (encoding == "txt" || encoding == "text" || encoding == "ascii")
    layout.isText = true;
  else if (encoding != "raw")
    fail(FileError::Reason::Unsupported, path,
         "its voxels are packed in a way that is not read; save it with encoding raw or gzip");

  place.parts = {{path, header.dataOffset}};
  if (const std::string* data = header.field("data file"))
  {
    place.parts.clear();
    for (const std::string& name : dataFileNames(header, *data))
      place.parts.push_back({detachedFile(path, name, layout.notes), 0});
    // Each file holds as many slices.
    const std::uint64_t slices =
        layout.dims[2] * (layout.dims.size() > 3 ? layout.dims[3] : std::uint64_t{1});
    if (place.parts.empty() || slices % place.parts.size() != 0)
      fail(FileError::Reason::Unreadable, path,
           "its list of data files is damaged, or does not share the " + std::to_string(slices) +
               " slices evenly; save it as one .nrrd");
    if (place.parts.size() > 1 && layout.isText)
      fail(FileError::Reason::Unsupported, path,
           "keeps its voxels as text in several files; save it as one .nrrd");
  }

  const auto skipOf = [&](const char* name, const char* other) -> std::int64_t
  {
    const std::string text = valueOf(header, header.field(name) ? name : other);
    const auto skip = text.empty() ? std::optional<std::int64_t>(0) : parseInteger(text);
    if (!skip || *skip < -1)
      fail(FileError::Reason::Unreadable, path,
           std::string("its header has no valid '") + name + "'; export it again");
    return *skip;
  };
  const std::int64_t lines = skipOf("line skip", "lineskip");
  const std::int64_t bytes = skipOf("byte skip", "byteskip");
  if (bytes < 0 && (place.packing != Packing::None || layout.isText))
    fail(FileError::Reason::Unsupported, path,
         "counts its packed voxels from the end of the file; save it as one .nrrd");
  long double partBytes = static_cast<long double>(layout.components) *
                          visitComponent(layout.component, [](auto type) { return sizeof type; }) /
                          static_cast<long double>(place.parts.size());
  for (const std::uint64_t n : layout.dims)
    partBytes *= static_cast<long double>(n);
  for (VoxelPlace::Part& part : place.parts)
  {
    const std::uintmax_t size = checkedFileSize(part.file);
    layout.dataBytes += size;
    part.offset = skippedLines(part.file, part.offset, std::max<std::int64_t>(lines, 0));
    if (bytes < 0 && partBytes <= static_cast<long double>(size)) // the voxels are at the end
      part.offset = size - static_cast<std::uint64_t>(partBytes);
    else if (bytes > 0 && layout.isText)
      part.offset += static_cast<std::uint64_t>(bytes);
  }
  if (bytes > 0 && !layout.isText)
    place.packedOffset = static_cast<std::uint64_t>(bytes);
}

} // namespace

NrrdLayout readNrrdLayout(const Path& path, const NrrdHeader& header)
{
  NrrdLayout layout;
  const auto component = componentNamed(valueOf(header, "type"));
  if (!component)
    fail(FileError::Reason::Unsupported, path,
         "its voxels are of a type that is not read; save them as whole numbers or float");
  layout.component = *component;
  const auto sizes = sizesOf(path, header);
  const auto range = rangeAxes(header, sizes.size());
  std::size_t first = 0;
  long double components = 1.0L; // absurd sizes would overflow an integer
  for (; first < sizes.size() && range[first]; ++first)
    components *= static_cast<long double>(sizes[first]);
  if (components > 65536.0L)
    fail(FileError::Reason::Unsupported, path,
         "holds more than 65536 numbers a voxel; one is needed");
  layout.components = static_cast<std::size_t>(components);
  layout.dims.assign(sizes.begin() + static_cast<std::ptrdiff_t>(first), sizes.end());
  if (layout.dims.size() < 3)
    fail(FileError::Reason::Unsupported, path,
         "holds " + dimsText(layout.dims) + " voxels; a volume of 3 dimensions is needed");
  if (const auto kinds = axisWords(header.field("kinds")); first == 1 && !kinds.empty())
    layout.isList = inLowerCase(kinds.front()) == "list" || inLowerCase(kinds.front()) == "time";
  const std::string endian = valueOf(header, "endian");
  if (endian != "little" && endian != "big" && valueOf(header, "encoding") != "text" &&
      visitComponent(layout.component, [](auto type) { return sizeof type; }) > 1 &&
      valueOf(header, "encoding") != "ascii" && valueOf(header, "encoding") != "txt")
    fail(FileError::Reason::Unreadable, path,
         "its header does not say in which order the bytes of a number stand ('endian'); export "
         "it again");
  layout.swapped = endian == "big";
  if (header.field("old min") || header.field("oldmin"))
    layout.notes.emplace_back("states which values its numbers stood for before they were packed "
                              "('old min', 'old max'); the numbers are taken as they are");
  findVoxels(path, header, layout);
  readPlacement(path, header, first, layout);
  return layout;
}

} // namespace petrous::imaging
