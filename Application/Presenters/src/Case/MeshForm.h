#pragma once

#include <string>
#include <vector>

#include "petrous/Imaging/MeshFile.h"

namespace petrous::presenters
{

/// Remarks for the user on a surface whose volume or inside is not what its triangles say at first
/// sight: parts wound the other way, cavities, doubled triangles, parts that overlap, and several
/// objects in one file. Of the objects only names that are not a patient's are quoted (fileName).
std::vector<std::string> formNotes(const imaging::LoadedMesh& loaded);

} // namespace petrous::presenters
