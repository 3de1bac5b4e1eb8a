#include "MetaHeader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "FileHelpers.h"
#include "GridFromAffine.h"

namespace petrous::imaging
{

namespace
{

constexpr std::uintmax_t kLargestHeader = 65536;
constexpr std::size_t kMaxDims = 8;

using Fields = std::vector<std::pair<std::string, std::string>>;
using Names = std::initializer_list<const char*>; // of one field

constexpr Names kPlace = {"Offset", "Position", "Origin"};
constexpr Names kAxes = {"TransformMatrix", "Rotation", "Orientation"};
constexpr Names kByteOrder = {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"};

/// The `key = value` lines at the start, up to ElementDataFile.
Fields fieldsOf(const std::filesystem::path& path)
{
  const std::string bytes = readBytes(path, kLargestHeader);
  Fields fields;
  std::string_view rest = bytes;
  while (!rest.empty())
  {
    const std::string_view line = takeLine(rest);
    const std::size_t sign = line.find('=');
    if (sign == line.npos)
      break;
    fields.emplace_back(trimmed(line.substr(0, sign)), trimmed(line.substr(sign + 1)));
    if (fields.back().first == "ElementDataFile")
      break;
  }
  return fields;
}

/// The first of these synonymous keys that the header has.
const std::string* valueOf(const Fields& fields, Names names)
{
  for (const char* name : names)
    for (const auto& field : fields)
      if (field.first == name)
        return &field.second;
  return nullptr;
}

bool isTrue(const Fields& fields, Names names)
{
  const std::string* value = valueOf(fields, names);
  return value && !value->empty() &&
         (value->front() == 'T' || value->front() == 't' || value->front() == '1');
}

/// MetaImage types. MET_LONG is excluded: its size depends on the machine that wrote it.
std::optional<Component> metaComponent(const std::string* name)
{
  constexpr std::array<std::pair<const char*, Component>, 10> kTypes{
      {{"MET_CHAR", Component::Int8},
       {"MET_UCHAR", Component::UInt8},
       {"MET_SHORT", Component::Int16},
       {"MET_USHORT", Component::UInt16},
       {"MET_INT", Component::Int32},
       {"MET_UINT", Component::UInt32},
       {"MET_LONG_LONG", Component::Int64},
       {"MET_ULONG_LONG", Component::UInt64},
       {"MET_FLOAT", Component::Float},
       {"MET_DOUBLE", Component::Double}}};
  for (const auto& [known, component] : kTypes)
    if (name && *name == known)
      return component;
  return std::nullopt;
}

/// All words as numbers; empty if one is not a number.
std::vector<double> numbersOf(const std::string* text)
{
  std::vector<double> values;
  std::string_view rest = text ? std::string_view(*text) : std::string_view();
  for (auto word = takeWord(rest); !word.empty(); word = takeWord(rest))
  {
    const auto value = parseDouble(word);
    if (!value)
      return {};
    values.push_back(*value);
  }
  return values;
}

/// Refuses a field that is stated twice, with another value each: programs differ in which they
/// take. ElementSize is not another name of ElementSpacing: slices may be thicker than their
/// distance.
void refuseContradictions(const std::filesystem::path& path, const Fields& fields)
{
  const auto check = [&](Names names)
  {
    const char* firstName = nullptr;
    const std::string* first = nullptr;
    for (const auto& [key, value] : fields)
    {
      const auto* const name = std::find(names.begin(), names.end(), key);
      if (name == names.end())
        continue;
      if (!first)
      {
        firstName = *name;
        first = &value;
        continue;
      }
      const auto numbers = numbersOf(&value);
      if (value != *first && (numbers.empty() || numbers != numbersOf(first)))
        fail(FileError::Reason::Unreadable, path,
             std::string("its MetaImage header has ") + firstName +
                 (key == firstName ? std::string(" twice")
                                   : std::string(" and ") + *name + ", which are one field") +
                 ", with another value each; export it again");
    }
  };
  for (const char* name : {"NDims", "DimSize", "ElementType", "ElementNumberOfChannels",
                           "BinaryData", "CompressedData", "HeaderSize", "ElementSpacing",
                           "ElementSize", "DistanceUnits", "AnatomicalOrientation",
                           "ElementToIntensityFunctionSlope", "ElementToIntensityFunctionOffset"})
    check({name});
  check(kByteOrder);
  check(kPlace);
  check(kAxes);
}

void readDims(const std::filesystem::path& path, const Fields& fields, MetaHeader& header)
{
  const auto sizes = numbersOf(valueOf(fields, {"DimSize"}));
  for (const double size : sizes)
    header.dims.push_back(size >= 1.0 && size < 2147483648.0 ? static_cast<std::uint64_t>(size)
                                                             : 0);
  const std::vector<double> count{static_cast<double>(sizes.size())};
  if (sizes.empty() || sizes.size() > kMaxDims || numbersOf(valueOf(fields, {"NDims"})) != count ||
      std::count(header.dims.begin(), header.dims.end(), 0U) > 0)
    fail(FileError::Reason::Unreadable, path,
         "its header gives no valid dimensions (NDims, DimSize); export it again");
  if (sizes.size() < 3)
    fail(FileError::Reason::Unsupported, path,
         "holds a picture of " + std::to_string(sizes.size()) +
             " dimensions; a volume of 3 is needed");
}

void findVoxels(const std::filesystem::path& path, const Fields& fields, MetaHeader& header)
{
  const std::string data = *valueOf(fields, {"ElementDataFile"});
  const std::string* skip = valueOf(fields, {"HeaderSize"});
  header.saysBinary = isTrue(fields, {"BinaryData"});
  if ((valueOf(fields, {"BinaryData"}) && !header.saysBinary) || data.rfind("LIST", 0) == 0 ||
      data.find('%') != data.npos || (skip && *skip != "0"))
    failMetaKind(path);
  header.packed = isTrue(fields, {"CompressedData"});
  header.swapped = isTrue(fields, kByteOrder);
  if (data == "LOCAL" || data == "Local" || data == "local")
  {
    const std::string start = readBytes(path, kLargestHeader);
    const std::size_t at = start.find('\n', start.find("ElementDataFile"));
    header.file = path;
    header.offset = at == start.npos ? start.size() : at + 1;
    header.dataBytes = checkedFileSize(path);
  }
  else
  {
    header.file = detachedFile(path, data, header.notes);
    header.dataBytes = checkedFileSize(header.file);
  }
}

/// The letters denote the side of the patient from which each axis starts ("RAI": LPS), if present.
/// ITK and everything based on it uses TransformMatrix, so the letters are only compared.
void noteOrientation(const Fields& fields, bool hasAxes, const Eigen::Matrix3d& linear,
                     std::vector<std::string>& notes)
{
  const std::string* said = valueOf(fields, {"AnatomicalOrientation"});
  if (!said || said->size() < 3 || said->find('?') != said->npos)
    return;
  std::string real;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    Eigen::Index along = a;
    for (Eigen::Index row = 0; row < 3; ++row)
      if (std::abs(linear(row, a)) > std::abs(linear(along, a)))
        along = row;
    real += (linear(along, a) < 0.0 ? "LPS" : "RAI")[along];
  }
  if (said->compare(0, 3, real) != 0)
    notes.push_back("names its axes otherwise (AnatomicalOrientation) than " + real + ", as its " +
                    (hasAxes ? "TransformMatrix" : "missing TransformMatrix") +
                    " says, which is used; check left and right");
}

void readRescale(const std::filesystem::path& path, const Fields& fields, MetaHeader& header)
{
  const std::string* slope = valueOf(fields, {"ElementToIntensityFunctionSlope"});
  const std::string* offset = valueOf(fields, {"ElementToIntensityFunctionOffset"});
  const auto a = slope ? parseDouble(*slope) : std::optional(1.0);
  const auto b = offset ? parseDouble(*offset) : std::optional(0.0);
  if (!a || !b || *a == 0.0)
    fail(FileError::Reason::Unreadable, path,
         "its rescale slope or offset (ElementToIntensityFunction) is not a number that can be "
         "true; export it again from where it came");
  header.slope = *a;
  header.intercept = *b;
}

void readPlacement(const std::filesystem::path& path, const Fields& fields, MetaHeader& header)
{
  const std::size_t n = header.dims.size();
  const std::string* units = valueOf(fields, {"DistanceUnits"});
  header.unit = namedUnit(units ? *units : "");
  const double unit = header.unit.mm;
  const auto spacing = numbersOf(valueOf(fields, {"ElementSpacing", "ElementSize"}));
  const std::string* place = valueOf(fields, kPlace);
  const std::string* axes = valueOf(fields, kAxes);
  const auto origin = place ? numbersOf(place) : std::vector<double>(n, 0.0);
  const auto cosines = axes ? numbersOf(axes) : std::vector<double>(n * n, 0.0);
  if (spacing.size() != n || origin.size() != n || cosines.size() != n * n)
    fail(FileError::Reason::NoGeometry, path,
         "its header gives no valid voxel size, place or axes in three dimensions "
         "(ElementSpacing, Offset, TransformMatrix); export it again with its geometry");
  header.isSideAssumed = !axes;
  if (!place || !axes)
    header.notes.emplace_back("states no full place in the patient (Offset, TransformMatrix): what "
                              "is missing is taken as 0, 0, 0 and the patient's axes");
  // The sign is kept, as ITK's ImageFileReader keeps it: it turns the axis round.
  if (std::min({spacing[0], spacing[1], spacing[2]}) < 0.0)
    header.notes.emplace_back(
        "states a negative voxel size (ElementSpacing), by which an axis runs "
        "the other way and the image is mirrored; check left and right");
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto column = static_cast<Eigen::Index>(a);
    header.origin[column] = origin[a] * unit;
    // TransformMatrix lists the axes consecutively.
    for (std::size_t row = 0; row < 3; ++row)
      header.linear(static_cast<Eigen::Index>(row), column) =
          (axes ? cosines[a * n + row] : (a == row ? 1.0 : 0.0)) * spacing[a] * unit;
  }
  noteOrientation(fields, axes != nullptr, header.linear, header.notes);
}

} // namespace

MetaHeader readMetaHeader(const std::filesystem::path& path)
{
  const Fields fields = fieldsOf(path);
  if (!valueOf(fields, {"ElementDataFile"}) || !valueOf(fields, {"NDims"}))
    failFormat(path, "MetaImage");
  refuseContradictions(path, fields);
  MetaHeader header;
  readDims(path, fields, header);
  const auto component = metaComponent(valueOf(fields, {"ElementType"}));
  const std::string* channels = valueOf(fields, {"ElementNumberOfChannels"});
  if (!component || (channels && *channels != "1"))
    fail(FileError::Reason::Unsupported, path,
         "its voxels are of a type that is not read; save them as one whole number or float each");
  header.component = *component;
  if (const std::string* comment = valueOf(fields, {"Comment"}))
    header.comment = *comment;
  if (const std::string* unit = valueOf(fields, {kUnitKey}))
    header.isHounsfield = *unit == kHounsfield;
  findVoxels(path, fields, header);
  readRescale(path, fields, header);
  readPlacement(path, fields, header);
  return header;
}

void failMetaKind(const std::filesystem::path& path)
{
  fail(FileError::Reason::Unsupported, path,
       "keeps its voxels as text, in several files or behind a foreign header; save it as one "
       "binary .mha");
}

} // namespace petrous::imaging
