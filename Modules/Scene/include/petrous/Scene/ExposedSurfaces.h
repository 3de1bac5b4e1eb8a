#pragma once

#include <string>
#include <vector>

#include "petrous/Dissection/ExposedArea.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Area of a structure's surface exposed by drilling.
struct ExposedSurface
{
  std::string name;
  double area = 0.0; ///< mm^2, above 0
};

/// The exposed area of each structure and mesh for each of `masks`: states of the case's
/// dissection, in the given order. See dissection::exposedArea. Meshes are included if touchable.
/// Loads the CT, labels and meshes, once for all masks; takes a second or more for large
/// structures. Throws CancelledError.
std::vector<std::vector<ExposedSurface>>
exposedSurfaces(const Case& value, const std::vector<const volume::CutMask*>& masks,
                const core::Progress& progress = {});

/// For the current state of the case. Throws InvalidParameter unless its dissection is loaded.
std::vector<ExposedSurface> exposedSurfaces(const Case& value, const core::Progress& progress = {});

} // namespace petrous::scene
