#pragma once

#include <string>
#include <vector>

#include "petrous/Dissection/ExposedArea.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// How much of a structure's surface the drilling has laid open.
struct ExposedSurface
{
  std::string name;
  double area = 0.0; ///< mm^2, above 0
};

/// What the drilling has laid open of each structure and mesh in each of `masks`: states of the
/// case's dissection, in their order. See dissection::exposedArea. Meshes take part where they are
/// touchable. Loads the CT, labels and meshes, once for all masks; takes a second or more for large
/// structures. Throws CancelledError.
std::vector<std::vector<ExposedSurface>>
exposedSurfaces(const Case& value, const std::vector<const volume::CutMask*>& masks,
                const core::Progress& progress = {});

/// Of the case as it is drilled now. Throws InvalidParameter unless its dissection is loaded.
std::vector<ExposedSurface> exposedSurfaces(const Case& value, const core::Progress& progress = {});

} // namespace petrous::scene
