#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// A structure of a case, whole and alone, as the occupancy whose 1/2 level is its surface.
struct StructureOccupancy
{
  std::string name;
  std::string mr;            ///< the MR that it was drawn on; empty: the CT, or another grid
  core::GridGeometry grid;   ///< that it was drawn on, as it lies on the CT; of a mesh its voxels'
  core::GridGeometry around; ///< part of that grid: nothing of the structure is outside its hull
  /// Makes the occupancy: the smoothed union of a label (SmoothedUnion.h), the voxels of a mesh.
  std::function<std::shared_ptr<const volume::Volume<float>>()> make;
};

/// The structures of all label maps, and those meshes that have voxels for touch already, as far as
/// they have a place on the CT. Loads the
/// labels and looks at their voxels once; makes no occupancy yet.
std::vector<StructureOccupancy> structureOccupancies(const Case& value);

} // namespace petrous::scene
