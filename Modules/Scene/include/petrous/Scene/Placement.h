#pragma once

#include <memory>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Where a label map or a mesh lies: in the CT's patient space, or in that of an MR, through whose
/// registration it comes to the CT. As long as that MR is not registered it is nowhere on the CT:
/// it is not drawn, not felt, not drilled and not measured.
struct Placement
{
  std::string drawnOn; ///< the MR's name; empty: it lies in the CT's patient space
  std::string missing; ///< why it has no place on the CT, in words that follow its name; or empty
  core::RigidTransform mrFromCt; ///< of the MR, where it has a place
};

/// Of labels of which the case does not say it (of older cases), a map that has the grid of one MR,
/// and not the CT's, was drawn on that; only then the labels are loaded.
Placement placementOf(const Case& value, const LabelPart& part);
Placement placementOf(const Case& value, const MeshPart& part);

/// Why the structure or mesh of that name has no place on the CT; empty where it has one, or there
/// is none of that name.
std::string missingPlace(const Case& value, const std::string& name);

/// The labels where they lie on the CT: the same voxels, on a grid in the CT's patient space. Null
/// where they have no place. Loads them.
std::shared_ptr<const volume::LabelMap> labelsOnCt(const Case& value, const LabelPart& part);

/// The mesh where it lies on the CT, likewise.
std::shared_ptr<const core::TriangleMesh> meshOnCt(const Case& value, const MeshPart& part);

/// Structures and meshes that were drawn on an MR.
std::vector<std::string> drawnOnMr(const Case& value, const std::string& mr);

/// "'a', 'b'"; of many names the first few and how many more there are.
std::string listed(const std::vector<std::string>& names);

/// The MR images that have this grid, where it is not the CT's.
std::vector<std::string> mrWithGrid(const Case& value, const core::GridGeometry& grid);

/// A grid moved: what it said of points of B, it says of points of A then.
core::GridGeometry movedGrid(const core::GridGeometry& grid, const core::RigidTransform& aFromB);

} // namespace petrous::scene
