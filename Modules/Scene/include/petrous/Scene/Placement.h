#pragma once

#include <memory>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// The space in which a label map or a mesh was drawn: the CT's patient space, or that of an MR,
/// from which the MR's registration maps it to the CT. While that MR is not registered it has no
/// place in CT space: it is not rendered, touched, drilled or measured.
struct Placement
{
  std::string drawnOn;           ///< name of the MR; empty: in the CT's patient space
  std::string missing;           ///< why it has no place in CT space, to follow its name; or empty
  core::RigidTransform mrFromCt; ///< of the MR, if it has a place
};

/// For labels without this information (older cases), a map with the grid of one MR, and not that
/// of the CT, is taken as drawn on that MR; only then the labels are loaded.
Placement placementOf(const Case& value, const LabelPart& part);
Placement placementOf(const Case& value, const MeshPart& part);

/// Why the structure or mesh of that name has no place in CT space; empty if it has one, or if
/// there is none of that name.
std::string missingPlace(const Case& value, const std::string& name);

/// Reads the label maps of these parts at once, on all processors, before they are used one by one.
/// One that cannot be read is reported where it is used.
void readLabels(const std::vector<const LabelPart*>& parts);

/// The labels in CT space: the same voxels, on a grid in the CT's patient space. nullptr if they
/// have no place there. Loads the labels.
std::shared_ptr<const volume::LabelMap> labelsOnCt(const Case& value, const LabelPart& part);

/// The mesh in CT space; nullptr if it has no place there. Loads the mesh.
std::shared_ptr<const core::TriangleMesh> meshOnCt(const Case& value, const MeshPart& part);

/// Names of structures and meshes drawn on an MR.
std::vector<std::string> drawnOnMr(const Case& value, const std::string& mr);

/// "'a', 'b'"; for many names the first few and the number of the others.
std::string listed(const std::vector<std::string>& names);

/// The MR images with this grid; none if it is the CT's.
std::vector<std::string> mrWithGrid(const Case& value, const core::GridGeometry& grid);

/// A rigidly transformed grid: its patient points of B become the corresponding points of A.
core::GridGeometry movedGrid(const core::GridGeometry& grid, const core::RigidTransform& aFromB);

} // namespace petrous::scene
