#include "petrous/Imaging/MeshFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "FileHelpers.h"
#include "MeshReaders.h"
#include "OutputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/FileFormats.h"

namespace petrous::imaging
{

namespace
{

// The comment or header that states the frame is near the start.
constexpr std::size_t kFrameWithin = 4096;
constexpr const char* kStatement = "Petrous surface. SPACE=LPS, unit mm";

template <class T>
void append(std::string& bytes, T value)
{
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// A vertex without triangle is not part of the surface, and must not affect its bounds.
void dropUnusedVertices(core::TriangleMesh& mesh)
{
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      place[corner] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] != kUnused)
    {
      mesh.vertices[kept] = mesh.vertices[v];
      place[v] = kept++;
    }
  if (kept == mesh.vertices.size())
    return;
  mesh.vertices.resize(kept);
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle)
      corner = place[corner];
}

} // namespace

std::string objText(const core::TriangleMesh& mesh, const MeshColor&)
{
  std::string text = "# " + std::string(kStatement) + "\n";
  for (const auto& v : mesh.vertices)
    text += "v " + exactText(v[0]) + " " + exactText(v[1]) + " " + exactText(v[2]) + "\n";
  for (const auto& t : mesh.triangles)
    text += "f " + std::to_string(t[0] + 1ULL) + " " + std::to_string(t[1] + 1ULL) + " " +
            std::to_string(t[2] + 1ULL) + "\n";
  return text;
}

std::string stlBytes(const core::TriangleMesh& mesh, const MeshColor&)
{
  std::string bytes(kStatement); // not "solid", which starts a text STL
  bytes.resize(80, ' ');
  bytes.reserve(84 + mesh.triangles.size() * 50);
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles)
  {
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[t[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[t[2]].cast<double>();
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    for (int n = 0; n < 3; ++n)
      append(bytes, static_cast<float>(normal[n]));
    for (const std::uint32_t corner : t)
      for (int n = 0; n < 3; ++n)
        append(bytes, mesh.vertices[corner][n]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string plyBytes(const core::TriangleMesh& mesh, const MeshColor& color)
{
  std::string rgb;
  for (std::size_t c = 0; color && c < 3; ++c)
    rgb += static_cast<char>(std::lround(std::clamp((*color)[c], 0.0F, 1.0F) * 255.0F));
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment " + std::string(kStatement) +
      "\nelement vertex " + std::to_string(mesh.vertices.size()) +
      "\nproperty float x\nproperty float y\nproperty float z" +
      (color ? "\nproperty uchar red\nproperty uchar green\nproperty uchar blue" : "") +
      "\nelement face " + std::to_string(mesh.triangles.size()) +
      "\nproperty list uchar uint vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + mesh.vertices.size() * (12 + rgb.size()) +
                mesh.triangles.size() * 13);
  for (const auto& v : mesh.vertices)
  {
    for (int n = 0; n < 3; ++n)
      append(bytes, v[n]);
    bytes += rgb;
  }
  for (const auto& t : mesh.triangles)
  {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : t)
      append(bytes, corner);
  }
  return bytes;
}

MeshBuilder::MeshBuilder(const std::filesystem::path& path, core::Progress progress)
  : m_path(path)
  , m_progress(std::move(progress))
{
}

void MeshBuilder::reserve(std::size_t vertices, std::size_t triangles)
{
  m_mesh.vertices.reserve(vertices);
  m_mesh.triangles.reserve(triangles);
}

void MeshBuilder::addVertex(float x, float y, float z)
{
  step();
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
    failUnreadable("a vertex has a coordinate that is not a number");
  if (m_mesh.vertices.size() >= std::numeric_limits<std::uint32_t>::max())
    failUnreadable("it has more vertices than can be numbered");
  m_mesh.vertices.emplace_back(x, y, z);
}

void MeshBuilder::addPolygon(const std::vector<std::int64_t>& corners)
{
  step();
  if (corners.size() < 3)
    failUnreadable("a face has fewer than three corners");
  std::array<std::uint32_t, 3> triangle{};
  const auto checked = [this](std::int64_t corner)
  {
    if (corner < 0 || corner >= static_cast<std::int64_t>(m_mesh.vertices.size()))
      failUnreadable("a face names a vertex that is not there");
    return static_cast<std::uint32_t>(corner);
  };
  triangle[0] = checked(corners[0]);
  triangle[2] = checked(corners[1]);
  for (std::size_t c = 2; c < corners.size(); ++c)
  {
    triangle[1] = triangle[2];
    triangle[2] = checked(corners[c]);
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      m_mesh.triangles.push_back(triangle);
  }
}

void MeshBuilder::failUnreadable(const std::string& what) const
{
  fail(FileError::Reason::Unreadable, m_path,
       "is damaged: " + what + "; export it again from where it came");
}

LoadedMesh MeshBuilder::take()
{
  if (m_mesh.triangles.empty())
    fail(FileError::Reason::Unsupported, m_path,
         "holds no triangle; a surface of at least one is needed");
  check();
  dropUnusedVertices(m_mesh);
  LoadedMesh loaded;
  loaded.mesh = std::move(m_mesh);
  return loaded;
}

void MeshObjects::begin(std::string name, bool isApart)
{
  m_name = std::move(name);
  m_isApart = isApart;
  m_isBegun = true;
}

void MeshObjects::record(std::size_t first, std::size_t end)
{
  if (!m_isBegun || first == end)
    return;
  m_isBegun = false;
  const auto next = static_cast<std::uint32_t>(m_names.size());
  std::uint32_t object = next;
  if (!m_isApart)
    object = m_known.try_emplace(m_name, next).first->second;
  if (object == next)
    m_names.push_back(m_name);
  m_runs.push_back({first, object});
}

void MeshObjects::moveTo(LoadedMesh& loaded)
{
  loaded.objects = std::move(m_names);
  loaded.objectOf.clear();
  if (loaded.objects.size() < 2)
    return;
  loaded.objectOf.resize(loaded.mesh.triangles.size());
  for (std::size_t r = 0; r < m_runs.size(); ++r)
  {
    const std::size_t end =
        r + 1 < m_runs.size() ? m_runs[r + 1].first : loaded.mesh.triangles.size();
    for (std::size_t t = m_runs[r].first; t < end; ++t)
      loaded.objectOf[t] = m_runs[r].object;
  }
}

LoadedMesh loadMesh(const std::filesystem::path& path, const std::optional<bool>& isRas,
                    const std::optional<double>& unit, const core::Progress& progress)
{
  checkedFileSize(path);
  const FileFormat* format = formatOf(path);
  if (!format || !format->parseMesh)
    fail(FileError::Reason::UnknownFormat, path,
         "is of no surface format that is read; give a " + orText(readEndings(kMesh)) + " file");
  checkFormat(path, format->name);
  const std::string bytes = readWholeFile(path, progress.part(0.0, 0.4));
  progress.report(0.4, "reading mesh");
  LoadedMesh loaded = format->parseMesh(path, bytes, progress);
  const std::string_view start = std::string_view(bytes).substr(0, kFrameWithin);
  const bool saysRas = start.find("SPACE=RAS") != start.npos;
  const bool saysLps = start.find("SPACE=LPS") != start.npos;
  if (saysRas && saysLps && !isRas)
    fail(FileError::Reason::NoGeometry, path,
         "states both SPACE=RAS and SPACE=LPS; remove the wrong statement");
  const bool saysFrame = saysRas || saysLps;
  loaded.isFrameStated = saysFrame;
  loaded.isUnitStated = start.find("unit mm") != start.npos;
  loaded.isFrameGiven = isRas.has_value();
  loaded.isUnitGiven = unit.has_value();
  loaded.space = {isRas.value_or(saysRas), unit.value_or(1.0)};
  const auto mm = static_cast<float>(loaded.space.mm);
  const float side = loaded.space.isRas ? -mm : mm;
  for (auto& v : loaded.mesh.vertices)
    v = {side * v[0], side * v[1], mm * v[2]};
  if (loaded.space.isRas)
    loaded.notes.emplace_back(std::string("is in RAS coordinates (") +
                              (saysRas ? "SPACE=RAS" : "as given") +
                              "); x and y were negated to the patient's LPS");
  if (saysFrame && loaded.space.isRas != saysRas)
    loaded.notes.emplace_back(std::string("states SPACE=") + (saysRas ? "RAS" : "LPS") +
                              ", and was read otherwise, as given");
  if (mm != 1.0F)
    loaded.notes.emplace_back("has a unit of " + core::plainText(*unit) +
                              " mm, as given; brought to mm");
  return loaded;
}

std::vector<core::TriangleMesh> splitByObject(const LoadedMesh& loaded)
{
  if (loaded.objectOf.empty())
    return {loaded.mesh};
  const core::TriangleMesh& whole = loaded.mesh;
  std::vector<core::TriangleMesh> parts(loaded.objects.size());
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    parts[loaded.objectOf[t]].triangles.push_back(whole.triangles[t]);
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(whole.vertices.size(), kUnused); // in the part
  std::vector<std::uint32_t> used;                                  // by the part
  for (core::TriangleMesh& part : parts)
  {
    for (auto& triangle : part.triangles)
      for (std::uint32_t& corner : triangle)
      {
        if (place[corner] == kUnused)
        {
          place[corner] = static_cast<std::uint32_t>(used.size());
          used.push_back(corner);
        }
        corner = place[corner];
      }
    part.vertices.reserve(used.size());
    for (const std::uint32_t vertex : used)
    {
      part.vertices.push_back(whole.vertices[vertex]);
      place[vertex] = kUnused;
    }
    used.clear();
  }
  return parts;
}

std::size_t objectCount(const std::filesystem::path& path, const core::Progress& progress)
{
  const FileFormat* format = formatOf(path);
  if (format && format->parseMesh == parseStl)
  {
    constexpr std::uintmax_t kFirstWord = 512; // bytes that hold it
    const std::string start = readBytes(path, kFirstWord);
    std::string_view rest = start;
    if (takeWord(rest) != "solid")
      return 1;
  }
  else if (format && format->parseMesh && format->parseMesh != parseObj)
    return 1;
  return std::max<std::size_t>(loadMesh(path, std::nullopt, std::nullopt, progress).objects.size(),
                               1);
}

core::TriangleMesh readMesh(const std::filesystem::path& path)
{
  return loadMesh(path).mesh;
}

void writeMesh(const std::filesystem::path& path, const core::TriangleMesh& mesh,
               const MeshColor& color)
{
  mesh.validate();
  if (mesh.triangles.empty())
    throw core::InvalidParameter("mesh: it has no triangle to write");
  const FileFormat& format = writingFormat(path, kMesh);
  OutputFile file(path);
  file.write(format.meshBytes(mesh, color));
  file.commit();
}

} // namespace petrous::imaging
