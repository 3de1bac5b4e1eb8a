#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Imaging/FileError.h"

namespace petrous::imaging
{

/// How the coordinates of a surface file count.
struct MeshSpace
{
  bool isRas = false; ///< to the patient's right and front; false: LPS, to the left and back
  double mm = 1.0;    ///< of a unit
};

struct LoadedMesh
{
  core::TriangleMesh mesh;        ///< LPS, mm
  std::vector<std::string> notes; ///< what was assumed or changed, one sentence each
  bool isFrameStated = false;     ///< by the file
  bool isUnitStated = false;      ///< the same
  bool isFrameGiven = false;      ///< by the caller, whatever the file states
  bool isUnitGiven = false;       ///< the same
  MeshSpace space;                ///< how it counts, as stated or given
  /// Names of the objects (OBJ: o, or else g; text STL: solid) that have triangles, in the order of
  /// the file; an object without a name has an empty one. They may identify the patient.
  std::vector<std::string> objects;
  /// Of each triangle: its object, an index into `objects`; empty unless there are several.
  std::vector<std::uint32_t> objectOf;
};

/// Reads a surface from OBJ, STL (text or binary), PLY (text or binary) or VTP (VTK XML PolyData:
/// text, binary or appended, compressed or not; polygons and strips).
///
/// Coordinates are taken as patient LPS mm unless a comment or header says "SPACE=RAS" (as written
/// by 3D Slicer): then x and y are negated, which is noted. `isRas` and `unit`
/// (mm), if given, override that. Polygons are triangulated; coincident
/// STL corners become one vertex.
///
/// Throws FileError: Unreadable for a damaged file and for counts that exceed the file size,
/// Unsupported for a file without triangles. CancelledError.
LoadedMesh loadMesh(const std::filesystem::path& path,
                    const std::optional<bool>& isRas = std::nullopt,
                    const std::optional<double>& unit = std::nullopt,
                    const core::Progress& progress = {});

/// The objects of a file that holds several, in the order of LoadedMesh::objects: each with its
/// triangles in their order, and the vertices that it uses, numbered anew. Of a file of one object
/// the mesh as it is.
std::vector<core::TriangleMesh> splitByObject(const LoadedMesh& loaded);

/// How many objects loadMesh finds in a file, at least 1. Of formats that hold no more (PLY, VTP,
/// binary STL) the file is not read. Throws as loadMesh does.
std::size_t objectCount(const std::filesystem::path& path, const core::Progress& progress = {});

/// Like loadMesh, without the notes.
core::TriangleMesh readMesh(const std::filesystem::path& path);

/// sRGB of a surface, 0 to 1.
using MeshColor = std::optional<std::array<float, 3>>;

/// Writes .obj, .stl or .ply (the latter two binary, little endian) in patient LPS mm, and states
/// frame and unit in the file; the colour, if given, in .ply, one of 8 bits a vertex. The file is
/// written atomically, and equal meshes give equal bytes. Throws FileError; InvalidParameter if the
/// mesh is empty or invalid.
void writeMesh(const std::filesystem::path& path, const core::TriangleMesh& mesh,
               const MeshColor& color = std::nullopt);

} // namespace petrous::imaging
