#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
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
  [[noreturn]] void failUnreadable(const std::string& what) const;

  /// Throws for a mesh without triangles.
  core::TriangleMesh take();

private:
  std::filesystem::path m_path;
  core::Progress m_progress;
  mutable std::size_t m_steps = 0;
  core::TriangleMesh m_mesh;
};

// Of the table of formats: parsers of a whole file, and whole files in bytes.
core::TriangleMesh parseObj(const std::filesystem::path& path, std::string_view bytes,
                            const core::Progress& progress);
core::TriangleMesh parseStl(const std::filesystem::path& path, std::string_view bytes,
                            const core::Progress& progress);
core::TriangleMesh parsePly(const std::filesystem::path& path, std::string_view bytes,
                            const core::Progress& progress);
core::TriangleMesh parseVtp(const std::filesystem::path& path, std::string_view bytes,
                            const core::Progress& progress);

/// Of a file that parses: names of the objects that have triangles, each once.
std::vector<std::string> objObjects(std::string_view bytes);
std::vector<std::string> stlObjects(std::string_view bytes); // of a binary one none

std::string objText(const core::TriangleMesh& mesh, const MeshColor& color);
std::string stlBytes(const core::TriangleMesh& mesh, const MeshColor& color);
std::string plyBytes(const core::TriangleMesh& mesh, const MeshColor& color);

} // namespace petrous::imaging
