#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Imaging/FileError.h"

namespace petrous::imaging
{

struct LoadedMesh
{
  core::TriangleMesh mesh;
  std::vector<std::string> notes; ///< what was assumed or changed, one sentence each
};

/// Whether the name ends in .obj, .stl or .ply (upper or lower case).
bool isMeshFileName(const std::filesystem::path& path);

/// Reads a surface from OBJ, STL (text or binary) or PLY (text or binary).
///
/// Coordinates are taken as patient LPS mm, unless a comment or header says "SPACE=RAS" (as
/// 3D Slicer writes): then x and y are negated, and that is noted. Polygons are cut into
/// triangles; equal STL corners become one vertex.
///
/// Throws FileError: Unreadable for a damaged file and for counts that its size cannot hold,
/// Unsupported for a file without triangles.
LoadedMesh loadMesh(const std::filesystem::path& path);

/// As loadMesh, without the notes.
core::TriangleMesh readMesh(const std::filesystem::path& path);

/// Writes .obj, .stl or .ply (both binary, little endian) in patient LPS mm, and says so inside.
/// The file appears whole or not at all, and equal meshes give equal bytes.
/// Throws FileError; InvalidParameter when the mesh is empty or not valid.
void writeMesh(const std::filesystem::path& path, const core::TriangleMesh& mesh);

} // namespace petrous::imaging
