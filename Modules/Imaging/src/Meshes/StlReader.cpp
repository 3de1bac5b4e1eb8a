#include "MeshReaders.h"

#include <array>
#include <cstring>
#include <string>
#include <unordered_map>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kPrefixBytes = kHeaderBytes + 4;
constexpr std::size_t kFacetBytes = 50; // normal, three corners, attribute

using Point = std::array<float, 3>;

struct PointHash
{
  std::size_t operator()(const Point& p) const noexcept
  {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy(bits.data(), p.data(), sizeof bits);
    std::uint64_t hash = bits[0];
    hash = hash * 0x9E3779B97F4A7C15U + bits[1];
    hash = hash * 0x9E3779B97F4A7C15U + bits[2];
    return static_cast<std::size_t>(hash ^ (hash >> 29));
  }
};

/// Merges coincident corners. STL repeats each vertex for every facet.
class Merger
{
public:
  explicit Merger(MeshBuilder& builder)
    : m_builder(builder)
  {
  }

  std::int64_t indexOf(Point p)
  {
    for (float& c : p)
      c += 0.0F; // -0 is 0
    const auto next = static_cast<std::int64_t>(m_builder.vertexCount());
    const auto [at, isNew] = m_known.try_emplace(p, next);
    if (isNew)
      m_builder.addVertex(p[0], p[1], p[2]);
    return at->second;
  }

private:
  MeshBuilder& m_builder;
  std::unordered_map<Point, std::int64_t, PointHash> m_known;
};

// Some writers start the binary header with "solid" too, so the size decides.
bool isBinary(std::string_view bytes)
{
  std::uint32_t facets = 0;
  if (bytes.size() < kPrefixBytes)
    return false;
  std::memcpy(&facets, bytes.data() + kHeaderBytes, sizeof facets);
  return bytes.size() == kPrefixBytes + std::uint64_t{facets} * kFacetBytes;
}

LoadedMesh parseBinary(const std::filesystem::path& path, std::string_view bytes,
                       std::size_t facets, const core::Progress& progress)
{
  MeshBuilder builder(path, progress);
  builder.reserve(facets / 2, facets);
  Merger merger(builder);
  std::vector<std::int64_t> corners(3);
  for (std::size_t f = 0; f < facets; ++f)
  {
    std::array<Point, 4> facet{}; // the normal comes first; ignored, as it follows from the corners
    std::memcpy(facet.data(), bytes.data() + kPrefixBytes + f * kFacetBytes, sizeof facet);
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = merger.indexOf(facet[c + 1]);
    builder.addPolygon(corners);
  }
  return builder.take();
}

LoadedMesh parseText(const std::filesystem::path& path, std::string_view bytes,
                     const core::Progress& progress)
{
  MeshBuilder builder(path, progress);
  Merger merger(builder);
  std::vector<std::int64_t> corners;
  MeshObjects solids;
  bool closed = false;
  while (!bytes.empty())
  {
    builder.step();
    std::string_view line = takeLine(bytes);
    const std::string_view word = takeWord(line);
    if (word == "vertex")
    {
      Point p{};
      for (float& coordinate : p)
      {
        const auto value = parseFloat(takeWord(line));
        if (!value)
          builder.failUnreadable("a vertex has fewer than three numbers");
        coordinate = *value;
      }
      corners.push_back(merger.indexOf(p));
    }
    else if (word == "endloop")
    {
      if (corners.size() != 3)
        builder.failUnreadable("a facet has not three corners");
      const std::size_t first = builder.triangleCount();
      builder.addPolygon(corners);
      solids.record(first, builder.triangleCount());
      corners.clear();
    }
    else if (word == "solid" || word == "endsolid")
    {
      closed = word == "endsolid";
      if (!closed)
        solids.begin(std::string(trimmed(line)),
                     true); // solids are apart even if they share a name
    }
    else if (!word.empty() && word != "facet" && word != "outer" && word != "endfacet")
      builder.failUnreadable("a line does not belong to an ASCII STL");
  }
  if (!closed || !corners.empty())
    builder.failUnreadable("it breaks off before 'endsolid'");
  LoadedMesh loaded = builder.take();
  solids.moveTo(loaded);
  return loaded;
}

} // namespace

LoadedMesh parseStl(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress)
{
  std::uint32_t facets = 0;
  if (bytes.size() >= kPrefixBytes)
    std::memcpy(&facets, bytes.data() + kHeaderBytes, sizeof facets);
  if (isBinary(bytes))
    return parseBinary(path, bytes, facets, progress);
  std::string_view rest = bytes;
  if (takeWord(rest) == "solid")
    return parseText(path, bytes, progress);
  fail(FileError::Reason::Unreadable, path,
       "is " + std::to_string(bytes.size()) + " bytes long, but an STL of the " +
           std::to_string(facets) + " triangles that it counts has " +
           std::to_string(kPrefixBytes + std::uint64_t{facets} * kFacetBytes) +
           "; copy it again from where it came");
}

} // namespace petrous::imaging
