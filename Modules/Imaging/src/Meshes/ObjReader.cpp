#include "MeshReaders.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kMaxKeyword = 16;

bool isKeyword(std::string_view word)
{
  return word.size() <= kMaxKeyword &&
         std::all_of(word.begin(), word.end(),
                     [](char c)
                     { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

/// The vertex of a corner "7", "7/1", "7/1/3" or "7//3"; negative numbers count back from the last
/// vertex read.
std::int64_t cornerOf(const MeshBuilder& builder, std::string_view word)
{
  const auto index = parseInteger(word.substr(0, word.find('/')));
  if (!index || *index == 0)
    builder.failUnreadable("a face has a corner that is not a vertex index");
  return *index > 0 ? *index - 1 : static_cast<std::int64_t>(builder.vertexCount()) + *index;
}

/// The next line; a backslash at its end continues it on the following one.
std::string_view takeRecord(std::string_view& rest, std::string& joined)
{
  std::string_view line = takeLine(rest);
  if (line.empty() || line.back() != '\\')
    return line;
  joined.clear();
  while (!line.empty() && line.back() == '\\')
  {
    joined += line.substr(0, line.size() - 1);
    joined += ' ';
    line = takeLine(rest);
  }
  joined += line;
  return joined;
}

} // namespace

LoadedMesh parseObj(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress)
{
  MeshBuilder builder(path, progress);
  std::string joined;
  std::vector<std::int64_t> corners;
  MeshObjects objects;
  MeshObjects groups;
  while (!bytes.empty())
  {
    builder.step();
    std::string_view line = takeRecord(bytes, joined);
    const std::string_view keyword = takeWord(line);
    if (keyword.empty() || keyword.front() == '#')
      continue;
    if (keyword == "v")
    {
      std::array<float, 3> p{};
      for (float& coordinate : p)
      {
        const auto value = parseFloat(takeWord(line));
        if (!value)
          builder.failUnreadable("a vertex has fewer than three numbers");
        coordinate = *value;
      }
      builder.addVertex(p[0], p[1], p[2]);
    }
    else if (keyword == "f")
    {
      corners.clear();
      for (auto word = takeWord(line); !word.empty(); word = takeWord(line))
        corners.push_back(cornerOf(builder, word));
      const std::size_t first = builder.triangleCount();
      builder.addPolygon(corners);
      objects.record(first, builder.triangleCount());
      groups.record(first, builder.triangleCount());
    }
    else if (keyword == "o")
      objects.begin(std::string(trimmed(line)));
    else if (keyword == "g")
      groups.begin(std::string(trimmed(line)));
    else if (!isKeyword(keyword))
      builder.failUnreadable("a line is not an OBJ record");
  }
  LoadedMesh loaded = builder.take();
  (objects.count() > 1 ? objects : groups).moveTo(loaded);
  return loaded;
}

} // namespace petrous::imaging
