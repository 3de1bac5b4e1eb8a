#include "MeshReaders.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

#include <expat.h>
#include <lz4.h>
#include <lzma.h>
#include <zlib.h>

#include "FileHelpers.h"

// VTK XML PolyData: elements and attributes as in "VTK File Formats" (vtk.org, "XML File Formats"),
// headers of binary arrays as vtkXMLDataParser reads them.
namespace petrous::imaging
{

namespace
{

/// A DataArray element that makes up the surface: where its numbers are and how they are written.
struct Array
{
  std::string name; ///< as errors call it
  std::string type;
  std::string format;
  std::uint64_t components = 1;
  std::uint64_t offset = 0; ///< into the appended data
  std::string text;         ///< of the element
  bool isThere = false;
};

struct Cells
{
  std::uint64_t count = 0;
  Array connectivity;
  Array offsets;
};

struct Piece
{
  std::uint64_t pointCount = 0;
  Array points;
  Cells polys;
  Cells strips;
};

/// What the XML states.
struct Document
{
  std::vector<Piece> pieces;
  std::string compressor;
  bool isBigEndian = false;
  std::size_t headerBytes = 4; ///< of a number in the header of a binary array
  bool isAppendedBase64 = false;
  std::string_view appended; ///< after its underscore
  std::string problem;
};

bool parseCount(const char* text, std::uint64_t& count)
{
  const char* end = text + std::strlen(text);
  const auto [rest, fault] = std::from_chars(text, end, count);
  return fault == std::errc() && rest == end;
}

/// Reads the elements with Expat up to the appended data, which may be no XML.
class XmlReader
{
public:
  explicit XmlReader(std::string_view bytes)
    : m_bytes(bytes)
    , m_parser(XML_ParserCreate(nullptr), &XML_ParserFree)
  {
    if (!m_parser)
      throw std::bad_alloc();
    XML_SetUserData(m_parser.get(), this);
    XML_SetElementHandler(
        m_parser.get(),
        [](void* self, const XML_Char* name, const XML_Char** attributes)
        { static_cast<XmlReader*>(self)->start(name, attributes); },
        [](void* self, const XML_Char*) { static_cast<XmlReader*>(self)->end(); });
    XML_SetCharacterDataHandler(m_parser.get(), [](void* self, const XML_Char* text, int length)
                                { static_cast<XmlReader*>(self)->characters(text, length); });
    // Entities are declared in a document type, which no such file has.
    XML_SetStartDoctypeDeclHandler(
        m_parser.get(), [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int)
        { static_cast<XmlReader*>(self)->stop("it declares a document type"); });
  }

  Document read(const MeshBuilder& builder)
  {
    constexpr std::size_t kStep = 1 << 24; // lengths are int
    for (std::size_t at = 0; !m_isStopped; at += kStep)
    {
      builder.check();
      const bool isLast = m_bytes.size() - at <= kStep;
      const std::string_view part = m_bytes.substr(at, kStep);
      if (XML_Parse(m_parser.get(), part.data(), static_cast<int>(part.size()), isLast) ==
              XML_STATUS_ERROR &&
          !m_isStopped)
        m_document.problem = "it is no well-formed XML";
      if (isLast || !m_document.problem.empty())
        break;
    }
    if (m_document.problem.empty() && !m_isPolyData)
      m_document.problem = "it is no surface of the VTK XML format";
    return std::move(m_document);
  }

private:
  void stop(const std::string& problem)
  {
    if (m_isStopped)
      return;
    m_isStopped = true;
    m_document.problem = problem;
    XML_StopParser(m_parser.get(), XML_FALSE);
  }

  static const char* find(const XML_Char** attributes, const char* name)
  {
    for (; *attributes; attributes += 2)
      if (std::strcmp(*attributes, name) == 0)
        return attributes[1];
    return nullptr;
  }

  static std::string textOf(const XML_Char** attributes, const char* name)
  {
    const char* value = find(attributes, name);
    return value ? value : "";
  }

  /// Leaves the value as it is if the attribute is not there.
  void readCount(const XML_Char** attributes, const char* name, std::uint64_t& value)
  {
    const char* text = find(attributes, name);
    if (text && !parseCount(text, value))
      stop(std::string("its ") + name + " is no number");
  }

  void start(const std::string& name, const XML_Char** attributes)
  {
    m_array = nullptr;
    m_path.push_back(name);
    const std::size_t depth = m_path.size();
    if (depth == 1)
      readRoot(name, attributes);
    else if (depth == 2 && name == "AppendedData")
      readAppended(attributes);
    else if (depth == 3 && name == "Piece" && m_path[1] == "PolyData")
    {
      Piece& piece = m_document.pieces.emplace_back();
      readCount(attributes, "NumberOfPoints", piece.pointCount);
      readCount(attributes, "NumberOfPolys", piece.polys.count);
      readCount(attributes, "NumberOfStrips", piece.strips.count);
    }
    else if (depth == 5 && name == "DataArray" && m_path[2] == "Piece" && m_path[1] == "PolyData")
      readArray(attributes);
  }

  void readRoot(const std::string& name, const XML_Char** attributes)
  {
    m_isPolyData = name == "VTKFile" && textOf(attributes, "type") == "PolyData";
    if (!m_isPolyData)
      return stop("it is no surface of the VTK XML format");
    const std::string version = textOf(attributes, "version");
    if (!version.empty() && version[0] > '2')
      return stop("it is of version " + version + " of the VTK XML format; 0.1 to 2 are read");
    const std::string order = textOf(attributes, "byte_order");
    const std::string header = textOf(attributes, "header_type");
    m_document.isBigEndian = order == "BigEndian";
    if (!order.empty() && !m_document.isBigEndian && order != "LittleEndian")
      return stop("its byte_order is neither LittleEndian nor BigEndian");
    m_document.headerBytes = header == "UInt64" ? 8 : 4;
    if (!header.empty() && header != "UInt64" && header != "UInt32")
      return stop("its header_type is neither UInt32 nor UInt64");
    m_document.compressor = textOf(attributes, "compressor");
  }

  void readAppended(const XML_Char** attributes)
  {
    m_document.isAppendedBase64 = textOf(attributes, "encoding") == "base64";
    const auto tag = static_cast<std::size_t>(XML_GetCurrentByteIndex(m_parser.get()));
    const std::size_t close = m_bytes.find('>', tag);
    const std::size_t first =
        close == m_bytes.npos ? close : m_bytes.find_first_not_of(" \t\r\n", close + 1);
    if (first == m_bytes.npos || m_bytes[first] != '_')
      return stop("its appended data do not begin with an underscore");
    m_document.appended = m_bytes.substr(first + 1);
    stop(""); // no XML any more
  }

  void readArray(const XML_Char** attributes)
  {
    if (m_document.pieces.empty())
      return;
    Piece& piece = m_document.pieces.back();
    const std::string& group = m_path[3];
    const std::string name = textOf(attributes, "Name");
    Array* array = nullptr;
    if (group == "Points")
      array = &piece.points;
    else if (group == "Polys" || group == "Strips")
    {
      Cells& cells = group == "Polys" ? piece.polys : piece.strips;
      array = name == "connectivity" ? &cells.connectivity
              : name == "offsets"    ? &cells.offsets
                                     : nullptr;
    }
    if (!array)
      return;
    array->name = group == "Points" ? group : group + " " + name;
    if (array->isThere)
      return stop("the array " + array->name + " is there twice; one time step is read");
    array->isThere = true;
    array->type = textOf(attributes, "type");
    array->format = textOf(attributes, "format");
    readCount(attributes, "NumberOfComponents", array->components);
    readCount(attributes, "offset", array->offset);
    m_array = array;
    m_arrayDepth = m_path.size();
  }

  void characters(const XML_Char* text, int length)
  {
    if (m_array && m_path.size() == m_arrayDepth)
      m_array->text.append(text, static_cast<std::size_t>(length));
  }

  void end()
  {
    m_path.pop_back();
    m_array = nullptr;
  }

  std::string_view m_bytes;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> m_parser;
  Document m_document;
  std::vector<std::string> m_path;
  Array* m_array = nullptr; ///< whose text is being read
  std::size_t m_arrayDepth = 0;
  bool m_isPolyData = false;
  bool m_isStopped = false;
};

/// The bytes of a binary array, one after the other; in base64 (RFC 4648) the header and the
/// blocks may each be padded.
class ByteReader
{
public:
  ByteReader(std::string_view text, bool isBase64)
    : m_text(text)
    , m_isBase64(isBase64)
  {
  }

  /// No more than that are left.
  std::uint64_t most() const
  {
    return m_isBase64 ? m_text.size() / 4 * 3 + m_held.size() : m_text.size();
  }

  bool read(char* to, std::size_t count)
  {
    if (count > most())
      return false;
    if (!m_isBase64)
    {
      std::copy_n(m_text.data(), count, to);
      m_text.remove_prefix(count);
      return true;
    }
    for (std::size_t n = 0; n < count; ++n)
    {
      if (m_held.empty() && !decodeFour())
        return false;
      to[n] = m_held.front();
      m_held.remove_prefix(1);
    }
    return true;
  }

private:
  bool decodeFour()
  {
    std::uint32_t bits = 0;
    std::size_t digits = 0;
    std::size_t padding = 0;
    while (digits + padding < 4)
    {
      if (m_text.empty())
        return false;
      const char c = m_text.front();
      m_text.remove_prefix(1);
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        continue;
      if (c == '=' && digits >= 2)
      {
        ++padding;
        bits <<= 6;
        continue;
      }
      const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                        : c >= 'a' && c <= 'z' ? c - 'a' + 26
                        : c >= '0' && c <= '9' ? c - '0' + 52
                        : c == '+'             ? 62
                        : c == '/'             ? 63
                                               : -1;
      if (digit < 0 || padding > 0)
        return false;
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
      ++digits;
    }
    for (std::size_t n = 0; n < 3; ++n)
      m_three[n] = static_cast<char>(bits >> (16 - 8 * n) & 0xFF);
    m_held = std::string_view(m_three.data(), 3 - padding);
    return true;
  }

  std::string_view m_text;
  bool m_isBase64;
  std::array<char, 3> m_three{};
  std::string_view m_held; ///< decoded, not yet read
};

bool unpackZlib(const std::string& packed, char* to, std::size_t count)
{
  uLongf size = count;
  return uncompress(reinterpret_cast<Bytef*>(to), &size,
                    reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
         size == count;
}

bool unpackLz4(const std::string& packed, char* to, std::size_t count)
{
  constexpr std::size_t kMost = LZ4_MAX_INPUT_SIZE;
  return packed.size() <= kMost && count <= kMost &&
         LZ4_decompress_safe(packed.data(), to, static_cast<int>(packed.size()),
                             static_cast<int>(count)) == static_cast<int>(count);
}

bool unpackLzma(const std::string& packed, char* to, std::size_t count)
{
  std::uint64_t memory = 128ULL << 20; // the highest preset takes 65 MiB
  std::size_t in = 0;
  std::size_t out = 0;
  return lzma_stream_buffer_decode(
             &memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &in,
             packed.size(), reinterpret_cast<std::uint8_t*>(to), &out, count) == LZMA_OK &&
         out == count;
}

struct Compressor
{
  const char* name;
  bool (*unpack)(const std::string& packed, char* to, std::size_t count);
  std::uint64_t mostPerByte; ///< that a packed byte can become
};

constexpr std::array<Compressor, 3> kCompressors{{
    {"vtkZLibDataCompressor", unpackZlib, 1032}, // RFC 1951: 258 bytes of two bits
    {"vtkLZ4DataCompressor", unpackLz4, 255},    // a length grows by 255 a byte
    {"vtkLZMADataCompressor", unpackLzma, 10000},
}};

template <class Stored, class T>
void convert(const std::string& bytes, bool isBigEndian, std::vector<T>& values)
{
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Stored))
  {
    std::array<char, sizeof(Stored)> one;
    std::copy_n(bytes.data() + at, one.size(), one.begin());
    if (isBigEndian)
      std::reverse(one.begin(), one.end());
    Stored value;
    std::memcpy(&value, one.data(), one.size());
    values.push_back(static_cast<T>(value));
  }
}

/// The numbers of an array, each count and size held against what the file can hold before memory
/// is taken for it.
class ArrayReader
{
public:
  ArrayReader(const Document& document, const MeshBuilder& builder)
    : m_document(document)
    , m_builder(builder)
  {
  }

  /// Coordinates (T is double) or indices (std::int64_t); exactly `count` of them.
  template <class T>
  std::vector<T> read(const Array& array, std::uint64_t components, std::uint64_t tuples) const
  {
    if (!array.isThere)
      m_builder.failUnreadable("points or faces are stated without the array that holds them");
    if (array.components != components)
      fail(array, "has " + std::to_string(array.components) + " components instead of " +
                      std::to_string(components));
    constexpr std::uint64_t kMost = 1ULL << 40;
    if (tuples > kMost)
      fail(array, "is stated with more numbers than it can hold");
    const std::uint64_t count = tuples * components;
    if (array.format == "ascii")
      return readText<T>(array, count);

    using Convert = void (*)(const std::string&, bool, std::vector<T>&);
    struct Type
    {
      const char* name;
      std::size_t bytes;
      Convert convert;
    };
    // An index of 64 bits without sign beyond the greatest with sign becomes negative, and is
    // refused as one.
    constexpr std::array<Type, 10> kTypes{{{"Int8", 1, convert<std::int8_t, T>},
                                           {"UInt8", 1, convert<std::uint8_t, T>},
                                           {"Int16", 2, convert<std::int16_t, T>},
                                           {"UInt16", 2, convert<std::uint16_t, T>},
                                           {"Int32", 4, convert<std::int32_t, T>},
                                           {"UInt32", 4, convert<std::uint32_t, T>},
                                           {"Int64", 8, convert<std::int64_t, T>},
                                           {"UInt64", 8, convert<std::uint64_t, T>},
                                           {"Float32", 4, nullptr},
                                           {"Float64", 8, nullptr}}};
    const auto* type = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&array](const Type& t) { return array.type == t.name; });
    Convert convertTo = type == kTypes.end() ? nullptr : type->convert;
    if constexpr (std::is_floating_point_v<T>)
      if (type != kTypes.end() && !convertTo)
        convertTo = type->bytes == 4 ? Convert(convert<float, T>) : Convert(convert<double, T>);
    if (!convertTo)
      fail(array,
           std::is_integral_v<T> ? "is not of integer numbers" : "is of a type that is no number");
    const std::string bytes = readBytes(array, count * type->bytes);
    std::vector<T> values;
    values.reserve(count);
    convertTo(bytes, m_document.isBigEndian, values);
    return values;
  }

private:
  [[noreturn]] void fail(const Array& array, const std::string& what) const
  {
    m_builder.failUnreadable("its array " + array.name + " " + what);
  }

  template <class T>
  std::vector<T> readText(const Array& array, std::uint64_t count) const
  {
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    const char* at = array.text.data();
    const char* const end = at + array.text.size();
    if (count > array.text.size())
      fail(array, "is stated with more numbers than it can hold");
    std::vector<T> values;
    values.reserve(count);
    while ((at = std::find_if_not(at, end, isSpace)) != end)
    {
      m_builder.step();
      T value{};
      const auto [rest, fault] = std::from_chars(at, end, value);
      if (fault != std::errc() || (rest != end && !isSpace(*rest)))
        fail(array, "holds a word that is no number");
      if (values.size() == count)
        fail(array, "holds more than the " + std::to_string(count) + " numbers stated");
      values.push_back(value);
      at = rest;
    }
    if (values.size() != count)
      fail(array, "holds " + std::to_string(values.size()) + " of the " + std::to_string(count) +
                      " numbers stated");
    return values;
  }

  std::uint64_t readWord(const Array& array, ByteReader& from) const
  {
    std::array<char, 8> bytes{};
    if (!from.read(bytes.data(), m_document.headerBytes))
      fail(array, "ends within its header");
    std::uint64_t word = 0;
    for (std::size_t n = 0; n < m_document.headerBytes; ++n)
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[n]))
              << 8 * (m_document.isBigEndian ? m_document.headerBytes - 1 - n : n);
    return word;
  }

  std::string readBytes(const Array& array, std::uint64_t needed) const
  {
    const bool isAppended = array.format == "appended";
    if (!isAppended && array.format != "binary")
      fail(array, "is of no format of the VTK XML format (ascii, binary, appended)");
    if (isAppended && array.offset >= m_document.appended.size())
      fail(array, "lies after the end of the appended data");
    ByteReader from(isAppended ? m_document.appended.substr(array.offset)
                               : std::string_view(array.text),
                    isAppended ? m_document.isAppendedBase64 : true);
    if (!m_document.compressor.empty())
      return readBlocks(array, from, needed);
    if (const std::uint64_t length = readWord(array, from); length != needed)
      fail(array, "states " + std::to_string(length) + " bytes, its points or faces take " +
                      std::to_string(needed));
    if (needed > from.most())
      fail(array, "states more bytes than the file holds");
    constexpr std::size_t kPart = std::size_t{1} << 20;
    std::string bytes(needed, '\0');
    for (std::size_t at = 0; at < needed; at += kPart)
    {
      m_builder.check();
      if (!from.read(bytes.data() + at, std::min(kPart, needed - at)))
        fail(array, "ends too early");
    }
    return bytes;
  }

  std::string readBlocks(const Array& array, ByteReader& from, std::uint64_t needed) const
  {
    const auto* compressor =
        std::find_if(kCompressors.begin(), kCompressors.end(),
                     [this](const Compressor& c) { return m_document.compressor == c.name; });
    if (compressor == kCompressors.end())
      fail(array, "is compressed in a way that is not read; zlib, LZ4 and LZMA are");
    const std::uint64_t blocks = readWord(array, from);
    const std::uint64_t blockBytes = readWord(array, from);
    const std::uint64_t lastBytes = readWord(array, from); // 0: the last is as long as the others
    if (blocks > from.most() / m_document.headerBytes)
      fail(array, "states more blocks than the file holds");
    const std::uint64_t whole = lastBytes > 0 && blocks > 0 ? blocks - 1 : blocks;
    if (lastBytes > needed || (whole > 0 && blockBytes > needed / whole) ||
        whole * blockBytes + (whole < blocks ? lastBytes : 0) != needed)
      fail(array, "states blocks of another length than its points or faces take");
    std::vector<std::uint64_t> sizes(blocks);
    std::uint64_t held = 0;
    for (std::uint64_t& size : sizes)
    {
      size = readWord(array, from);
      if (size > from.most() || (held += size) > from.most() + sizes.size() * 8)
        fail(array, "states a block longer than the file");
    }
    if (needed > compressor->mostPerByte * held)
      fail(array, "states more bytes than its blocks can hold");
    std::string bytes;
    std::string packed;
    for (std::size_t n = 0; n < sizes.size(); ++n)
    {
      m_builder.check();
      const std::size_t count = n < whole ? blockBytes : lastBytes;
      packed.resize(sizes[n]);
      if (!from.read(packed.data(), packed.size()))
        fail(array, "ends too early");
      if (count > compressor->mostPerByte * packed.size())
        fail(array, "states a block longer than what it unpacks to");
      const std::unique_ptr<char[]> block(new char[count]); // not touched before it is written
      if (!compressor->unpack(packed, block.get(), count))
        fail(array, "has a block that does not unpack to the length stated");
      bytes.append(block.get(), count);
    }
    return bytes;
  }

  const Document& m_document;
  const MeshBuilder& m_builder;
};

/// Calls visit(corners) for each cell, the corners counted from the first point of the file.
template <class Visit>
void forEachCell(const Cells& cells, std::uint64_t firstPoint, std::uint64_t pointCount,
                 const ArrayReader& arrays, const MeshBuilder& builder, const Visit& visit)
{
  if (cells.count == 0)
    return;
  const auto offsets = arrays.read<std::int64_t>(cells.offsets, 1, cells.count);
  std::int64_t before = 0;
  for (const std::int64_t offset : offsets)
  {
    if (offset < before)
      builder.failUnreadable("its array " + cells.offsets.name + " does not rise");
    before = offset;
  }
  const auto corners =
      arrays.read<std::int64_t>(cells.connectivity, 1, static_cast<std::uint64_t>(before));
  std::vector<std::int64_t> cell;
  std::int64_t corner = 0;
  for (const std::int64_t end : offsets)
  {
    cell.clear();
    for (; corner < end; ++corner)
    {
      if (corners[corner] < 0 || static_cast<std::uint64_t>(corners[corner]) >= pointCount)
        builder.failUnreadable("its array " + cells.connectivity.name +
                               " names a point that is not there");
      cell.push_back(corners[corner] + static_cast<std::int64_t>(firstPoint));
    }
    visit(cell);
  }
}

} // namespace

LoadedMesh parseVtp(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress)
try
{
  MeshBuilder builder(path, progress);
  const Document document = XmlReader(bytes).read(builder);
  if (!document.problem.empty())
    builder.failUnreadable(document.problem);
  const ArrayReader arrays(document, builder);
  for (const Piece& piece : document.pieces)
  {
    const std::size_t first = builder.vertexCount();
    if (piece.pointCount == 0)
      continue;
    const auto points = arrays.read<double>(piece.points, 3, piece.pointCount);
    for (std::size_t n = 0; n < points.size(); n += 3)
      builder.addVertex(static_cast<float>(points[n]), static_cast<float>(points[n + 1]),
                        static_cast<float>(points[n + 2]));
    forEachCell(piece.polys, first, piece.pointCount, arrays, builder,
                [&builder](const std::vector<std::int64_t>& cell) { builder.addPolygon(cell); });
    forEachCell(piece.strips, first, piece.pointCount, arrays, builder,
                [&builder](const std::vector<std::int64_t>& cell)
                {
                  if (cell.size() < 3)
                    builder.failUnreadable("a strip has fewer than three corners");
                  for (std::size_t n = 2; n < cell.size(); ++n) // every other one is turned
                    builder.addPolygon(n % 2 == 0 ? std::vector{cell[n - 2], cell[n - 1], cell[n]}
                                                  : std::vector{cell[n - 1], cell[n - 2], cell[n]});
                });
  }
  return builder.take();
}
catch (const std::bad_alloc&)
{
  fail(FileError::Reason::Unreadable, path, "takes more memory than there is");
}

} // namespace petrous::imaging
