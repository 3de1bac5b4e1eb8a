#pragma once

#include <string>
#include <vector>

#include "petrous/Imaging/MeshFile.h"

namespace petrous::presenters
{

/// Remarks for the user on a surface whose volume or inside is not what its triangles say at first
/// sight: parts wound the other way, cavities, doubled triangles, parts that overlap.
std::vector<std::string> formNotes(const core::TriangleMesh& mesh);

/// A remark on a file of several objects that is taken as one structure; empty for other files. Of
/// the objects only names that are not a patient's are quoted (fileName).
std::string objectsNote(const imaging::LoadedMesh& loaded);

} // namespace petrous::presenters
