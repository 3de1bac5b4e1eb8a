#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Imaging/MeshFile.h"

namespace petrous::imaging
{

/// Collects a mesh from a file and rejects invalid data: a non-finite vertex, or a corner with an
/// invalid vertex index. Throws FileError.
class MeshBuilder
{
public:
  explicit MeshBuilder(const std::filesystem::path& path, core::Progress progress = {});

  void reserve(std::size_t vertices, std::size_t triangles);
  void addVertex(float x, float y, float z);
  /// A polygon by its corners (from 0), triangulated as a fan from its first corner; degenerate
  /// triangles that use a vertex twice are skipped.
  void addPolygon(const std::vector<std::int64_t>& corners);
  /// Of a vertex, polygon or other record: throws CancelledError, once in many.
  void step() const
  {
    if (++m_steps % 65536 == 0)
      check();
  }
  void check() const { m_progress.check("reading mesh"); }
  std::size_t vertexCount() const noexcept { return m_mesh.vertices.size(); }
  std::size_t triangleCount() const noexcept { return m_mesh.triangles.size(); }
  [[noreturn]] void failUnreadable(const std::string& what) const;

  /// The mesh, as the file counts. Throws for one without triangles.
  LoadedMesh take();

private:
  std::filesystem::path m_path;
  core::Progress m_progress;
  mutable std::size_t m_steps = 0;
  core::TriangleMesh m_mesh;
};

/// Collects which triangles of a file are of which object. Only objects that have triangles count.
class MeshObjects
{
public:
  /// The triangles from here on are of the object of this name: of the one that has it already, or,
  /// if `isApart`, of another. Before the first they are of one without a name.
  void begin(std::string name, bool isApart = false);
  /// After a polygon: the triangles from `first` up to `end` are of the object that was begun.
  void record(std::size_t first, std::size_t end);
  std::size_t count() const noexcept { return m_names.size(); }

  /// `loaded`: of all triangles that were recorded, and no others.
  void moveTo(LoadedMesh& loaded);

private:
  struct Run
  {
    std::size_t first; // triangle
    std::uint32_t object;
  };
  std::string m_name;
  bool m_isBegun = true; // since the last triangle
  bool m_isApart = false;
  std::vector<std::string> m_names;
  std::unordered_map<std::string, std::uint32_t> m_known;
  std::vector<Run> m_runs;
};

// Of the table of formats: parsers of a whole file, and whole files in bytes.
LoadedMesh parseObj(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress);
LoadedMesh parseStl(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress);
LoadedMesh parsePly(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress);
LoadedMesh parseVtp(const std::filesystem::path& path, std::string_view bytes,
                    const core::Progress& progress);

std::string objText(const core::TriangleMesh& mesh, const MeshColor& color);
std::string stlBytes(const core::TriangleMesh& mesh, const MeshColor& color);
std::string plyBytes(const core::TriangleMesh& mesh, const MeshColor& color);

} // namespace petrous::imaging
