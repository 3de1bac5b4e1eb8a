#include "MeshReaders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "Component.h"
#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

enum class Encoding
{
  Text,
  LittleEndian,
  BigEndian
};

struct Property
{
  std::string name;
  Component type = Component::Float;
  std::optional<Component> listCount; ///< type of the list length
};

struct Element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

std::optional<Component> numberNamed(std::string_view name)
{
  constexpr std::array<std::pair<std::string_view, Component>, 16> kNames{
      {{"char", Component::Int8},
       {"int8", Component::Int8},
       {"uchar", Component::UInt8},
       {"uint8", Component::UInt8},
       {"short", Component::Int16},
       {"int16", Component::Int16},
       {"ushort", Component::UInt16},
       {"uint16", Component::UInt16},
       {"int", Component::Int32},
       {"int32", Component::Int32},
       {"uint", Component::UInt32},
       {"uint32", Component::UInt32},
       {"float", Component::Float},
       {"float32", Component::Float},
       {"double", Component::Double},
       {"float64", Component::Double}}};
  for (const auto& [known, number] : kNames)
    if (known == name)
      return number;
  return std::nullopt;
}

std::size_t sizeOf(Component type)
{
  return visitComponent(type, [](auto number) { return sizeof number; });
}

class PlyParser
{
public:
  PlyParser(const std::filesystem::path& path, std::string_view bytes,
            const core::Progress& progress)
    : m_builder(path, progress)
    , m_rest(bytes)
  {
  }

  LoadedMesh parse()
  {
    readHeader();
    for (const Element& element : m_elements)
    {
      checkCount(element);
      if (element.name == "vertex")
        readVertices(element);
      else if (element.name == "face")
        readFaces(element);
      else
        skip(element);
    }
    return m_builder.take();
  }

private:
  void readHeader()
  {
    if (takeLine(m_rest) != "ply")
      m_builder.failUnreadable("it does not start as PLY");
    bool hasFormat = false;
    while (!m_rest.empty())
    {
      std::string_view line = takeLine(m_rest);
      const std::string_view word = takeWord(line);
      if (word == "end_header")
      {
        if (!hasFormat)
          m_builder.failUnreadable("its header names no format");
        return;
      }
      if (word == "format")
        hasFormat = readFormat(takeWord(line));
      else if (word == "element")
        readElement(line);
      else if (word == "property")
        readProperty(line);
      else if (word != "comment" && word != "obj_info")
        m_builder.failUnreadable("its header has an unknown line");
    }
    m_builder.failUnreadable("its header does not end");
  }

  bool readFormat(std::string_view name)
  {
    if (name == "ascii")
      m_encoding = Encoding::Text;
    else if (name == "binary_little_endian")
      m_encoding = Encoding::LittleEndian;
    else if (name == "binary_big_endian")
      m_encoding = Encoding::BigEndian;
    else
      m_builder.failUnreadable("its header names an unknown format");
    return true;
  }

  void readElement(std::string_view line)
  {
    Element element;
    element.name = takeWord(line);
    const auto count = parseInteger(takeWord(line));
    if (!count || *count < 0)
      m_builder.failUnreadable("its header has an element without a count");
    element.count = static_cast<std::uint64_t>(*count);
    m_elements.push_back(std::move(element));
  }

  void readProperty(std::string_view line)
  {
    Property property;
    std::string_view type = takeWord(line);
    if (type == "list")
    {
      property.listCount = numberNamed(takeWord(line));
      if (!property.listCount)
        m_builder.failUnreadable("its header has a list of an unknown type");
      type = takeWord(line);
    }
    const auto number = numberNamed(type);
    property.name = takeWord(line);
    if (!number || m_elements.empty())
      m_builder.failUnreadable("its header has a property of an unknown type");
    property.type = *number;
    m_elements.back().properties.push_back(std::move(property));
  }

  /// Rejects a count that the rest of the file cannot contain.
  void checkCount(const Element& element) const
  {
    std::uint64_t least = 0;
    for (const Property& property : element.properties)
      least +=
          m_encoding == Encoding::Text ? 2 : sizeOf(property.listCount.value_or(property.type));
    // The last number of a text file may lack the line end.
    if (element.count > 0 && (least == 0 || element.count > (m_rest.size() + 1) / least))
      m_builder.failUnreadable("its header counts more than the file can hold");
  }

  double take(Component type)
  {
    m_builder.step();
    if (m_encoding == Encoding::Text)
    {
      const auto value = parseDouble(takeWord(m_rest));
      if (!value)
        m_builder.failUnreadable("it breaks off, or has a word where a number belongs");
      return *value;
    }
    const std::size_t size = sizeOf(type);
    if (m_rest.size() < size)
      m_builder.failUnreadable("it breaks off");
    std::array<char, 8> raw{};
    std::copy_n(m_rest.data(), size, raw.data());
    m_rest.remove_prefix(size);
    if (m_encoding == Encoding::BigEndian)
      std::reverse(raw.data(), raw.data() + size);
    return decoded(type, raw.data());
  }

  static double decoded(Component type, const char* raw)
  {
    return visitComponent(type,
                          [raw](auto value)
                          {
                            std::memcpy(&value, raw, sizeof value);
                            return static_cast<double>(value);
                          });
  }

  std::int64_t takeWhole(Component type, const char* what)
  {
    const double value = take(type);
    if (!(std::abs(value) <= 4294967295.0) || value != std::floor(value))
      m_builder.failUnreadable(what);
    return static_cast<std::int64_t>(value);
  }

  std::int64_t takeLength(Component type)
  {
    const std::int64_t length = takeWhole(type, "a list has no valid length");
    if (length < 0 || static_cast<std::uint64_t>(length) > m_rest.size())
      m_builder.failUnreadable("a list is longer than the file");
    return length;
  }

  void skipProperty(const Property& property)
  {
    const std::int64_t values = property.listCount ? takeLength(*property.listCount) : 1;
    for (std::int64_t v = 0; v < values; ++v)
      take(property.type);
  }

  void skip(const Element& element)
  {
    for (std::uint64_t e = 0; e < element.count; ++e)
      for (const Property& property : element.properties)
        skipProperty(property);
  }

  void readVertices(const Element& element)
  {
    std::array<std::size_t, 3> place{};
    for (std::size_t a = 0; a < 3; ++a)
    {
      const std::string name(1, "xyz"[a]);
      const auto at =
          std::find_if(element.properties.begin(), element.properties.end(),
                       [&name](const Property& p) { return p.name == name && !p.listCount; });
      if (at == element.properties.end())
        m_builder.failUnreadable("its vertices have no x, y and z");
      place[a] = static_cast<std::size_t>(at - element.properties.begin());
    }
    m_builder.reserve(static_cast<std::size_t>(element.count), 0);
    for (std::uint64_t v = 0; v < element.count; ++v)
    {
      std::array<float, 3> p{};
      for (std::size_t n = 0; n < element.properties.size(); ++n)
      {
        const auto axis = std::find(place.begin(), place.end(), n);
        if (axis == place.end())
          skipProperty(element.properties[n]);
        else
          p[static_cast<std::size_t>(axis - place.begin())] =
              static_cast<float>(take(element.properties[n].type));
      }
      m_builder.addVertex(p[0], p[1], p[2]);
    }
  }

  void readFaces(const Element& element)
  {
    const auto isCorners = [](const Property& p)
    { return p.listCount && (p.name == "vertex_indices" || p.name == "vertex_index"); };
    if (std::none_of(element.properties.begin(), element.properties.end(), isCorners))
      m_builder.failUnreadable("its faces have no list vertex_indices");
    m_builder.reserve(0, static_cast<std::size_t>(element.count));
    std::vector<std::int64_t> corners;
    for (std::uint64_t f = 0; f < element.count; ++f)
      for (const Property& property : element.properties)
      {
        if (!isCorners(property))
        {
          skipProperty(property);
          continue;
        }
        corners.resize(static_cast<std::size_t>(takeLength(*property.listCount)));
        for (std::int64_t& corner : corners)
          corner = takeWhole(property.type, "a face has a corner that is not a vertex index");
        m_builder.addPolygon(corners);
      }
  }

  MeshBuilder m_builder;
  std::string_view m_rest;
  Encoding m_encoding = Encoding::Text;
  std::vector<Element> m_elements;
};

} // namespace

LoadedMesh parsePly(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress)
{
  return PlyParser(path, bytes, progress).parse();
}

} // namespace petrous::imaging
