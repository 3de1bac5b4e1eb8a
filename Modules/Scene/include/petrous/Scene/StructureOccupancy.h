#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// A single structure of a case as occupancy, whose 1/2 isosurface is its surface.
struct StructureOccupancy
{
  std::string name;
  std::string mr;            ///< the MR on which it was drawn; empty: the CT, or another grid
  core::GridGeometry grid;   ///< on which it was drawn, in CT space; for a mesh that of its voxels
  core::GridGeometry around; ///< part of that grid whose hull contains the whole structure
  /// Computes the occupancy: the smoothed union of a label (SmoothedUnion.h), the voxels of a mesh.
  std::function<std::shared_ptr<const volume::Volume<float>>()> make;
  MrReadings readings = {}; ///< StructurePart::readings
};

/// The structures of all label maps, and the meshes that are already voxelized for touch, if they
/// have a place in CT space. Loads the labels and scans their voxels once; computes no occupancy
/// yet.
std::vector<StructureOccupancy> structureOccupancies(const Case& value);

} // namespace petrous::scene
